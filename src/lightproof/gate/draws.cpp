#include "lightproof/gate/draws.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random_batch.h"
#include "lightproof/gate/sampler_failure.h"
#include "lightproof/image/look_up.h"
#include "lightproof/stats/uniformity.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/sphere_batch.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kBatch = 1024;
/// Samples of one task; fixed, so that the split does not depend on the threads.
constexpr std::uint64_t kTaskSamples = std::uint64_t{1} << 18U;
/// Tasks whose results are held at once.
constexpr std::uint64_t kTasksAtOnce = 16;

using Numbers = std::vector<double>;

/// Adds what was counted, if it was.
template <class Into, class From>
void add_counts(Into&& into, const From& from) {
  if (from.size() == 0) return;
  std::transform(into.begin(), into.end(), from.begin(), into.begin(), std::plus<>());
}

/// What one task found. Its texels are a list: a grid for every task would not fit a large map. The
/// finest counts are of half the size, so that they stay in the cache.
struct Part {
  explicit Part(std::size_t bands = 0) : draws(Extent{0, 0}, bands, 0) {}
  Draws draws;
  std::vector<std::uint32_t> texels;
  std::vector<std::uint8_t> codes;  ///< of the transformed coordinates, in order
  std::vector<std::uint32_t> marginal = std::vector<std::uint32_t>(kUniformCells);
  std::vector<std::uint32_t> column_marginal = std::vector<std::uint32_t>(kUniformCells);
};

/// Samples of one batch, what is known of their positions, and what the estimators say of them.
/// Each step is a loop over all of them that does one thing: what it reads from memory can be
/// waited for together, and what it computes becomes vectors.
struct Batch {
  std::vector<SquarePoint> points = std::vector<SquarePoint>(kBatch);
  std::vector<TexelSample> samples = std::vector<TexelSample>(kBatch);
  std::vector<std::size_t> order = std::vector<std::size_t>(kBatch);  ///< in the batch as drawn
  std::uint64_t first = 0;  ///< number of the first sample
  std::size_t size = 0;
  std::size_t drawn = 0;        ///< before those that left the map were taken out
  Numbers s = Numbers(kBatch);  ///< of the directions, in Lightproof's own frame
  Numbers t = Numbers(kBatch);
  Numbers x = Numbers(kBatch);  ///< directions
  Numbers y = Numbers(kBatch);
  Numbers z = Numbers(kBatch);
  Numbers per_square = Numbers(kBatch);  ///< d(omega) / (ds dt) in the map's square
  std::vector<reference::RosenblattPoint> units = std::vector<reference::RosenblattPoint>(kBatch);
  std::vector<TransformedSample> transformed = std::vector<TransformedSample>(kBatch);
  Numbers radiance = Numbers(kBatch);                       ///< as it is looked up
  std::vector<char> is_bright = std::vector<char>(kBatch);  ///< the samples' texels
  Numbers inverse_pdf = Numbers(kBatch);
  Numbers estimates = Numbers(kBatch);
};

/// Whether a number is all but a multiple of 2^-20, and not 0.
bool is_on_lattice(double u) {
  const double scaled = u * 0x1p20;
  return u > 0.0 && std::abs(scaled - std::round(scaled)) < 0x1p-8;
}

void count_repeats(Draws& draws, const Batch& batch) {
  for (std::size_t i = 1; i < batch.size; ++i) {
    draws.repeats += batch.samples[i].at == batch.samples[i - 1].at ? 1 : 0;
  }
}

/// Leaves what is on the map.
void count_out_of_domain(Draws& draws, Batch& batch, Extent map) {
  std::size_t kept = 0;
  batch.drawn = batch.size;
  for (std::size_t i = 0; i < batch.size; ++i) {
    if (!is_on_map(batch.samples[i], map)) {
      draws.out_of_domain.add({batch.points[i], batch.samples[i], batch.first + i});
      continue;
    }
    batch.order[kept] = i;
    if (kept != i) {
      batch.points[kept] = batch.points[i];
      batch.samples[kept] = batch.samples[i];
    }
    ++kept;
  }
  batch.size = kept;
}

