#include "describe_run.h"

#include "lightproof_commit.h"

namespace lightproof::cli {
namespace {

MapOfRun describe(const EnvironmentMap& map, const CommonOptions& options) {
  const bool asked = !options.preset.empty() && !is_built_in(map.source);
  return {map.name, map.source, map.radiance.extent(),
          asked ? std::optional(options.preset) : std::nullopt, map.notes};
}

}  // namespace

RunDescription describe_run(const CommonOptions& options, std::span<const EnvironmentMap> maps) {
  RunDescription run{LIGHTPROOF_VERSION, LIGHTPROOF_COMMIT, text_of(options.command_line)};
  for (const EnvironmentMap& map : maps) run.maps.push_back(describe(map, options));
  return run;
}

}  // namespace lightproof::cli
