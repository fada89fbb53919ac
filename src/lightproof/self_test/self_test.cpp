#include "lightproof/self_test/self_test.h"

#include "lightproof/self_test/calibration.h"
#include "lightproof/self_test/kill_matrix.h"
#include "lightproof/self_test/naming.h"
#include "lightproof/self_test/power.h"

namespace lightproof {

SelfTestResult run_self_test(std::span<const MapRecord> maps, std::uint64_t seed,
                             const Progress& progress) {
  CalibrationOptions calibration;
  calibration.seed = seed;
  PowerOptions power;
  power.seed = seed;
  NamingOptions naming;
  naming.seed = seed;
  // Shares of the time that each part takes.
  return {calibrate(calibration, part_of(progress, 0.0, 0.15)),
          measure_power(power, part_of(progress, 0.15, 0.2)),
          measure_kills(seed, part_of(progress, 0.2, 0.5)),
          measure_naming(maps, naming, named(part_of(progress, 0.5, 1.0), "self-test"))};
}

}  // namespace lightproof
