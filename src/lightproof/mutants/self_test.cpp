#include "lightproof/mutants/self_test.h"

#include "lightproof/mutants/kill_matrix.h"
#include "lightproof/suite/calibration.h"
#include "lightproof/suite/power.h"

namespace lightproof {

SelfTestResult run_self_test(std::uint64_t seed, const Progress& progress) {
  CalibrationOptions calibration;
  calibration.seed = seed;
  PowerOptions power;
  power.seed = seed;
  // Shares of the time that each part takes.
  return {calibrate(calibration, part_of(progress, 0.0, 0.3)),
          measure_power(power, part_of(progress, 0.3, 0.4)),
          measure_kills(seed, part_of(progress, 0.4, 1.0))};
}

}  // namespace lightproof
