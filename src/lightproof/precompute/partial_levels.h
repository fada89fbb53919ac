// What is kept of work that was interrupted, so that a later run goes on where it stopped.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/image/environment_map.h"
#include "lightproof/image/map_levels.h"
#include "lightproof/precompute/request.h"

namespace lightproof {

/// Names a request on a map: the same text means the same levels, to the last bit.
std::string fingerprint_of(const EnvironmentMap& map, const PrecomputeRequest& request);

/// Where the work of a result folder is kept meanwhile: beside it, "maps.partial".
std::filesystem::path partial_folder_of(const std::filesystem::path& folder);

/// Finished parts of the work in a folder of their own: a file each, which is there complete or not
/// at all.
class PartialLevels {
 public:
  /// Makes the folder. Throws InputError if it cannot be made or written.
  PartialLevels(std::filesystem::path folder, std::string fingerprint);

  /// The levels that a run with the same fingerprint has kept under this name; none if there is no
  /// such file, or one of other work, or a damaged one.
  std::optional<std::vector<MapLevel>> find(const std::string& name) const;

  /// Throws InputError if the disk is full.
  void keep(const std::string& name, const std::vector<MapLevel>& levels) const;

  /// Once the results are written.
  void remove() const;

 private:
  std::filesystem::path file_of(const std::string& name) const;

  std::filesystem::path folder_;
  std::string fingerprint_;
};

}  // namespace lightproof
