// What hard inputs made of methods, as JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lightproof/core/run_description.h"
#include "lightproof/results/stability_result.h"

namespace lightproof {

/// Cases, records and breaking points.
nlohmann::ordered_json stability_parts_json(const StabilityResult& stability);

/// How a run was asked for.
struct StabilityRun {
  std::uint64_t seed = 1;
  bool thorough = false;
};

/// docs/schema/stability.schema.json describes it.
std::string stability_json(const StabilityResult& stability, const StabilityRun& asked,
                           const RunDescription& run);

}  // namespace lightproof
