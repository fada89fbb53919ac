// The maps as pictures, with samples drawn over them.
#include <fmt/format.h>

#include <cmath>

#include "lightproof/image/writer.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/picture_html.h"
#include "lightproof/report/pictures.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

constexpr int kWidth = 640;  // pixels of the large picture, at most
constexpr int kThumbnailWidth = 256;
constexpr double kUnits = 1000.0;  // width of the overlay's coordinate system

/// Zero-length strokes with round caps are dots whose size does not depend on the picture's.
std::string dots(const std::vector<SquarePoint>& drawn, double height) {
  std::string path;
  for (const SquarePoint& p : drawn) {
    if (!std::isfinite(p.s) || !std::isfinite(p.t)) continue;
    path += fmt::format("M{:.1f} {:.1f}h.01", p.s * kUnits, (1.0 - p.t) * height);
  }
  return path;
}

std::string overlay(const MapRecord& record) {
  const Extent size = record.map.radiance.extent();
  const double height = kUnits * size.height / size.width;
  const std::string path = dots(record.drawn, height);
  return fmt::format(
      "<svg class=\"samples\" viewBox=\"0 0 {} {:.1f}\" preserveAspectRatio=\"none\" "
      "aria-hidden=\"true\"><path class=\"edge\" d=\"{}\"/><path class=\"core\" d=\"{}\"/></svg>",
      kUnits, height, path, path);
}

/// "512 × 512, octahedral".
std::string own_texels(const MapRecord& record) {
  return extent_text(record.own_texels) + ", " + describe(record.own_mapping);
}

/// What the picture shows, where that is not the texels of the file.
std::string drawn_as(const MapRecord& record) {
  if (is_plain(record.own_mapping)) return "";
  return fmt::format(
      "The file has other texels ({}), in which the gate judged the samplers; the picture and all "
      "other parts of the report are of these, made of them. ",
      own_texels(record));
}

std::string quantities(const MapRecord& record) {
  return fmt::format(
      "{}, {} texels of latitude and longitude. {}Mean luminance over the sphere {}; the brightest "
      "texel is {} times the "
      "mean. ",
      record.source, extent_text(record.map.radiance.extent()), drawn_as(record),
      format_number(record.mean_luminance), format_number(record.peak_ratio));
}

std::string notes(const std::vector<std::string>& texts) {
  std::string html;
  for (const std::string& text : texts) html += fmt::format("<li>{}</li>", escaped(text));
  return html.empty() ? "" : "<ul class=\"notes\">" + html + "</ul>\n";
}

std::string map_figure(const MapRecord& record) {
  const Grid<Rgb> picture = flip_rows(record.map.radiance);
  const double scale = grey_exposure(picture);
  const std::string alternative =
      fmt::format("Environment map {} in latitude and longitude, with {} drawn over it",
                  record.map.name, counted(record.drawn.size(), "sample"));
  return fmt::format("<figure class=\"map\">\n<h3>{}</h3>\n<div class=\"picture\">{}{}</div>\n",
                     escaped(record.map.name),
                     image_html(tone_mapped(shrunk(picture, kWidth), scale), alternative),
                     overlay(record)) +
         exposures_html(shrunk(picture, kThumbnailWidth), scale, record.map.name) +
         fmt::format("<figcaption>{}</figcaption>\n",
                     escaped(quantities(record) + map_finding(record))) +
         notes(record.map.notes) + "</figure>\n";
}

constexpr std::string_view kIntroduction =
    "Each map in latitude and longitude, zenith at the top. At 0 EV the geometric mean of the "
    "luminances is "
    "middle grey; values are clipped and sRGB-encoded. Dots are samples that the binary search "
    "drew in proportion to luminance times solid angle: they gather where the light is.";

}  // namespace

std::string map_section(const std::vector<MapRecord>& maps) {
  std::string html = "<section id=\"maps\">\n<h2>Maps</h2>\n";
  if (maps.empty()) return html + paragraph("No map was recorded.", "empty") + "</section>\n";
  html += paragraph(kIntroduction, "note");
  html +=
      "<p class=\"control\"><label><input type=\"checkbox\" id=\"show-samples\" checked> "
      "Show the samples</label></p>\n<div class=\"maps\">\n";
  for (const MapRecord& record : maps) html += map_figure(record);
  html += "</div>\n";
  Table table("The maps in numbers",
              {"Map", "Source", "Size", "Texels of the gate", "Mean luminance",
               "Brightest texel / mean", "Effective fraction"});
  for (const MapRecord& r : maps) {
    table.add({text_cell(r.map.name),
               text_cell(r.source),
               {extent_text(r.map.radiance.extent()), "number", ""},
               text_cell(own_texels(r)),
               number_cell(r.mean_luminance),
               number_cell(r.peak_ratio),
               number_cell(r.effective_fraction)});
  }
  return html + collapsible("The maps in numbers", table.html()) +
         download_link("maps.csv", maps_csv(maps)) + "</section>\n";
}

}  // namespace lightproof
