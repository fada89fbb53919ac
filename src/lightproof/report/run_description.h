// What a run was made with, for whoever finds its results later.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

/// A map as it was read.
struct MapOfRun {
  std::string name;                   ///< unique in the run
  std::string source;                 ///< the path, or the name of a built-in map
  Extent extent;                      ///< in texels, after it was brought into latitude-longitude
  std::optional<std::string> preset;  ///< the convention that was asked for; none: not asked
  std::vector<std::string> notes;     ///< what the reader changed or assumed, one sentence each
};

struct RunDescription {
  std::string version;  ///< of Lightproof
  std::string commit;   ///< that it was built from; empty if it is not known
  std::string command;  ///< the command line, quoted for a shell
  std::vector<MapOfRun> maps = {};
};

}  // namespace lightproof
