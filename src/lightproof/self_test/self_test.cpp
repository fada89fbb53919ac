#include "lightproof/self_test/self_test.h"

namespace lightproof {

SelfTestOptions self_test_options(std::uint64_t seed) {
  SelfTestOptions options;
  options.calibration.seed = options.power.seed = options.kills.seed = options.naming.seed = seed;
  return options;
}

SelfTestResult test_program(const SelfTestOptions& options, const Progress& progress,
                            const Communicator& communicator) {
  // Shares of the time that each part takes.
  SelfTestResult result;
  result.calibration = calibrate(options.calibration, part_of(progress, 0.0, 0.5), communicator);
  result.power = measure_power(options.power, part_of(progress, 0.5, 0.6), communicator);
  result.mutants = measure_kills(options.kills, part_of(progress, 0.6, 1.0), communicator);
  return result;
}

SelfTestResult run_self_test(std::span<const MapRecord> maps, const SelfTestOptions& options,
                             const Progress& progress, const Communicator& communicator) {
  SelfTestResult result = test_program(options, part_of(progress, 0.0, 0.7), communicator);
  result.naming = measure_naming(maps, options.naming,
                                 named(part_of(progress, 0.7, 1.0), "self-test"), communicator);
  return result;
}

}  // namespace lightproof
