#include "lightproof/report/precompute_json.h"

#include <nlohmann/json.hpp>

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(Extent extent) { return Json::array({extent.width, extent.height}); }

Json json_of(const std::optional<LevelError>& error) {
  if (!error) return nullptr;
  return {{"value", error->error},
          {"low", error->low},
          {"high", error->high},
          {"texels", error->texels}};
}

Json json_of(const Attributes& attributes) {
  Json object = Json::object();
  for (const Attribute& attribute : attributes) object[attribute.name] = attribute.value;
  return object;
}

Json levels_of(const PrecomputedMap& made) {
  Json levels = Json::array();
  for (std::size_t i = 0; i < made.map.levels.size(); ++i) {
    const MapLevel& level = made.map.levels[i];
    levels.push_back({{"size", json_of(level.faces.front().extent())},
                      {"roughness", level.roughness ? Json(*level.roughness) : Json(nullptr)},
                      {"error", i < made.errors.size() ? json_of(made.errors[i]) : Json(nullptr)}});
  }
  return levels;
}

Json json_of(const PrecomputedMap& made) {
  return {{"name", made.name},         {"projection", info(made.map.projection).name},
          {"levels", levels_of(made)}, {"attributes", json_of(made.map.attributes)},
          {"files", made.files},       {"notes", made.notes}};
}

Json json_of(const PrecomputedBrdfMap& made) {
  return {{"name", made.name},
          {"size", json_of(made.map.values.extent())},
          {"error", json_of(made.error)},
          {"attributes", json_of(made.map.attributes)},
          {"files", made.files},
          {"notes", made.notes}};
}

}  // namespace

std::string precompute_json(const Precomputation& made, const RunDescription& run) {
  Json maps = Json::array();
  for (const PrecomputedMap& map : made.maps) maps.push_back(json_of(map));
  Json sources = Json::array();
  for (const std::string& map : run.maps) sources.push_back(Json::parse(map));
  const Json document = {
      {"format_version", kPrecomputeFormatVersion},
      {"version", run.version},
      {"commit", run.commit.empty() ? Json(nullptr) : Json(run.commit)},
      {"command", run.command},
      {"maps", sources},
      {"error_measure", made.error_measure.empty() ? Json(nullptr) : Json(made.error_measure)},
      {"precomputed", maps},
      {"brdf_map", made.brdf_map ? json_of(*made.brdf_map) : Json(nullptr)}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lightproof