/// One by one, on maps of any mapping.
void find_mapped_directions(Batch& batch, const Mapping& mapping) {
  for (std::size_t i = 0; i < batch.size; ++i) {
    const Direction d = direction_at(mapping, batch.samples[i].at);
    const SquarePoint at = square_from_direction(d);
    batch.s[i] = at.s;
    batch.t[i] = at.t;
    batch.x[i] = d.x;
    batch.y[i] = d.y;
    batch.z[i] = d.z;
    batch.per_square[i] = solid_angle_per_square(mapping, batch.samples[i].at);
  }
}

void find_directions(Batch& batch, const Mapping& mapping) {
  if (!is_plain(mapping)) return find_mapped_directions(batch, mapping);
  const auto part = [&](Numbers& numbers) { return std::span(numbers).first(batch.size); };
  for (std::size_t i = 0; i < batch.size; ++i) {
    batch.s[i] = batch.samples[i].at.s;
    batch.t[i] = batch.samples[i].at.t;
  }
  directions_of_positions(part(batch.s), part(batch.t),
                          {part(batch.x), part(batch.y), part(batch.z), part(batch.per_square)});
  for (double& value : part(batch.per_square)) value *= 2.0 * kPi * kPi;
}

/// The texels lie anywhere: a loop that does little else waits for many of them at once.
void count_texels(Part& part, Batch& batch, const Expectation& expectation) {
  const auto width = static_cast<std::uint32_t>(expectation.masses.extent().width);
  for (std::size_t i = 0; i < batch.size; ++i) {
    const TexelSample& sample = batch.samples[i];
    part.texels.push_back(static_cast<std::uint32_t>(sample.y) * width +
                          static_cast<std::uint32_t>(sample.x));
    const std::uint8_t flags = expectation.flags(sample.x, sample.y);
    batch.is_bright[i] = (flags & Expectation::counts_as_bright) != 0 ? 1 : 0;
    if ((flags & Expectation::has_mass) == 0) {
      part.draws.zero_density.add({batch.points[i], sample, batch.first + batch.order[i]});
    }
  }
  for (std::size_t i = 0; i < batch.size; ++i) {
    const TexelSample& sample = batch.samples[i];
    batch.radiance[i] = expectation.lookup == Lookup::nearest
                            ? expectation.luminance(sample.x, sample.y)
                            : look_up_bilinear(expectation.luminance, sample.at);
  }
}

void count_position(Draws& draws, const reference::RosenblattPoint& unit,
                    const Expectation& expectation) {
  if (unit.row < 0) return;
  const int cell = kPositionCells.width * cell_of(unit.share_of_row, kPositionCells.height) +
                   cell_of(unit.share_of_cell, kPositionCells.width);
  ++draws.positions(cell, expectation.band_of_row[static_cast<std::size_t>(unit.row)]);
}

/// What is left of a batch's order once the samples that left the map are taken out.
void count_successive(Part& part, const Batch& batch) {
  const std::span<const TransformedSample> in_order =
      std::span(batch.transformed).first(batch.drawn);
  for (const TransformedSample& sample : in_order) part.codes.push_back(cells_code(sample));
  part.draws.successive.add_runs(in_order);
}

