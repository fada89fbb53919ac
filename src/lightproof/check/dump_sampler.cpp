#include "lightproof/check/dump_sampler.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lightproof/check/texel_locator.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

constexpr std::size_t kBlock = 4096;
constexpr std::uint64_t kMostCompared = std::uint64_t{1} << 22U;

TexelLocator locator_of(const SampleDump& dump, const Expectation& expectation) {
  return {expectation.mapping, expectation.masses.extent(), dump.rounding(),
          [&expectation](SquarePoint at, int x, int y) {
            return declared_density(expectation, at, x, y);
          }};
}

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
    const TexelLocator located = locator_of(*dump, *expectation);
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
  const TexelLocator located = locator_of(dump, expectation);
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
