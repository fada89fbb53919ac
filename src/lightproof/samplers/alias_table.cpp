#include "lightproof/samplers/alias_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>

#include "lightproof/samplers/weight_vectors.h"

namespace lightproof {
namespace {

/// Cells of one task; fixed, so that the split does not depend on the threads.
constexpr std::size_t kChunk = std::size_t{1} << 16U;
/// Weights that are rounded while they are in the nearest cache.
constexpr std::size_t kBlock = 512;

std::size_t chunks_of(std::size_t count, std::size_t chunk) { return (count + chunk - 1) / chunk; }

/// Calls body(chunk, first cell, last cell + 1) for all chunks, in parallel.
template <class Body>
void for_chunks(std::size_t count, const Body& body) {
  parallel_for(chunks_of(count, kChunk), [&](std::size_t chunk) {
    body(chunk, chunk * kChunk, std::min(count, (chunk + 1) * kChunk));
  });
}

/// Of weights that are positive; some are less than a unit.
struct Bright {
  std::size_t faint = 0;  ///< how many of the others
  double sum = 0.0;
};

Bright bright_of(std::span<const double> weights, double unit) {
  std::vector<Bright> parts(chunks_of(weights.size(), kChunk));
  for_chunks(weights.size(), [&](std::size_t chunk, std::size_t first, std::size_t end) {
    Bright part;
    for (const double weight : weights.subspan(first, end - first)) {
      const bool faint = weight > 0.0 && weight < unit;
      part.faint += faint ? 1 : 0;
      part.sum += faint ? 0.0 : weight;
    }
    parts[chunk] = part;
  });
  Bright all;
  for (const Bright& part : parts) {
    all.faint += part.faint;
    all.sum += part.sum;
  }
  return all;
}

/// What turns weights into masses.
struct Scale {
  unsigned fraction_bits;  ///< below the unit, of the shares that are added up
  double fixed;            ///< of a weight, to its share in units of 2^-fraction_bits
};

Scale scale_of(std::span<const double> weights, std::uint64_t total) {
  std::vector<double> sums(chunks_of(weights.size(), kChunk));
  std::vector<double> least(sums.size());
  for_chunks(weights.size(), [&](std::size_t chunk, std::size_t first, std::size_t end) {
    const WeightSums part(weights.subspan(first, end - first));
    sums[chunk] = part.sum();
    least[chunk] = part.least_positive();
  });
  const double sum = WeightSums(sums).sum();
  const double unit = sum / static_cast<double>(total);
  const bool any_faint = *std::ranges::min_element(least) < unit;
  const Bright bright = any_faint ? bright_of(weights, unit) : Bright{0, sum};
  constexpr unsigned kMostBits = 62;
  constexpr unsigned kMostFractionBits = 20;
  const unsigned bits =
      std::min(kMostFractionBits, kMostBits - static_cast<unsigned>(std::bit_width(total)));
  const double shared = static_cast<double>(total - bright.faint);
  return {bits, std::ldexp(shared, static_cast<int>(bits)) / bright.sum};
}

/// Of the cells of a task.
struct Rounded {
  std::size_t largest;  ///< cell
  std::int64_t sum;     ///< of the masses
};

/// What rounding leaves of a cell goes on to the next.
Rounded round_masses(std::span<const double> weights, const Scale& scale,
                     std::span<std::uint64_t> masses) {
  const FixedPoint form = {scale.fixed, std::int64_t{1} << scale.fraction_bits, 0};
  std::int64_t sum = form.least / 2;  // half a unit: the end of the task is rounded to the nearest
  std::uint64_t most = 0;
  std::size_t largest = 0;
  std::array<std::int64_t, kBlock> shares;
  for (std::size_t first = 0; first < weights.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, weights.size() - first);
    to_fixed_point(weights.subspan(first, count), form, std::span(shares).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t before = sum >> scale.fraction_bits;
      sum += shares[i];
      const auto mass = static_cast<std::uint64_t>((sum >> scale.fraction_bits) - before);
      masses[first + i] = mass;
      if (mass <= most) continue;
      most = mass;
      largest = first + i;
    }
  }
  return {largest, sum >> scale.fraction_bits};
}

/// Adds the rest, of either sign, to those of these masses that are at least half the average, in
/// proportion to them; one is. They hold at least half of all, so that the rest changes each by a
/// small share of itself, whatever their number.
void share_out(std::int64_t rest, std::uint64_t average, std::span<const std::size_t> largest,
               std::span<std::uint64_t> masses) {
  std::vector<std::size_t> takers;
  std::ranges::copy_if(largest, std::back_inserter(takers),
                       [&](std::size_t cell) { return 2 * masses[cell] >= average; });
  double left = 0.0;
  for (const std::size_t cell : takers) left += static_cast<double>(masses[cell]);
  for (const std::size_t cell : takers) {
    const auto mass = static_cast<double>(masses[cell]);
    const std::int64_t part =
        cell == takers.back() ? rest : std::llround(static_cast<double>(rest) * (mass / left));
    masses[cell] += static_cast<std::uint64_t>(part);  // modulo 2^64: of either sign
    rest -= part;
    left -= mass;
  }
}

}  // namespace

