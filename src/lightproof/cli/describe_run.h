// What a run is made with, as its results say it.
#pragma once

#include <span>

#include "common.h"
#include "lightproof/core/run_description.h"
#include "lightproof/image/environment_map.h"

namespace lightproof::cli {

/// Version and commit of this program, and the command line.
RunDescription describe_run(const CommandLine& line);

/// Version and commit of this program, the command line, and the maps as they were read.
RunDescription describe_run(const CommonOptions& options, std::span<const EnvironmentMap> maps);
/// Version and commit of this program, the command line, and maps that are described already, see
/// RunDescription::maps.
RunDescription describe_run(const CommonOptions& options, std::vector<std::string> maps);

}  // namespace lightproof::cli
