#include "lightproof/self_test/mutant.h"

#include <memory>

#include "lightproof/gate/alternative_distribution.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

/// Sums of a DiscreteSampler are doubles.
constexpr double kSumResolution = 0x1p-53;

BoundSampler bind(const Mutant& mutant, TargetDensity target, const EnvironmentMap& map) {
  Grid<double> masses = reference::texel_masses(map, target);
  if (!mutant.distribution.empty())
    masses = alternative_distribution(mutant.distribution).masses({&masses, &map, target});
  const bool is_square = (position_measure(target.density_space, map.mapping) ==
                          MapMeasure::square) != mutant.other_measure;
  const auto correct = std::make_shared<const DiscreteSampler>(
      std::move(masses), is_square ? MapMeasure::square : MapMeasure::solid_angle, map.mapping);
  const double factor = mutant.pdf_factor ? mutant.pdf_factor(*correct) : 1.0;
  return {[correct, &mutant, factor](std::span<const SquarePoint> points,
                                     std::span<TexelSample> samples) {
            for (std::size_t i = 0; i < points.size(); ++i) {
              const SquarePoint u = mutant.numbers ? mutant.numbers(points, i) : points[i];
              samples[i] = mutant.draw ? mutant.draw(*correct, u) : correct->sample(u);
              if (mutant.sample) mutant.sample(samples[i], *correct);
              samples[i].pdf.value *= factor;
            }
          },
          [correct, &mutant, factor](SquarePoint at) {
            const PerSquare pdf = mutant.pdf ? mutant.pdf(*correct, at) : correct->pdf(at);
            return PerSquare{factor * pdf.value};
          }};
}

}  // namespace

SamplerUnderTest sampler_under_test(const Mutant& mutant, DensitySpace density_space) {
  const TargetDensity target = {density_space, kRec709};
  return {std::string(mutant.name),
          target,
          false,
          false,
          [&mutant, target](const EnvironmentMap& map) {
            return bind(mutant, on_map(target, map), map);
          },
          kSumResolution,
          true,
          nullptr,
          [&mutant](const Mapping& mapping) {
            const std::string_view reason = why_meaningless(mutant.mapping_need, mapping);
            if (!reason.empty() || mutant.distribution.empty()) return reason;
            return why_meaningless(alternative_distribution(mutant.distribution).need, mapping);
          }};
}

}  // namespace lightproof
