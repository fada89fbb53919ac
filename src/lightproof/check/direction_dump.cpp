#include "lightproof/check/direction_dump.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "lightproof/check/compared_samples.h"
#include "lightproof/gate/density_check.h"

namespace lightproof {
namespace {

/// Directions as samples of the square of a distribution.
class DirectionPlacement {
 public:
  DirectionPlacement(const DirectionDistribution& distribution, const Expectation& expectation,
                     double rounding)
      : distribution_(&distribution), expectation_(&expectation), rounding_(rounding) {}

  TexelSample placed(Direction d, PerSteradian pdf) const {
    return std::visit(
        [&](const auto& of) {
          return sample_of(of, expectation_->masses.extent(), DrawnDirection{d, pdf});
        },
        *distribution_);
  }

  bool can_be_drawn(const TexelSample& sample) const {
    return sample.x >= 0 && expectation_->masses(sample.x, sample.y) > 0.0;
  }

  TexelSample operator()(const DumpedSample& sample) const {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(sample.direction.x)) return {{kNaN, kNaN}, -1, -1, {kNaN}};
    TexelSample best = placed(sample.direction, sample.pdf);
    if (can_be_drawn(best)) return best;
    visit_around(sample.direction, rounding_, [&](Direction turned) {
      if (can_be_drawn(best)) return;
      const TexelSample candidate = placed(turned, sample.pdf);
      if (can_be_drawn(candidate)) best = candidate;
    });
    return best;
  }

 private:
  const DirectionDistribution* distribution_;
  const Expectation* expectation_;
  double rounding_;
};

/// The declared density and the sample's own, both per steradian. Where they differ by more than
/// the tolerance, the declared one is that of the direction within the rounding at which they
/// differ least.
ComparedCell nearest_density(const DirectionDistribution& distribution, const TexelSample& placed,
                             const DumpedSample& sample, double rounding, double tolerance) {
  ComparedCell cell{placed.x, placed.y, placed.at, sample.pdf.value,
                    density_of(distribution, sample.direction)};
  if (std::abs(cell.pdf - cell.declared) <= tolerance * cell.declared) return cell;
  double least = cell.declared;
  double most = cell.declared;
  visit_around(sample.direction, rounding, [&](Direction turned) {
    const double declared = density_of(distribution, turned);
    least = std::min(least, declared);
    most = std::max(most, declared);
  });
  if (least <= cell.pdf && cell.pdf <= most) {
    cell.declared = cell.pdf;
  } else if (std::isfinite(cell.pdf)) {
    cell.declared = cell.pdf < least ? least : most;
  }
  return cell;
}

}  // namespace

TestCase direction_test_case(std::shared_ptr<const SampleDump> dump, const DirectionTarget& target,
                             const DumpClaim& claim) {
  const auto claimed = [distribution = target.distribution](const auto& function) {
    return std::visit(function, distribution);
  };
  const std::shared_ptr<const Expectation> expectation =
      claimed([](const auto& of) { return expectation_of(of); });
  const auto kept = std::make_shared<const DirectionTarget>(target);
  TestCase test_case;
  test_case.map = kDirections;
  test_case.source = target.name;
  test_case.expectation = [expectation] { return expectation; };
  test_case.alternatives = [claimed, kept] {
    auto alternatives = claimed([](const auto& of) { return alternatives_to(of); });
    alternatives.insert(alternatives.end(), kept->mistakes.begin(), kept->mistakes.end());
    return alternatives;
  };
  SamplerInstance instance;
  instance.name = claim.name;
  instance.resolution = 0.0;
  instance.bind = [dump, kept, expectation] {
    BoundSampler sampler;
    sampler.count = dump->count();
    sampler.has_weights = dump->has_pdf();
    sampler.sample_in_order = [dump, kept, expectation](std::uint64_t first,
                                                        std::span<TexelSample> samples) {
      const DirectionPlacement place(kept->distribution, *expectation, dump->rounding());
      std::vector<DumpedSample> block(std::min(samples.size(), kSampleBlock));
      for (std::size_t done = 0; done < samples.size(); done += kSampleBlock) {
        const std::size_t count = std::min(kSampleBlock, samples.size() - done);
        dump->read(first + done, std::span(block).first(count));
        for (std::size_t i = 0; i < count; ++i) samples[done + i] = place(block[i]);
      }
    };
    return sampler;
  };
  instance.inspect = [dump, kept, tolerance = claim.pdf_tolerance](const BoundSampler& sampler,
                                                                   const Expectation& exact,
                                                                   const MassRounding& rounding) {
    Inspection inspection = inspect(sampler, exact, rounding);
    inspection.compares_samples = sampler.has_weights;
    if (inspection.compares_samples) {
      inspection.density = compare_direction_density(*dump, *kept, exact, tolerance);
    }
    return inspection;
  };
  test_case.instances.push_back(std::move(instance));
  return test_case;
}

DensityComparison compare_direction_density(const SampleDump& dump, const DirectionTarget& target,
                                            const Expectation& expectation, double tolerance) {
  const DirectionPlacement place(target.distribution, expectation, dump.rounding());
  ComparedSamples compared(expectation.mapping);
  visit_spread(dump, [&](std::uint64_t /*first*/, std::span<const DumpedSample> samples) {
    for (const DumpedSample& sample : samples) {
      const TexelSample placed = place(sample);
      if (!place.can_be_drawn(placed)) continue;
      compared.add(nearest_density(target.distribution, placed, sample, dump.rounding(), tolerance),
                   tolerance);
    }
  });
  return compared.result();
}

}  // namespace lightproof
