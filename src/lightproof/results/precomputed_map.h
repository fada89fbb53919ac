// The maps that were made of an environment map for real-time rendering, and how exact they are.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/image/brdf_map.h"
#include "lightproof/image/map_levels.h"

namespace lightproof {

/// An error estimated from texels drawn at random, with the limits of its confidence interval. All
/// three are relative, as Precomputation::error_measure says to what.
struct LevelError {
  double error = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::size_t texels = 0;  ///< that were looked at
};

struct PrecomputedMap {
  std::string name;  ///< "specular"; unique in the precomputation
  MapLevels map;
  /// One a level, none where it was not measured; or none at all.
  std::vector<std::optional<LevelError>> errors = {};
  std::vector<std::string> files = {};  ///< names of those that hold it
  std::vector<std::string> notes = {};  ///< what a reader should know: one sentence each
};

struct PrecomputedBrdfMap {
  std::string name;
  BrdfMap map;
  std::optional<LevelError> error = std::nullopt;
  std::vector<std::string> files = {};
  std::vector<std::string> notes = {};
};

struct Precomputation {
  std::string source;  ///< the environment map, as the user called it
  std::vector<PrecomputedMap> maps;
  std::optional<PrecomputedBrdfMap> brdf_map = std::nullopt;
  /// What the errors are, as a sentence: "Root mean square over texels …, with 95 % limits."
  std::string error_measure = {};
  std::string version = {};  ///< of Lightproof
};

}  // namespace lightproof