TableVector<std::uint64_t> whole_masses(std::span<const double> weights, unsigned bits) {
  const std::uint64_t total = weights.size() << bits;
  const Scale scale = scale_of(weights, total);
  TableVector<std::uint64_t> masses(weights.size());
  std::vector<std::size_t> largest(chunks_of(weights.size(), kChunk));
  std::vector<std::int64_t> sums(largest.size());
  for_chunks(weights.size(), [&](std::size_t chunk, std::size_t first, std::size_t end) {
    const std::size_t count = end - first;
    const Rounded rounded =
        round_masses(weights.subspan(first, count), scale, std::span(masses).subspan(first, count));
    largest[chunk] = first + rounded.largest;
    sums[chunk] = rounded.sum;
  });
  const std::int64_t sum = std::accumulate(sums.begin(), sums.end(), std::int64_t{0});
  share_out(static_cast<std::int64_t>(total) - sum, std::uint64_t{1} << bits, largest, masses);
  return masses;
}

AliasSweep::AliasSweep(std::span<const std::uint64_t> masses, unsigned bits)
    : masses_(masses),
      full_(std::uint64_t{1} << bits),
      before_(chunks_of(masses.size(), kStretch)) {
  for_chunks(masses.size(), [&](std::size_t /*task*/, std::size_t first, std::size_t end) {
    static_assert(kChunk % kStretch == 0);
    for (std::size_t cell = first; cell < end; cell += kStretch) {
      before_[cell / kStretch] = balance(cell, std::min(end, cell + kStretch));
    }
  });
  Balance sum{0, 0};
  for (Balance& stretch : before_) {
    const Balance before = sum;
    sum.lack += stretch.lack;
    sum.excess += stretch.excess;
    stretch = before;
  }
}

AliasSweep::Balance AliasSweep::balance(std::size_t first, std::size_t end) const {
  std::uint64_t sum = 0;
  std::uint64_t lack = 0;
  for (const std::uint64_t mass : masses_.subspan(first, end - first)) {
    sum += mass;
    lack += full_ - std::min(mass, full_);
  }
  return {lack, sum + lack - (end - first) * full_};
}

AliasSweep::Filling AliasSweep::start_of(std::size_t stretch) const {
  // What the small cells before the stretch lack has come from the first large ones, up to the
  // first with which all of these have as much above the average.
  const std::uint64_t lack = before_[stretch].lack;
  const auto beyond = std::ranges::lower_bound(before_, lack, {}, &Balance::excess);
  const auto from =
      static_cast<std::size_t>(std::max(beyond - before_.begin() - 1, std::ptrdiff_t{0}));
  std::uint64_t excess = before_[from].excess;
  for (std::size_t large = next_large(from * kStretch);; large = next_large(large + 1)) {
    excess += masses_[large] - full_;
    if (excess >= lack) return {large, full_ + (excess - lack)};
  }
}

AliasTable::AliasTable(std::span<const double> weights) : entries_(weights.size()) {
  const TableVector<std::uint64_t> masses = whole_masses(weights, kBits);
  const double unit = kUnit / static_cast<double>(weights.size());
  const auto probability = [&](std::size_t cell) {
    // Quicker of signed numbers.
    return static_cast<float>(unit * static_cast<double>(static_cast<std::int64_t>(masses[cell])));
  };
  AliasSweep(masses, kBits).for_columns([&](std::size_t cell, const AliasColumn& column) {
    entries_[cell] = {static_cast<std::uint32_t>(column.threshold),
                      static_cast<std::uint32_t>(column.alias), probability(cell),
                      probability(column.alias)};
  });
}

}  // namespace lightproof
