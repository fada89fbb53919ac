// What a run was made with, for whoever finds its results later.
#pragma once

#include <string>
#include <vector>

namespace lightproof {

/// What a run was made with.
struct RunDescription {
  std::string version;  ///< Lightproof's version, "0.1.0"
  std::string commit;   ///< commit that it was built from; empty if it is not known
  std::string command;  ///< the command line, quoted for a shell
  /// One JSON object for each map, as json_of() writes it (image/map_description.h).
  std::vector<std::string> maps = {};
};

}  // namespace lightproof