void count_transformed(Part& part, Batch& batch, const Expectation& expectation) {
  constexpr auto kCells = static_cast<int>(kUniformCells);
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  Draws& draws = part.draws;
  const std::span<const reference::RosenblattPoint> units =
      std::span(batch.units).first(batch.size);
  expectation.transform(std::span(batch.samples).first(batch.size),
                        std::span(batch.z).first(batch.size),
                        std::span(batch.units).first(batch.size));
  for (const reference::RosenblattPoint& unit : units) {
    ++part.marginal[static_cast<std::size_t>(cell_of(unit.marginal, kCells))];
    ++part.column_marginal[static_cast<std::size_t>(cell_of(unit.column_marginal, kCells))];
    ++draws.pairs(cell_of(unit.conditional, kPairBins.width),
                  cell_of(unit.marginal, kPairBins.height));
  }
  for (const reference::RosenblattPoint& unit : units) count_position(draws, unit, expectation);
  for (const reference::RosenblattPoint& unit : units) {
    draws.marginal_on_lattice += is_on_lattice(unit.marginal) ? 1 : 0;
    draws.conditional_on_lattice += is_on_lattice(unit.conditional) ? 1 : 0;
  }
  if (batch.size < batch.drawn) {
    std::fill(batch.transformed.begin(), batch.transformed.end(),
              TransformedSample{kNowhere, kNowhere});
  }
  for (std::size_t i = 0; i < units.size(); ++i) {
    batch.transformed[batch.order[i]] = {units[i].marginal, units[i].conditional};
  }
  count_successive(part, batch);
}

void add_estimates(Draws& draws, Batch& batch) {
  for (std::size_t i = 0; i < batch.size; ++i) {
    ++draws.bins(cell_of(batch.s[i], kGateBins.width), cell_of(batch.t[i], kGateBins.height));
  }
  for (std::size_t i = 0; i < batch.size; ++i) {
    batch.inverse_pdf[i] = batch.per_square[i] / batch.samples[i].pdf.value;
  }
  const std::span<const double> estimates = std::span(batch.estimates).first(batch.size);
  for (std::size_t k = 0; k < kMeanCaseCount; ++k) {
    const Direction normal = kMeanCases[k].normal;
    for (std::size_t i = 0; i < batch.size; ++i) {
      const double cosine = normal.x * batch.x[i] + normal.y * batch.y[i] + normal.z * batch.z[i];
      batch.estimates[i] = batch.radiance[i] * std::max(0.0, cosine) * batch.inverse_pdf[i];
    }
    draws.estimators[k].add(estimates);
  }
  for (std::size_t i = 0; i < batch.size; ++i) {
    batch.estimates[i] = batch.is_bright[i] != 0 ? batch.inverse_pdf[i] : 0.0;
  }
  draws.inverse_pdf.add(estimates);
}

/// The batch's samples: at points of the stream, or those that stand there in the source's order.
void draw_batch(Batch& batch, const BoundSampler& sampler, const RandomStream& stream,
                std::uint64_t first) {
  const auto points = std::span(batch.points).first(batch.size);
  const auto samples = std::span(batch.samples).first(batch.size);
  if (sampler.takes_points()) {
    fill_points(stream, first, points);
    sampler.sample(points, samples);
  } else {
    std::fill(points.begin(), points.end(), SquarePoint{std::nan(""), std::nan("")});
    sampler.sample_in_order(first, samples);
  }
  if (sampler.has_weights) return;
  for (TexelSample& sample : samples) sample.pdf = {1.0};
}

Part draw_part(const BoundSampler& sampler, const Expectation& expectation,
               const RandomStream& stream, PointRange range) {
  Part part(expectation.bands.size());
  part.draws.samples = range.count;
  part.texels.reserve(range.count);
  Batch batch;
  for (std::uint64_t done = 0; done < range.count; done += kBatch) {
    batch.size = static_cast<std::size_t>(std::min(kBatch, range.count - done));
    batch.first = range.first + done;
    draw_batch(batch, sampler, stream, batch.first);
    count_repeats(part.draws, batch);
    count_out_of_domain(part.draws, batch, expectation.masses.extent());
    find_directions(batch, expectation.mapping);
    count_texels(part, batch, expectation);
    if (expectation.transform) count_transformed(part, batch, expectation);
    add_estimates(part.draws, batch);
  }
  part.draws.successive.add_pairs(part.codes);
  return part;
}

/// Asks for the same samples, batch after batch, and keeps none.
void ask_in_order(const BoundSampler& sampler, const RandomStream& stream, PointRange range) {
  Batch batch;
  for (std::uint64_t done = 0; done < range.count; done += kBatch) {
    batch.size = static_cast<std::size_t>(std::min(kBatch, range.count - done));
    draw_batch(batch, sampler, stream, range.first + done);
  }
}

