// Every method against every hard input that it applies to, and where each method first fails.
#pragma once

#include <string>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/stability_result.h"
#include "lightproof/stability/stability_case.h"

namespace lightproof {

/// What is tried.
struct StabilityOptions {
  TrialOptions trial = {};
  /// Names or numbers of cases; empty: all of them.
  std::vector<std::string> cases = {};
  /// Names of methods, of samplers of maps with or without their density; empty: all of them.
  std::vector<std::string> methods = {};
  bool breaking_points = false;  ///< whether breaking points are searched
};

/// Puts the inputs into the methods, a cell of work each, whose key is
/// "stability/CASE/KIND/METHOD"; the same bits for any number of threads. Throws InputError, which
/// says what there is, if no case or no method has one of the names.
StabilityResult run_stability(const StabilityMethods& methods, const StabilityOptions& options,
                              const Progress& progress = {}, const Communicator& communicator = {});

/// All cases, methods and breaking points in the quick form, kept for the same program and seed.
StabilityResult kept_stability(std::uint64_t seed, const MeasurementCache& cache,
                               const Progress& progress = {});

}  // namespace lightproof
