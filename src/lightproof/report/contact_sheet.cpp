#include "lightproof/report/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "lightproof/page/document.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/picture_html.h"
#include "lightproof/report/pictures.h"

namespace lightproof {
namespace {

constexpr int kWidth = 384;  // pixels of a picture, at most

/// An error and what it is the error of.
struct NamedError {
  std::string name;
  double error;
};

std::optional<LevelError> error_of(const PrecomputedMap& made, std::size_t level) {
  return level < made.errors.size() ? made.errors[level] : std::nullopt;
}

std::string level_name(const PrecomputedMap& made, std::size_t level) {
  return made.map.levels.size() == 1 ? made.name : fmt::format("{}, level {}", made.name, level);
}

std::optional<NamedError> largest_error(const Precomputation& made) {
  std::optional<NamedError> largest;
  const auto consider = [&](const std::string& name, const std::optional<LevelError>& error) {
    if (error && (!largest || error->error > largest->error)) largest = {name, error->error};
  };
  for (const PrecomputedMap& map : made.maps) {
    for (std::size_t i = 0; i < map.map.levels.size(); ++i) {
      consider(level_name(map, i), error_of(map, i));
    }
  }
  if (made.brdf_map) consider(made.brdf_map->name, made.brdf_map->error);
  return largest;
}

std::string headline(const Precomputation& made) {
  const std::optional<NamedError> largest = largest_error(made);
  return fmt::format(
      "Maps of {}: {}", made.source,
      largest ? fmt::format("the largest error is {} ({})", percent(largest->error), largest->name)
              : "errors were not measured");
}

std::string error_text(const std::optional<LevelError>& error) {
  if (!error) return "error not measured";
  return fmt::format("error {} ({} to {})", percent(error->error), percent(error->low),
                     percent(error->high));
}

std::string fact(std::string_view name, std::string_view value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
}

std::string facts(const Attributes& attributes) {
  std::string html = "<dl class=\"facts\">\n";
  for (const Attribute& attribute : attributes) html += fact(attribute.name, line_of(attribute));
  return html + "</dl>\n";
}

std::string list(const std::vector<std::string>& texts, std::string_view css_class) {
  std::string html;
  for (const std::string& text : texts) html += fmt::format("<li>{}</li>", escaped(text));
  return html.empty() ? "" : fmt::format("<ul class=\"{}\">{}</ul>\n", css_class, html);
}

std::string files(const std::vector<std::string>& names) {
  if (names.empty()) return "";
  if (names.size() == 1) return paragraph("File: " + names.front(), "note");
  return collapsible(counted(names.size(), "file"), list(names, "files"));
}

/// The picture of a level, small enough for the page.
Grid<Rgb> picture_of(const MapLevel& level, Projection projection) {
  if (!is_cube(projection)) return shrunk(level.faces.front(), kWidth);
  std::vector<Grid<Rgb>> faces;
  for (const Grid<Rgb>& face : level.faces) faces.push_back(shrunk(face, kWidth / 4));
  return unfolded_cube(faces,
                       Rgb(std::numeric_limits<float>::infinity()));  // white at any exposure
}

/// The exposure of the level that is nearest to the environment map itself.
double exposure_of(const MapLevels& map) {
  return grey_exposure(picture_of(map.levels.front(), map.projection));
}

std::string exposures_of(const PrecomputedMap& made, std::size_t level, double scale) {
  const Grid<Rgb> picture = picture_of(made.map.levels[level], made.map.projection);
  const std::string name = level_name(made, level);
  return is_cube(made.map.projection) ? unfolded_exposures_html(picture, scale, name)
                                      : exposures_html(picture, scale, name);
}

std::string roughness_text(const MapLevel& level) {
  return fmt::format("{:.4g}", *level.roughness);
}

std::string level_figure(const PrecomputedMap& made, std::size_t number, double scale) {
  const MapLevel& level = made.map.levels[number];
  const std::string roughness =
      level.roughness ? fmt::format("roughness {}, ", roughness_text(level)) : "";
  return fmt::format(
      "<figure>\n<h4>Level {}: {}</h4>\n{}<figcaption>{}{}</figcaption>\n</figure>\n", number,
      extent_text(level.faces.front().extent()), exposures_of(made, number, scale), roughness,
      escaped(error_text(error_of(made, number))));
}

std::string level_table(const PrecomputedMap& made) {
  Table table("Levels of " + made.name,
              {"Level", "Size", "Roughness", "Error", "Lower limit", "Upper limit", "Texels"});
  for (std::size_t i = 0; i < made.map.levels.size(); ++i) {
    const MapLevel& level = made.map.levels[i];
    const std::optional<LevelError> error = error_of(made, i);
    const auto number = [&](double LevelError::*part) {
      return error ? Cell{percent((*error).*part), "number", ""} : Cell{"\u2013", "number", ""};
    };
    table.add({{std::to_string(i), "number", ""},
               {extent_text(level.faces.front().extent()), "number", ""},
               {level.roughness ? roughness_text(level) : "\u2013", "number", ""},
               number(&LevelError::error),
               number(&LevelError::low),
               number(&LevelError::high),
               {error ? with_thousands(error->texels) : "\u2013", "number", ""}});
  }
  return table.html();
}

std::string section(std::string_view name, std::string_view html) {
  return fmt::format("<section id=\"{0}\">\n<h2>{0}</h2>\n{1}</section>\n", escaped(name), html);
}

/// "8 levels from 128×128 to 1×1, with errors from 0.02 % to 2.6 %".
std::string summary_of(const PrecomputedMap& made) {
  const std::size_t levels = made.map.levels.size();
  std::string text = is_cube(made.map.projection) ? "A cube of " : "Latitude-longitude, ";
  text += levels == 1 ? "one level of " + extent_text(made.map.extent())
                      : fmt::format("{} levels from {} to {}", count_word(levels),
                                    extent_text(made.map.extent()),
                                    extent_text(made.map.levels.back().faces.front().extent()));
  std::vector<double> errors;
  for (std::size_t i = 0; i < levels; ++i) {
    if (const std::optional<LevelError> error = error_of(made, i)) errors.push_back(error->error);
  }
  if (errors.empty()) return text;
  const auto [least, most] = std::ranges::minmax(errors);
  return text + (errors.size() == 1
                     ? ", with an error of " + percent(most)
                     : fmt::format(", with errors from {} to {}", percent(least), percent(most)));
}

std::string section_of(const PrecomputedMap& made) {
  const double scale = exposure_of(made.map);
  std::string html = fmt::format("<h3>{}</h3>\n", escaped(summary_of(made))) +
                     list(made.notes, "notes") + "<div class=\"levels\">\n";
  for (std::size_t i = 0; i < made.map.levels.size(); ++i) html += level_figure(made, i, scale);
  html += "</div>\n" + collapsible("The levels in numbers", level_table(made)) + files(made.files);
  return section(made.name, html + "<h4>How it was made</h4>\n" + facts(attributes_of(made.map)));
}

/// One channel as grey.
Grid<Rgb> channel_of(const BrdfMap& map, int channel) {
  Grid<Rgb> picture(map.values.extent());
  std::ranges::transform(map.values.values(), picture.values().begin(),
                         [&](glm::vec2 ab) { return Rgb(ab[channel]); });
  return shrunk(picture, kWidth);
}

std::string brdf_figure(const Grid<Rgb>& picture, std::string_view caption) {
  return fmt::format("<figure><div>{}</div><figcaption>{}</figcaption></figure>\n",
                     image_html(picture, caption), escaped(caption));
}

constexpr std::string_view kBrdfNote =
    "The share of light that a surface reflects is F\u2080 A + B. From left to right the cosine "
    "between normal and view grows from 0 to 1, from top to bottom roughness. Values are shown as "
    "they are: 1 is white.";

std::string section_of(const PrecomputedBrdfMap& made) {
  const std::string html =
      paragraph(kBrdfNote, "note") + list(made.notes, "notes") +
      "<div class=\"levels\">\n<figure>\n<h4>" + extent_text(made.map.values.extent()) +
      "</h4>\n<div class=\"exposures\">\n" + brdf_figure(channel_of(made.map, 0), "A") +
      brdf_figure(channel_of(made.map, 1), "B") +
      brdf_figure(shrunk(picture_of(made.map), kWidth), "A in red, B in green") +
      "</div>\n<figcaption>" + escaped(error_text(made.error)) +
      "</figcaption>\n</figure>\n</div>\n" + files(made.files) + "<h4>How it was made</h4>\n" +
      facts(attributes_of(made.map));
  return section(made.name, html);
}

std::string navigation(const Precomputation& made) {
  std::string items;
  const auto add = [&](std::string_view name) {
    items += fmt::format("<li><a href=\"#{0}\">{0}</a></li>\n", escaped(name));
  };
  for (const PrecomputedMap& map : made.maps) add(map.name);
  if (made.brdf_map) add(made.brdf_map->name);
  return "<nav aria-label=\"Maps\"><ul>\n" + items + "</ul></nav>\n";
}

constexpr std::string_view kHowToRead =
    "Every level at three exposures. At 0 EV the geometric mean of the luminances of level 0 is "
    "middle grey; all levels of a map share it. Values are clipped and sRGB-encoded; texels of "
    "small "
    "levels are enlarged, not interpolated.";
constexpr std::string_view kCross =
    "Cubes are unfolded: in the row \u2212X, +Z, +X, \u2212Z, with +Y above and \u2212Y below +Z.";

std::string header(const Precomputation& made) {
  const bool has_cubes = std::ranges::any_of(
      made.maps, [](const PrecomputedMap& map) { return is_cube(map.map.projection); });
  std::string how(kHowToRead);
  if (has_cubes) how += " " + std::string(kCross);
  if (!made.error_measure.empty()) how += " Errors: " + made.error_measure;
  return fmt::format(
      "<header>\n<p class=\"kicker\">Lightproof precompute</p>\n<h1>{}</h1>\n<p class=\"how\">"
      "<strong>How to read this.</strong> {}</p>\n</header>\n",
      escaped(headline(made)), escaped(how));
}

}  // namespace

std::string contact_sheet(const Precomputation& made) {
  std::string body = header(made);
  for (const PrecomputedMap& map : made.maps) body += section_of(map);
  if (made.brdf_map) body += section_of(*made.brdf_map);
  return html_document("Lightproof: maps of " + made.source, navigation(made), body, made.version,
                       Charts::none);
}

}  // namespace lightproof
