#include "lightproof/image/map_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lightproof/core/text_escapes.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;

Json fault_json(const MapFault& fault) {
  const bool of_texels = fault.count > 0;
  return {{"kind", fault.kind},
          {"count", fault.count},
          {"column", of_texels ? Json(fault.column) : Json(nullptr)},
          {"row", of_texels ? Json(fault.row) : Json(nullptr)},
          {"message", fault.message}};
}

/// Empty text is null.
Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

std::string primaries_of(const PictureHeader& picture) {
  return picture.chromaticities ? describe(*picture.chromaticities) : "";
}

Json object_of(const MapDescription& map) {
  const PictureHeader& picture = map.origin.picture;
  Json faults = Json::array();
  for (const MapFault& fault : map.origin.faults) faults.push_back(fault_json(fault));
  return {{"name", map.name},
          {"file", map.file},
          {"format", picture.format},
          {"width", picture.extent.width},
          {"height", picture.extent.height},
          {"preset", info(map.origin.preset).name},
          {"preset_reason", map.origin.why_preset},
          {"mapping", describe(map.mapping)},
          {"parts", picture.parts},
          {"part", picture.part},
          {"channels", picture.channels},
          {"layers", picture.layers},
          {"read", picture.read},
          {"left_out", picture.left_out()},
          {"orientation", text_or_null(picture.orientation)},
          {"primaries", text_or_null(primaries_of(picture))},
          {"exposure", picture.exposure},
          {"luminance_weights", {map.weights.red, map.weights.green, map.weights.blue}},
          {"mean_luminance", map.figures.mean_luminance},
          {"peak_luminance", map.figures.peak_luminance},
          {"peak_texel", {{"column", map.peak.column}, {"row", map.peak.row}}},
          {"peak_direction", {map.peak_direction.x, map.peak_direction.y, map.peak_direction.z}},
          {"effective_fraction", map.figures.effective_fraction},
          {"faults", faults},
          {"refused", text_or_null(map.origin.refusal)},
          {"notes", map.notes}};
}

std::string text_of(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// "part 0 of 2 (first, second)".
std::string parts_text(const PictureHeader& picture) {
  return fmt::format("part {} of 0 to {}: {}", picture.part, picture.parts.size() - 1,
                     listed(picture.parts));
}

/// One line each. Names in files may hold anything: they are written as terminal_text().
class Lines {
 public:
  void add(std::string_view label, std::string_view value) {
    if (!value.empty()) text_ += fmt::format("  {:<12}{}\n", label, terminal_text(value));
  }
  void add_title(std::string_view title) { text_ += terminal_text(title) + "\n"; }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

void add_picture(Lines& lines, const MapDescription& map) {
  const PictureHeader& picture = map.origin.picture;
  lines.add("format", picture.format);
  lines.add("size", fmt::format("{} x {}{}", picture.extent.width, picture.extent.height,
                                map.texels == picture.extent
                                    ? ""
                                    : fmt::format(" ({} x {} texels)", map.texels.width,
                                                  map.texels.height)));
  lines.add("orientation", picture.orientation);
  lines.add("convention",
            fmt::format("{} ({})", info(map.origin.preset).name, map.origin.why_preset));
  lines.add("mapping", map.origin.is_resampled
                           ? describe(map.mapping) + ", resampled if the picture's is another"
                           : describe(map.mapping));
  lines.add("parts", picture.parts.size() > 1 ? parts_text(picture) : "");
  lines.add("channels", listed(picture.channels));
  lines.add("layers", listed(picture.layers));
  lines.add("read", listed(picture.read));
  lines.add("left out", listed(picture.left_out()));
  lines.add("primaries", primaries_of(picture));
}

void add_light(Lines& lines, const MapDescription& map) {
  const MapFigures& figures = map.figures;
  lines.add("luminance", fmt::format("mean {:.6g}, peak {:.6g} at column {}, row {}, direction "
                                     "({:.4f}, {:.4f}, {:.4f})",
                                     figures.mean_luminance, figures.peak_luminance,
                                     map.peak.column, map.peak.row, map.peak_direction.x,
                                     map.peak_direction.y, map.peak_direction.z));
  lines.add("weights", describe(map.weights));
  lines.add("light fills", std::isnan(figures.effective_fraction)
                               ? "nothing"
                               : fmt::format("{:.3g} % of the sphere (effective fraction)",
                                             100.0 * figures.effective_fraction));
}

}  // namespace

MapDescription describe(const EnvironmentMap& map) {
  const MapFigures figures = figures_of(map);
  const Extent texels = map.radiance.extent();
  MapDescription description = {.name = map.name,
                                .file = map.source.empty() ? map.name : map.source,
                                .origin = map.origin,
                                .texels = texels,
                                .mapping = map.mapping,
                                .weights = map.weights,
                                .figures = figures,
                                .peak = {},
                                .peak_direction = direction_of_texel(texels, figures.peak_column,
                                                                     figures.peak_row, map.mapping),
                                .notes = map.notes};
  Extent& picture = description.origin.picture.extent;
  if (picture == Extent{}) picture = texels;  // a built-in map
  const auto pixel_of = map.origin.is_resampled ? pixel_in_picture : own_pixel_in_picture;
  description.peak = pixel_of(map.origin.preset, picture, figures.peak_column, figures.peak_row);
  return description;
}

std::string json_of(const MapDescription& description) { return text_of(object_of(description)); }

std::string info_json(const std::vector<MapDescription>& descriptions, const RunDescription& run,
                      bool as_list) {
  Json list = Json::array();
  for (const MapDescription& description : descriptions) {
    Json object = {{"format_version", kInfoFormatVersion},
                   {"version", run.version},
                   {"commit", text_or_null(run.commit)},
                   {"command", run.command}};
    object.update(object_of(description));
    list.push_back(object);
  }
  return text_of(as_list || list.size() != 1 ? list : list.front());
}

std::string text_of(const MapDescription& map) {
  Lines lines;
  lines.add_title(map.file);
  add_picture(lines, map);
  add_light(lines, map);
  for (const MapFault& fault : map.origin.faults) lines.add("fault", fault.message);
  for (const std::string& note : map.notes) lines.add("note", note);
  lines.add("refused", map.origin.refusal.empty() ? "" : "by commands that sample it: see faults");
  return lines.text();
}

}  // namespace lightproof
