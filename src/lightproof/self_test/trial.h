// What the gate is tested on itself with: a declared distribution, a sampler of it or of another
// one, and replicates of its tests.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lightproof/gate/test_run.h"

namespace lightproof {

/// The target density that trials declare.
inline constexpr TargetDensity kTrialTarget = {DensitySpace::solid_angle, kRec709};

/// A distribution whose bins are all likely enough to be tested alone, and a sampler of masses that
/// may be another's.
struct Trial {
  std::shared_ptr<const Expectation> expectation;
  Grid<double> drawn;  ///< masses of texels that are drawn
  Inspection inspection;
  TestCase test_case;

  /// Draws `masses` of texels where those of the map are declared.
  Trial(const EnvironmentMap& map, Grid<double> masses);
};

/// The map of all trials. Every bin is likely enough to be tested alone, and nothing is alike in
/// either direction.
EnvironmentMap calibration_map();

/// A trial that draws what it declares.
Trial correct_trial();

/// The tests of the first stage on samples drawn anew.
std::vector<Measured> run_once(const Trial& trial, std::uint64_t samples, std::uint64_t seed);

}  // namespace lightproof