/// Splits a range into tasks that depend on nothing else, makes their parts in parallel and hands
/// them on in order.
template <class Make, class Take>
void for_each_part(PointRange range, const Make& make, const Take& take) {
  constexpr std::uint64_t kBlock = kTasksAtOnce * kTaskSamples;
  const std::uint64_t last = range.first + range.count;
  for (std::uint64_t start = range.first; start < last; start += kBlock) {
    const std::uint64_t end = std::min(last, start + kBlock);
    std::vector<decltype(make(range))> parts((end - start + kTaskSamples - 1) / kTaskSamples);
    parallel_for(parts.size(), [&](std::size_t task) {
      const std::uint64_t first = start + task * kTaskSamples;
      parts[task] = make({first, std::min(kTaskSamples, end - first)});
    });
    for (const auto& part : parts) take(part);
  }
}

/// Directions drawn uniformly, and one estimate for each.
struct UniformBatch {
  Numbers s = Numbers(kBatch);
  Numbers u = Numbers(kBatch);
  Numbers t = Numbers(kBatch);
  Numbers x = Numbers(kBatch);
  Numbers y = Numbers(kBatch);
  Numbers z = Numbers(kBatch);
  Numbers radiance = Numbers(kBatch);
  Numbers estimates = Numbers(kBatch);
};

/// Adds the light from these points of the stream, at most kBatch of them.
void add_uniform(UniformEstimates& estimates, UniformBatch& batch, const Expectation& expectation,
                 const RandomStream& stream, PointRange range) {
  const auto part = [&](Numbers& numbers) { return std::span(numbers).first(range.count); };
  fill_points(stream, range.first, part(batch.s), part(batch.u));
  uniform_directions(part(batch.s), part(batch.u),
                     {part(batch.x), part(batch.y), part(batch.z), part(batch.t)});
  const bool plain = is_plain(expectation.mapping);
  for (std::size_t i = 0; i < range.count; ++i) {
    const SquarePoint at =
        plain ? SquarePoint{batch.s[i], std::min(batch.t[i], 1.0)}
              : square_point_of(expectation.mapping, {batch.x[i], batch.y[i], batch.z[i]});
    batch.radiance[i] = look_up(expectation.luminance, expectation.lookup, at);
  }
  for (std::size_t k = 0; k < kMeanCaseCount; ++k) {
    const Direction normal = kMeanCases[k].normal;
    for (std::size_t i = 0; i < range.count; ++i) {
      const double cosine = normal.x * batch.x[i] + normal.y * batch.y[i] + normal.z * batch.z[i];
      batch.estimates[i] = kSphere * batch.radiance[i] * std::max(0.0, cosine);
    }
    estimates[k].add(part(batch.estimates));
  }
}

}  // namespace

Draws::Draws(Extent map, std::size_t bands, std::size_t cells)
    : bins(kGateBins),
      texels(map),
      marginal(cells),
      column_marginal(cells),
      pairs(kPairBins),
      positions({static_cast<int>(kPositionCells.count()), static_cast<int>(bands)}) {}

void Draws::merge(const Draws& other) {
  samples += other.samples;
  add_counts(bins.values(), other.bins.values());
  add_counts(texels.values(), other.texels.values());
  add_counts(marginal, other.marginal);
  add_counts(column_marginal, other.column_marginal);
  add_counts(pairs.values(), other.pairs.values());
  add_counts(positions.values(), other.positions.values());
  successive.merge(other.successive);
  repeats += other.repeats;
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) estimators[i].merge(other.estimators[i]);
  marginal_on_lattice += other.marginal_on_lattice;
  conditional_on_lattice += other.conditional_on_lattice;
  inverse_pdf.merge(other.inverse_pdf);
  out_of_domain.merge(other.out_of_domain);
  zero_density.merge(other.zero_density);
}

std::size_t Draws::bytes() const {
  return (texels.values().size() + marginal.size() + column_marginal.size()) *
         sizeof(std::uint64_t);
}

