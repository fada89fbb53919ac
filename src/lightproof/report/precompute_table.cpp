#include "lightproof/report/precompute_table.h"

#include <fmt/format.h>

#include "lightproof/page/numbers.h"
#include "lightproof/page/text_table.h"

namespace lightproof {
namespace {

std::string size_of(Extent extent) { return fmt::format("{}x{}", extent.width, extent.height); }

/// "0.0012 (0.0009 to 0.0015)"; "not measured".
std::string text_of(const std::optional<LevelError>& error) {
  if (!error) return "not measured";
  return fmt::format("{} ({} to {})", significant(error->error), significant(error->low),
                     significant(error->high));
}

}  // namespace

std::string precompute_table(const Precomputation& made) {
  TextRows rows = {{"map", "level", "size", "roughness", "error (95 % limits)"}};
  for (const PrecomputedMap& map : made.maps) {
    for (std::size_t i = 0; i < map.map.levels.size(); ++i) {
      const MapLevel& level = map.map.levels[i];
      rows.push_back({map.name, std::to_string(i), size_of(level.faces.front().extent()),
                      level.roughness ? significant(*level.roughness) : "",
                      text_of(i < map.errors.size() ? map.errors[i] : std::nullopt)});
    }
  }
  if (made.brdf_map) {
    rows.push_back({made.brdf_map->name, "", size_of(made.brdf_map->map.values.extent()), "",
                    text_of(made.brdf_map->error)});
  }
  std::string text;
  for (const std::string& line : aligned_lines(rows)) text += line + "\n";
  return text;
}

}  // namespace lightproof
