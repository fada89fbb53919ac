#include "describe_run.h"

#include <utility>

#include "lightproof/image/map_description.h"
#include "lightproof_commit.h"

namespace lightproof::cli {

RunDescription describe_run(const CommandLine& line) {
  return {LIGHTPROOF_VERSION, LIGHTPROOF_COMMIT, text_of(line)};
}

RunDescription describe_run(const CommonOptions& options, std::span<const EnvironmentMap> maps) {
  RunDescription run = describe_run(options.command_line);
  for (const EnvironmentMap& map : maps) run.maps.push_back(json_of(describe(map)));
  return run;
}

RunDescription describe_run(const CommonOptions& options, std::vector<std::string> maps) {
  RunDescription run = describe_run(options.command_line);
  run.maps = std::move(maps);
  return run;
}

}  // namespace lightproof::cli