bool is_on_map(const TexelSample& sample, Extent map) {
  const bool in_square = sample.at.s >= 0.0 && sample.at.s < 1.0 && sample.at.t >= 0.0 &&
                         sample.at.t < 1.0;  // false for NaN
  return in_square && sample.x >= 0 && sample.x < map.width && sample.y >= 0 &&
         sample.y < map.height && sample.pdf.value > 0.0 && std::isfinite(sample.pdf.value);
}

UniformEstimates draw_uniformly(const Expectation& expectation, const RandomStream& stream,
                                std::uint64_t count_all) {
  UniformEstimates all;
  for_each_part(
      {0, count_all},
      [&](PointRange range) {
        UniformEstimates part;
        UniformBatch batch;
        for (std::uint64_t done = 0; done < range.count; done += kBatch) {
          const auto size = static_cast<std::size_t>(std::min(kBatch, range.count - done));
          add_uniform(part, batch, expectation, stream, {range.first + done, size});
        }
        return part;
      },
      [&](const UniformEstimates& part) {
        for (std::size_t k = 0; k < kMeanCaseCount; ++k) all[k].merge(part[k]);
      });
  return all;
}

Draws draw_samples(const BoundSampler& sampler, const Expectation& expectation,
                   const RandomStream& stream, PointRange all_points) {
  Draws all(expectation.masses.extent(), expectation.bands.size());
  const auto draw = [&](PointRange range) {
    return draw_part(sampler, expectation, stream, range);
  };
  const auto add = [&](const Part& part) {
    all.merge(part.draws);
    add_counts(all.marginal, part.marginal);
    add_counts(all.column_marginal, part.column_marginal);
    for (const std::uint32_t texel : part.texels) ++all.texels.values()[texel];
  };
  try {
    for_each_part(all_points, draw, add);
  } catch (const SamplerFailure&) {
    // Which task failed first is chance: the first failure in the order of the samples is not.
    ask_in_order(sampler, stream, all_points);
    throw;
  }
  return all;
}

void add_directed_positions(Draws& draws, const BoundSampler& sampler,
                            const Expectation& expectation, const DirectedPoints& directed) {
  const RowBand& rows = expectation.bands[directed.band];
  const double low = std::max(0.0, rows.below - directed.margin);
  const double high = std::min(1.0 - 0x1p-53, rows.below + rows.mass + directed.margin);
  std::vector<SquarePoint> points(static_cast<std::size_t>(directed.count));
  std::vector<TexelSample> samples(points.size());
  fill_points(directed.stream, 0, points);
  for (SquarePoint& u : points) u.t = low + u.t * (high - low);
  sampler.sample(points, samples);
  std::erase_if(samples, [&](const TexelSample& sample) {
    return !is_on_map(sample, expectation.masses.extent());
  });
  Numbers cosines;
  for (const TexelSample& sample : samples) cosines.push_back(cos_theta(sample.at.t));
  std::vector<reference::RosenblattPoint> units(samples.size());
  expectation.transform(samples, cosines, units);
  for (const reference::RosenblattPoint& unit : units) {
    if (expectation.band_of_row[static_cast<std::size_t>(unit.row)] != directed.band) continue;
    count_position(draws, unit, expectation);
  }
}

std::vector<std::uint64_t> row_counts(const Grid<std::uint64_t>& texels) {
  std::vector<std::uint64_t> counts;
  for (int y = 0; y < texels.extent().height; ++y) {
    const auto row = texels.row(y);
    counts.push_back(std::accumulate(row.begin(), row.end(), std::uint64_t{0}));
  }
  return counts;
}

std::vector<std::uint64_t> column_counts(const Grid<std::uint64_t>& texels) {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(texels.extent().width));
  for (int y = 0; y < texels.extent().height; ++y) {
    for (int x = 0; x < texels.extent().width; ++x) {
      counts[static_cast<std::size_t>(x)] += texels(x, y);
    }
  }
  return counts;
}

}  // namespace lightproof
