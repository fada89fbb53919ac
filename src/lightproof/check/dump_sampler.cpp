#include "lightproof/check/dump_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lightproof/samplers/texel_positions.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr std::size_t kBlock = 4096;
constexpr std::uint64_t kMostCompared = std::uint64_t{1} << 22U;

/// How near positions may come to the edges of the map, in texels: as samplers keep away from them.
double off_the_edges(double cells, int count) {
  return std::clamp(cells, kCellMargin, count * (1.0 - 0x1p-53) - kCellMargin);
}

/// A coordinate in cells, and the cell on the other side of the nearest edge, if that edge is
/// within the coordinate's rounding: else the coordinate's own.
struct Cells {
  double at;
  int own;
  int other;
};

Cells cells_of(double coordinate, int count, double rounding, bool wraps) {
  const double at = off_the_edges(coordinate * count, count);
  const int own = std::min(static_cast<int>(at), count - 1);
  const double edge = std::round(at);
  if (std::abs(at - edge) > rounding * count) return {at, own, own};
  int other = at < edge ? own + 1 : own - 1;
  if (other < 0 || other >= count) other = wraps ? (other + count) % count : own;
  return {at, own, other};
}

/// The coordinate inside of a cell: the nearest one to where it was.
double inside(const Cells& cells, int cell, int count) {
  const double fraction = cell == cells.own ? cells.at - cell : cells.at < cell ? 0.0 : 1.0;
  // From the last cell to the first one and back the edge is the same.
  const bool wraps = std::abs(cell - cells.own) > 1;
  return position_in_cell(cell, wraps ? 1.0 - fraction : fraction, count);
}

class Placement {
 public:
  Placement(const Expectation& expectation, double rounding)
      : expectation_(&expectation), extent_(expectation.masses.extent()), rounding_(rounding) {}

  TexelSample operator()(const DumpedSample& sample) const {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(sample.direction.x)) return {{kNaN, kNaN}, -1, -1, {kNaN}};
    const SquarePoint at = square_from_direction(sample.direction);
    const double sine = std::hypot(sample.direction.x, sample.direction.y);
    const double turn = sine > 0.0 ? std::min(rounding_ / (2.0 * kPi * sine), 0.5) : 0.5;
    const Cells s = cells_of(at.s, extent_.width, turn, true);
    const Cells t = cells_of(at.t, extent_.height, rounding_ / kPi, false);
    TexelSample best = placed(s, t, s.own, t.own, sample.pdf);
    if (s.other == s.own && t.other == t.own) return best;
    double least = misfit(best);
    for (const auto& [x, y] :
         {std::pair(s.other, t.own), std::pair(s.own, t.other), std::pair(s.other, t.other)}) {
      const TexelSample candidate = placed(s, t, x, y, sample.pdf);
      const double its = misfit(candidate);
      if (its < least) {
        least = its;
        best = candidate;
      }
    }
    return best;
  }

 private:
  TexelSample placed(const Cells& s, const Cells& t, int x, int y, PerSteradian pdf) const {
    const SquarePoint at = {inside(s, x, extent_.width), inside(t, y, extent_.height)};
    return {at, x, y, to_square(pdf, at)};
  }

  /// How badly a texel fits a sample: by the ratio of densities, or else by its own.
  double misfit(const TexelSample& sample) const {
    const double declared = declared_density(*expectation_, sample.at, sample.x, sample.y);
    if (!(declared > 0.0)) return std::numeric_limits<double>::infinity();
    return std::isnan(sample.pdf.value) ? 1.0 / declared
                                        : std::abs(std::log(sample.pdf.value / declared));
  }

  const Expectation* expectation_;
  Extent extent_;
  double rounding_;
};

/// What a sample's density says beside the declared one.
void add_sample(DensityComparison& found, double& worst, const ComparedCell& cell, double tolerance,
                const Mapping& mapping) {
  if (!(cell.declared > 0.0)) {
    if (found.unlit_cells++ == 0) found.first_unlit = cell;
    return;
  }
  const double over = std::abs(found.add_ratio(cell, mapping) - 1.0) / tolerance;
  if (over <= 1.0) return;  // false for NaN
  ++found.cells_off;
  if (found.worst && !(over > worst)) return;
  worst = over;
  found.worst = cell;
}

}  // namespace

BoundSampler bound_dump(std::shared_ptr<const SampleDump> dump,
                        std::shared_ptr<const Expectation> expectation) {
  BoundSampler sampler;
  sampler.count = dump->count();
  sampler.has_weights = dump->has_pdf();
  sampler.sample_in_order = [dump, expectation](std::uint64_t first,
                                                std::span<TexelSample> samples) {
    const Placement place(*expectation, dump->rounding());
    std::vector<DumpedSample> block(std::min(samples.size(), kBlock));
    for (std::size_t done = 0; done < samples.size(); done += kBlock) {
      const std::size_t count = std::min(kBlock, samples.size() - done);
      dump->read(first + done, std::span(block).first(count));
      for (std::size_t i = 0; i < count; ++i) samples[done + i] = place(block[i]);
    }
  };
  return sampler;
}

DensityComparison compare_dumped_density(const SampleDump& dump, const Expectation& expectation,
                                         double tolerance) {
  const Placement place(expectation, dump.rounding());
  DensityComparison found;
  found.compared = "samples";
  double worst = 0.0;
  std::vector<DumpedSample> block(kBlock);
  const std::uint64_t blocks = (dump.count() + kBlock - 1) / kBlock;
  const std::uint64_t step = std::max<std::uint64_t>(1, blocks * kBlock / kMostCompared);
  for (std::uint64_t number = 0; number < blocks; number += step) {
    const std::uint64_t first = number * kBlock;
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, dump.count() - first));
    dump.read(first, std::span(block).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const TexelSample sample = place(block[i]);
      if (!std::isfinite(sample.at.s)) continue;
      const double declared = declared_density(expectation, sample.at, sample.x, sample.y);
      // Beside a pole the sine, by which densities over the square are divided, is rounded too.
      const double sine = sin_theta(sample.at.t);
      add_sample(found, worst, {sample.x, sample.y, sample.at, sample.pdf.value, declared},
                 tolerance + 2.0 * dump.rounding() / sine, expectation.mapping);
    }
  }
  return found;
}

}  // namespace lightproof
