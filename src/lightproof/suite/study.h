// The main job: everything Lightproof can say about a set of maps.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "lightproof/suite/convergence.h"
#include "lightproof/suite/gate.h"
#include "lightproof/suite/renders.h"

namespace lightproof {

struct StudyOptions {
  GateOptions gate;
  ConvergenceOptions convergence;
  RenderOptions renders;
  /// The benchmark program; without it the throughput is left out.
  std::optional<std::filesystem::path> benchmarks;
};

/// A map's figures and some hundred points that binary_search draws from it.
MapRecord describe_map(const EnvironmentMap& map, std::uint64_t seed);

StudyResult run_study(std::vector<EnvironmentMap> maps, const StudyOptions& options,
                      const Progress& progress = {});

}  // namespace lightproof
