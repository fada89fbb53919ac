#include "lightproof/suite/draws.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random_batch.h"
#include "lightproof/image/look_up.h"
#include "lightproof/stats/uniformity.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kBatch = 1024;
/// Samples of one task; fixed, so that the split does not depend on the threads.
constexpr std::uint64_t kTaskSamples = std::uint64_t{1} << 18U;
/// Tasks whose results are held at once.
constexpr std::uint64_t kTasksAtOnce = 16;

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
  std::vector<std::uint32_t> along = std::vector<std::uint32_t>(kUniformCells);
  std::vector<std::uint32_t> column = std::vector<std::uint32_t>(kUniformCells);
};

/// Samples of one batch, and what the estimators say of them.
struct Batch {
  std::vector<SquarePoint> points = std::vector<SquarePoint>(kBatch);
  std::vector<TexelSample> samples = std::vector<TexelSample>(kBatch);
  std::vector<std::size_t> order = std::vector<std::size_t>(kBatch);  ///< in the batch as drawn
  std::size_t size = 0;
  std::size_t drawn = 0;  ///< before those that left the map were taken out
  std::vector<TransformedSample> transformed = std::vector<TransformedSample>(kBatch);
  std::vector<double> radiance = std::vector<double>(kBatch);  ///< as it is looked up
  std::vector<char> is_bright = std::vector<char>(kBatch);     ///< the samples' texels
  std::array<std::vector<double>, kMeanCaseCount> estimates;
  std::vector<double> inverse_pdf;
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
void count_lost(Draws& draws, Batch& batch, Extent map) {
  std::size_t kept = 0;
  batch.drawn = batch.size;
  for (std::size_t i = 0; i < batch.size; ++i) {
    if (!is_on_map(batch.samples[i], map)) {
      draws.lost.add(batch.points[i], batch.samples[i]);
      continue;
    }
    batch.order[kept] = i;
    batch.points[kept] = batch.points[i];
    batch.samples[kept++] = batch.samples[i];
  }
  batch.size = kept;
}

/// The texels lie anywhere: a loop that does little else waits for many of them at once.
void count_texels(Part& part, Batch& batch, const Expectation& expectation) {
  const auto width = static_cast<std::uint32_t>(expectation.masses.extent().width);
  for (std::size_t i = 0; i < batch.size; ++i) {
    const TexelSample& sample = batch.samples[i];
    const double mass = expectation.masses(sample.x, sample.y);
    const double grey = expectation.grey(sample.x, sample.y);
    batch.is_bright[i] = expectation.is_bright(grey) ? 1 : 0;
    batch.radiance[i] = expectation.lookup == Lookup::nearest
                            ? grey
                            : look_up_bilinear(expectation.grey, sample.at);
    part.texels.push_back(static_cast<std::uint32_t>(sample.y) * width +
                          static_cast<std::uint32_t>(sample.x));
    if (!(mass > 0.0)) part.draws.dark.add(batch.points[i], sample);
  }
}

void count_position(Draws& draws, const reference::UnitPoint& unit,
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
  std::fill(batch.transformed.begin(), batch.transformed.end(),
            TransformedSample{kNowhere, kNowhere});
  for (std::size_t i = 0; i < batch.size; ++i) {
    const TexelSample& sample = batch.samples[i];
    const reference::UnitPoint unit = expectation.transform(sample.at, sample.x, sample.y);
    ++part.along[static_cast<std::size_t>(cell_of(unit.along, kCells))];
    ++part.column[static_cast<std::size_t>(cell_of(unit.column, kCells))];
    draws.along_on_lattice += is_on_lattice(unit.along) ? 1 : 0;
    draws.across_on_lattice += is_on_lattice(unit.across) ? 1 : 0;
    ++draws.pairs(cell_of(unit.across, kPairBins.width), cell_of(unit.along, kPairBins.height));
    count_position(draws, unit, expectation);
    batch.transformed[batch.order[i]] = {unit.along, unit.across};
  }
  count_successive(part, batch);
}

void add_estimates(Draws& draws, Batch& batch) {
  for (std::vector<double>& estimates : batch.estimates) estimates.clear();
  batch.inverse_pdf.clear();
  for (std::size_t i = 0; i < batch.size; ++i) {
    const TexelSample& sample = batch.samples[i];
    ++draws.bins(cell_of(sample.at.s, kGateBins.width), cell_of(sample.at.t, kGateBins.height));
    // 2 pi^2 sin(theta) / p(s,t)
    const double inverse_pdf = 1.0 / to_solid_angle(sample.pdf, sample.at).value;
    const Direction direction = direction_from_square(sample.at);
    const double radiance = batch.radiance[i];
    for (std::size_t k = 0; k < kMeanCaseCount; ++k) {
      const double cosine = std::max(0.0, glm::dot(kMeanCases[k].normal, direction));
      batch.estimates[k].push_back(radiance * cosine * inverse_pdf);
    }
    batch.inverse_pdf.push_back(batch.is_bright[i] != 0 ? inverse_pdf : 0.0);
  }
  for (std::size_t k = 0; k < kMeanCaseCount; ++k) draws.estimators[k].add(batch.estimates[k]);
  draws.inverse_pdf.add(batch.inverse_pdf);
}

Part draw_part(const BoundSampler& sampler, const Expectation& expectation,
               const RandomStream& stream, Range range) {
  Part part(expectation.bands.size());
  part.draws.samples = range.count;
  part.texels.reserve(range.count);
  Batch batch;
  for (std::uint64_t done = 0; done < range.count; done += kBatch) {
    batch.size = static_cast<std::size_t>(std::min(kBatch, range.count - done));
    fill_points(stream, range.first + done, std::span(batch.points).first(batch.size));
    sampler.sample(std::span(batch.points).first(batch.size),
                   std::span(batch.samples).first(batch.size));
    count_repeats(part.draws, batch);
    count_lost(part.draws, batch, expectation.masses.extent());
    count_texels(part, batch, expectation);
    if (expectation.transform) count_transformed(part, batch, expectation);
    add_estimates(part.draws, batch);
  }
  part.draws.successive.add_pairs(part.codes);
  return part;
}

/// Splits a range into tasks that depend on nothing else, makes their parts in parallel and hands
/// them on in order.
template <class Make, class Take>
void for_each_part(Range range, const Make& make, const Take& take) {
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

}  // namespace

Draws::Draws(Extent map, std::size_t bands, std::size_t cells)
    : bins(kGateBins),
      texels(map),
      along(cells),
      column(cells),
      pairs(kPairBins),
      positions({static_cast<int>(kPositionCells.count()), static_cast<int>(bands)}) {}

void Draws::merge(const Draws& other) {
  samples += other.samples;
  add_counts(bins.values(), other.bins.values());
  add_counts(texels.values(), other.texels.values());
  add_counts(along, other.along);
  add_counts(column, other.column);
  add_counts(pairs.values(), other.pairs.values());
  add_counts(positions.values(), other.positions.values());
  successive.merge(other.successive);
  repeats += other.repeats;
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) estimators[i].merge(other.estimators[i]);
  along_on_lattice += other.along_on_lattice;
  across_on_lattice += other.across_on_lattice;
  inverse_pdf.merge(other.inverse_pdf);
  lost.merge(other.lost);
  dark.merge(other.dark);
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
      [&](Range range) {
        UniformEstimates part;
        for (std::uint64_t i = range.first; i < range.first + range.count; ++i) {
          const SquarePoint u = stream.point(i);
          const SquarePoint at = {u.s, std::acos(1.0 - 2.0 * u.t) / kPi};
          const double sine = 2.0 * std::sqrt(u.t * (1.0 - u.t));
          const double phi = kPi - 2.0 * kPi * u.s;
          const Direction direction = {sine * std::cos(phi), sine * std::sin(phi), 2.0 * u.t - 1.0};
          const double radiance = look_up(expectation.grey, expectation.lookup, at);
          for (std::size_t k = 0; k < kMeanCaseCount; ++k) {
            const double cosine = std::max(0.0, glm::dot(kMeanCases[k].normal, direction));
            part[k].add(kSphere * radiance * cosine);
          }
        }
        return part;
      },
      [&](const UniformEstimates& part) {
        for (std::size_t k = 0; k < kMeanCaseCount; ++k) all[k].merge(part[k]);
      });
  return all;
}

Draws draw_samples(const BoundSampler& sampler, const Expectation& expectation,
                   const RandomStream& stream, Range all_points) {
  Draws all(expectation.masses.extent(), expectation.bands.size());
  for_each_part(
      all_points, [&](Range range) { return draw_part(sampler, expectation, stream, range); },
      [&](const Part& part) {
        all.merge(part.draws);
        add_counts(all.along, part.along);
        add_counts(all.column, part.column);
        for (const std::uint32_t texel : part.texels) ++all.texels.values()[texel];
      });
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
  for (const TexelSample& sample : samples) {
    if (!is_on_map(sample, expectation.masses.extent())) continue;
    const reference::UnitPoint unit = expectation.transform(sample.at, sample.x, sample.y);
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
