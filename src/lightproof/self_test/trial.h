// What the gate is tested on itself with: a declared distribution, a sampler of it or of another
// one, and replicates of its tests.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/core/progress.h"
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

/// Runs body(0) … body(count-1) in parallel and tells how far it is.
template <class Body>
void for_each_replicate(std::uint64_t count, const Progress& progress, const Body& body) {
  std::mutex mutex;
  std::uint64_t done = 0;
  parallel_for(count, [&](std::size_t i) {
    body(i);
    if (!progress) return;
    const std::lock_guard lock(mutex);
    if (++done % 64 == 0) {
      progress("self-test", static_cast<double>(done) / static_cast<double>(count));
    }
  });
}

}  // namespace lightproof
