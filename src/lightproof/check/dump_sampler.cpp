#include "lightproof/check/dump_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lightproof/samplers/texel_positions.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

constexpr std::size_t kBlock = 4096;
constexpr std::uint64_t kMostCompared = std::uint64_t{1} << 22U;

/// Directions around one, on a circle: an edge within the rounding of a direction lies between it
/// and one of as many on a circle that is so much larger.
constexpr int kAround = 8;
const double kBeyond = 1.0 / std::cos(kPi / kAround);

/// Two unit vectors that are perpendicular to a unit vector and to each other.
std::array<Direction, 2> across(Direction d) {
  const Direction other = std::abs(d.z) < 0.5 ? Direction(0.0, 0.0, 1.0) : Direction(1.0, 0.0, 0.0);
  const Direction first = glm::normalize(glm::cross(d, other));
  return {first, glm::cross(d, first)};
}

/// A coordinate as samplers place it: away from the edges of its cell.
double away_from_edges(double coordinate, int cell, int count) {
  return position_in_cell(cell, coordinate * count - cell, count);
}

bool is_near_edge(double coordinate, double reach, int count) {
  const double at = coordinate * count;
  return !(std::abs(at - std::round(at)) > reach * count);
}

class TexelLocator {
 public:
  TexelLocator(const Expectation& expectation, double rounding)
      : expectation_(&expectation),
        mapping_(expectation.mapping),
        extent_(expectation.masses.extent()),
        rounding_(rounding) {}

  TexelSample operator()(const DumpedSample& sample) const {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(sample.direction.x)) return {{kNaN, kNaN}, -1, -1, {kNaN}};
    TexelSample best = placed(sample.direction, sample.pdf);
    if (!is_near_edges(best.at)) return best;
    double least = misfit(best);
    const auto [first, second] = across(sample.direction);
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * kPi * k / kAround;
      const Direction turned = glm::normalize(
          sample.direction +
          rounding_ * kBeyond * (std::cos(angle) * first + std::sin(angle) * second));
      const TexelSample candidate = placed(turned, sample.pdf);
      if (candidate.x == best.x && candidate.y == best.y) continue;
      const double its = misfit(candidate);
      if (its < least) {
        least = its;
        best = candidate;
      }
    }
    return best;
  }

 private:
  TexelSample placed(Direction d, PerSteradian pdf) const {
    const SquarePoint of_direction = square_point_of(mapping_, d);
    const int x = cell_of(of_direction.s, extent_.width);
    const int y = cell_of(of_direction.t, extent_.height);
    const SquarePoint at = {away_from_edges(of_direction.s, x, extent_.width),
                            away_from_edges(of_direction.t, y, extent_.height)};
    return {at, x, y, {pdf.value * solid_angle_per_square(mapping_, at)}};
  }

  bool is_near_edges(SquarePoint at) const {
    const TurnEffect turn = effect_of_turn(mapping_, at);
    return is_near_edge(at.s, rounding_ * turn.s, extent_.width) ||
           is_near_edge(at.t, rounding_ * turn.t, extent_.height);
  }

  /// How badly a texel fits a sample: by the ratio of densities, or else by its own.
  double misfit(const TexelSample& sample) const {
    const double declared = declared_density(*expectation_, sample.at, sample.x, sample.y);
    if (!(declared > 0.0)) return std::numeric_limits<double>::infinity();
    return std::isnan(sample.pdf.value) ? 1.0 / declared
                                        : std::abs(std::log(sample.pdf.value / declared));
  }

  const Expectation* expectation_;
  Mapping mapping_;
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
    const TexelLocator located(*expectation, dump->rounding());
    std::vector<DumpedSample> block(std::min(samples.size(), kBlock));
    for (std::size_t done = 0; done < samples.size(); done += kBlock) {
      const std::size_t count = std::min(kBlock, samples.size() - done);
      dump->read(first + done, std::span(block).first(count));
      for (std::size_t i = 0; i < count; ++i) samples[done + i] = located(block[i]);
    }
  };
  return sampler;
}

DensityComparison compare_dumped_density(const SampleDump& dump, const Expectation& expectation,
                                         double tolerance) {
  const TexelLocator located(expectation, dump.rounding());
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
      const TexelSample sample = located(block[i]);
      if (!std::isfinite(sample.at.s)) continue;
      const double declared = declared_density(expectation, sample.at, sample.x, sample.y);
      // Where the Jacobian changes, the one by which densities over the square are divided is that
      // of a rounded direction too.
      const double jacobian = effect_of_turn(expectation.mapping, sample.at).jacobian;
      add_sample(found, worst, {sample.x, sample.y, sample.at, sample.pdf.value, declared},
                 tolerance + 2.0 * dump.rounding() * jacobian, expectation.mapping);
    }
  }
  return found;
}

}  // namespace lightproof
