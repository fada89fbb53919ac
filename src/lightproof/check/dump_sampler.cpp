#include "lightproof/check/dump_sampler.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lightproof/check/compared_samples.h"
#include "lightproof/check/lat_long_positions.h"
#include "lightproof/check/texel_locator.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

TexelLocator locator_of(const Expectation& expectation, double rounding) {
  return {expectation.mapping, expectation.masses.extent(), rounding,
          [&expectation](SquarePoint at, int x, int y) {
            return declared_density(expectation, at, x, y);
          }};
}

}  // namespace

BoundSampler bound_dump(std::shared_ptr<const SampleDump> dump,
                        std::shared_ptr<const Expectation> expectation) {
  BoundSampler sampler;
  sampler.count = dump->count();
  sampler.has_weights = dump->has_pdf();
  sampler.sample_in_order = [dump, expectation](std::uint64_t first,
                                                std::span<TexelSample> samples) {
    const TexelLocator located = locator_of(*expectation, dump->rounding());
    std::vector<DumpedSample> block(std::min(samples.size(), kSampleBlock));
    LatLongPositions positions(block.size());
    for (std::size_t done = 0; done < samples.size(); done += kSampleBlock) {
      const std::size_t count = std::min(kSampleBlock, samples.size() - done);
      dump->read(first + done, std::span(block).first(count));
      located(std::span<const DumpedSample>(block).first(count), samples.subspan(done, count),
              positions);
    }
  };
  return sampler;
}

DensityComparison compare_dumped_density(const SampleDump& dump, const Expectation& expectation,
                                         double tolerance) {
  const TexelLocator located = locator_of(expectation, dump.rounding());
  ComparedSamples compared(expectation.mapping);
  LatLongPositions positions(kSampleBlock);
  std::vector<TexelSample> placed(kSampleBlock);
  visit_spread(dump, [&](std::uint64_t /*first*/, std::span<const DumpedSample> samples) {
    located(samples, std::span(placed).first(samples.size()), positions);
    for (const TexelSample& sample : std::span(placed).first(samples.size())) {
      if (!std::isfinite(sample.at.s)) continue;
      const double declared = declared_density(expectation, sample.at, sample.x, sample.y);
      const ComparedCell cell = {sample.x, sample.y, sample.at, sample.pdf.value, declared};
      // Where the Jacobian changes, the one by which densities over the square are divided is that
      // of a rounded direction too.
      const bool needs_more = !(std::abs(cell.pdf - declared) <= tolerance * declared);
      const double more = needs_more ? 2.0 * dump.rounding() *
                                           effect_of_turn(expectation.mapping, sample.at).jacobian
                                     : 0.0;
      compared.add(cell, tolerance + more);
    }
  });
  return compared.result();
}

ComparedCell compared_at(const DumpedSample& sample, const Expectation& expectation,
                         double rounding) {
  const TexelSample placed = locator_of(expectation, rounding)(sample);
  return {placed.x, placed.y, placed.at, placed.pdf.value,
          declared_density(expectation, placed.at, placed.x, placed.y)};
}

std::vector<ComparedCell> some_densities(const SampleDump& dump, const Expectation& expectation,
                                         std::size_t count) {
  const TexelLocator located = locator_of(expectation, dump.rounding());
  std::vector<DumpedSample> samples(
      static_cast<std::size_t>(std::min<std::uint64_t>(count, dump.count())));
  dump.read(0, samples);
  std::vector<ComparedCell> cells;
  for (const DumpedSample& dumped : samples) {
    const TexelSample sample = located(dumped);
    if (!std::isfinite(sample.at.s)) continue;
    const double declared = declared_density(expectation, sample.at, sample.x, sample.y);
    if (declared > 0.0) {
      cells.push_back({sample.x, sample.y, sample.at, sample.pdf.value, declared});
    }
  }
  return cells;
}

}  // namespace lightproof
