#include "lightproof/mutants/mutant.h"

#include <memory>

#include "lightproof/suite/alternative_law.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

/// Sums of a LawSampler are doubles.
constexpr double kLawResolution = 0x1p-53;

BoundSampler bind(const Mutant& mutant, TargetDensity target, const EnvironmentMap& map) {
  Grid<double> masses = reference::texel_masses(map, target);
  if (!mutant.law.empty()) masses = alternative_law(mutant.law).masses({&masses, &map, target});
  const auto sound = std::make_shared<const LawSampler>(std::move(masses), target.weighting);
  const double factor = mutant.pdf_factor ? mutant.pdf_factor(*sound) : 1.0;
  return {[sound, &mutant, factor](std::span<const SquarePoint> points,
                                   std::span<TexelSample> samples) {
            for (std::size_t i = 0; i < points.size(); ++i) {
              const SquarePoint u = mutant.numbers ? mutant.numbers(points, i) : points[i];
              samples[i] = mutant.draw ? mutant.draw(*sound, u) : sound->sample(u);
              if (mutant.sample) mutant.sample(samples[i], *sound);
              samples[i].pdf.value *= factor;
            }
          },
          [sound, &mutant, factor](SquarePoint at) {
            const PerSquare pdf = mutant.pdf ? mutant.pdf(*sound, at) : sound->pdf(at);
            return PerSquare{factor * pdf.value};
          }};
}

}  // namespace

Subject subject_of(const Mutant& mutant, Weighting weighting) {
  const TargetDensity target = {weighting, kRec709};
  return {std::string(mutant.name),
          target,
          false,
          false,
          [&mutant, target](const EnvironmentMap& map) {
            return bind(mutant, on_map(target, map), map);
          },
          kLawResolution,
          true};
}

}  // namespace lightproof
