// Everything that shows whether the gate can be trusted, at once.
#pragma once

#include <cstdint>
#include <span>
#include <tuple>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/map_record.h"
#include "lightproof/results/self_test_result.h"
#include "lightproof/self_test/calibration.h"
#include "lightproof/self_test/kill_matrix.h"
#include "lightproof/self_test/naming.h"
#include "lightproof/self_test/power.h"

namespace lightproof {

struct SelfTestOptions {
  CalibrationOptions calibration;
  PowerOptions power;
  KillOptions kills;
  NamingOptions naming;

  static auto fields(auto& options) {
    return std::tie(options.calibration, options.power, options.kills, options.naming);
  }
};

/// The options of the self-test that a report shows, with this seed throughout.
SelfTestOptions self_test_options(std::uint64_t seed);

/// Calibration, power and mutants: what the program and its options determine, whatever the maps.
SelfTestResult test_program(const SelfTestOptions& options, const Progress& progress = {},
                            const Communicator& communicator = {});

/// Calibration, power and mutants, and the names that the gate gives to mutants on these maps.
/// Every map adds some runs of the gate on all mutants.
SelfTestResult run_self_test(std::span<const MapRecord> maps, const SelfTestOptions& options,
                             const Progress& progress = {}, const Communicator& communicator = {});

}  // namespace lightproof
