#include "lightproof/samplers/alias_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

/// Weights that are looked at while they are in the nearest cache.
constexpr std::size_t kBlock = 1024;

/// Calls body(first cell, weights) for all blocks of these cells, in their order.
template <class Body>
void for_blocks(const CellWeights& weights, std::size_t first, std::size_t end, const Body& body) {
  std::array<double, kBlock> memory;
  for (; first < end; first += kBlock) {
    const auto block = std::span(memory).first(std::min(kBlock, end - first));
    weights.get(first, block);
    body(first, std::span<const double>(block));
  }
}

/// What is known of the positive weights, some of which are less than a unit.
struct Bright {
  std::size_t faint = 0;  ///< how many of the others
  double sum = 0.0;
};

Bright bright_of(const CellWeights& weights, double unit) {
  std::vector<Bright> parts(chunks_of(weights.count(), kTaskCells));
  parallel_chunks(
      weights.count(), kTaskCells, [&](std::size_t chunk, std::size_t first, std::size_t end) {
        Bright part;
        for_blocks(weights, first, end, [&](std::size_t /*first*/, std::span<const double> block) {
          for (const double weight : block) {
            const bool faint = weight > 0.0 && weight < unit;
            part.faint += faint ? 1 : 0;
            part.sum += faint ? 0.0 : weight;
          }
        });
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

Scale scale_of(const CellWeights& weights, std::uint64_t total) {
  std::vector<double> sums(chunks_of(weights.count(), kTaskCells));
  std::vector<double> least(sums.size());
  parallel_chunks(
      weights.count(), kTaskCells, [&](std::size_t chunk, std::size_t first, std::size_t end) {
        WeightSums part;
        for_blocks(weights, first, end,
                   [&](std::size_t /*first*/, std::span<const double> block) { part.add(block); });
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

/// What rounding the masses of the cells of a task gave.
struct Rounded {
  std::size_t largest;  ///< cell
  std::int64_t sum;     ///< of the masses
};

/// What rounding leaves of a cell goes on to the next.
Rounded round_masses(const CellWeights& weights, const Scale& scale, std::size_t first_of_all,
                     std::span<std::uint64_t> masses) {
  const FixedPoint form = {scale.fixed, std::int64_t{1} << scale.fraction_bits, 0};
  std::int64_t sum = form.least / 2;  // half a unit: the end of the task is rounded to the nearest
  std::uint64_t most = 0;
  std::size_t largest = first_of_all;
  std::array<std::int64_t, kBlock> shares;
  const auto round = [&](std::size_t first, std::span<const double> block) {
    to_fixed_point(block, form, std::span(shares).first(block.size()));
    for (std::size_t i = 0; i < block.size(); ++i) {
      const std::int64_t before = sum >> scale.fraction_bits;
      sum += shares[i];
      const auto mass = static_cast<std::uint64_t>((sum >> scale.fraction_bits) - before);
      masses[first - first_of_all + i] = mass;
      if (mass <= most) continue;
      most = mass;
      largest = first + i;
    }
  };
  for_blocks(weights, first_of_all, first_of_all + masses.size(), round);
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

TableVector<std::uint64_t> whole_masses(const CellWeights& weights, unsigned bits) {
  const std::uint64_t total = weights.count() << bits;
  const Scale scale = scale_of(weights, total);
  TableVector<std::uint64_t> masses(weights.count());
  std::vector<std::size_t> largest(chunks_of(weights.count(), kTaskCells));
  std::vector<std::int64_t> sums(largest.size());
  parallel_chunks(
      weights.count(), kTaskCells, [&](std::size_t chunk, std::size_t first, std::size_t end) {
        const Rounded rounded =
            round_masses(weights, scale, first, std::span(masses).subspan(first, end - first));
        largest[chunk] = rounded.largest;
        sums[chunk] = rounded.sum;
      });
  const std::int64_t sum = std::accumulate(sums.begin(), sums.end(), std::int64_t{0});
  share_out(static_cast<std::int64_t>(total) - sum, std::uint64_t{1} << bits, largest, masses);
  return masses;
}

AliasSweep::AliasSweep(std::span<const std::uint64_t> masses, unsigned bits)
    : masses_(masses),
      full_(std::uint64_t{1} << bits),
      before_(chunks_of(masses.size(), kStretch) + 1) {
  parallel_chunks(masses.size(), kTask,
                  [&](std::size_t /*task*/, std::size_t first, std::size_t end) {
                    for (std::size_t cell = first; cell < end; cell += kStretch) {
                      before_[cell / kStretch] =
                          balance_of(masses_.subspan(cell, std::min(end - cell, kStretch)), full_);
                    }
                  });
  Balance sum{0, 0};
  for (Balance& stretch : before_) {  // the last is still zero
    const Balance before = sum;
    sum.lack += stretch.lack;
    sum.excess += stretch.excess;
    stretch = before;
  }
}

std::size_t AliasSweep::next_large(std::size_t cell) const {
  while (cell < masses_.size()) {
    const std::size_t stretch = cell / kStretch;
    const std::size_t end = std::min(masses_.size(), (stretch + 1) * kStretch);
    if (has_large(stretch)) {
      for (; cell < end; ++cell) {
        if (masses_[cell] > full_) return cell;
      }
    }
    cell = end;
  }
  return cell;
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
    if (large == masses_.size()) return {large, full_};
    excess += masses_[large] - full_;
    if (excess >= lack) return {large, full_ + (excess - lack)};
  }
}

namespace {

std::size_t checked(std::size_t cells) {
  constexpr std::size_t kMostCells = std::size_t{1} << 32U;
  if (cells <= kMostCells) return cells;
  throw InputError(fmt::format(
      "alias tables have 32-bit numbers: of {} texels they can number {}; scale the map "
      "down or take another sampler",
      cells, kMostCells));
}

}  // namespace

AliasTable::AliasTable(const CellWeights& weights) : entries_(checked(weights.count())) {
  const TableVector<std::uint64_t> masses = whole_masses(weights, kBits);
  const double unit = kUnit / static_cast<double>(weights.count());
  const auto probability = [&](std::size_t cell) { return to_probability(masses[cell], unit); };
  const auto take = [&](std::size_t cell, const AliasColumn& column) {
    entries_[cell] = {static_cast<std::uint32_t>(column.threshold),
                      static_cast<std::uint32_t>(column.alias), probability(cell),
                      probability(column.alias)};
  };
  AliasSweep(masses, kBits).for_columns(take, [&](const AliasRun& run) {
    const float alias_mass = run.alias < masses.size() ? probability(run.alias) : 0.0F;
    write_entries(run, unit, alias_mass, std::span(entries_).subspan(run.first, run.masses.size()));
  });
}

}  // namespace lightproof
