// Renders in equal time, with their signed errors.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/names.h"
#include "lightproof/report/picture_html.h"
#include "lightproof/report/pictures.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

using Scene = std::vector<const RenderRecord*>;

/// Errors of this size and beyond have the full colour, in every picture of a study.
constexpr double kErrorRange = 0.5;

std::string time_text(const RenderRecord& r) {
  if (r.point_seconds > 0.0) return seconds_text(r.point_seconds) + " per pixel";
  return r.seconds > 0.0 ? seconds_text(r.seconds) : "time not measured";
}

std::string estimator_figure(const RenderRecord& r, double scale) {
  return fmt::format(
      "<figure>{}\n{}\n<figcaption><strong>{}</strong><br>RMSE / mean {}<br>{}<br>{} per "
      "pixel</figcaption></figure>\n",
      image_html(tone_mapped(r.picture, scale), "Picture by " + r.estimator),
      image_html(
          diverging_picture(r.error, kErrorRange),
          fmt::format("Signed error of {}, from blue (too dark) to red (too bright)", r.estimator)),
      escaped(r.estimator), percent(r.rmse), time_text(r), counted(r.samples, "sample"));
}

std::string reference_text(const RenderRecord& r) {
  if (r.reference_samples == 0) return "";
  return fmt::format("<br>{} per pixel; its own noise counts in every RMSE",
                     counted(r.reference_samples, "sample"));
}

/// The estimators that stand for no kind, the least error first, folded.
std::string other_figures(const Scene& scene, double scale) {
  Scene others;
  std::ranges::copy_if(scene, std::back_inserter(others),
                       [](const RenderRecord* r) { return !r->is_representative; });
  if (others.empty()) return "";
  std::ranges::sort(others, {}, &RenderRecord::rmse);
  std::string figures = "<div class=\"renders\">\n";
  for (const RenderRecord* r : others) figures += estimator_figure(*r, scale);
  return collapsible(fmt::format("Others in the same time, the least error first: {}",
                                 counted(others.size(), "estimator")),
                     figures + "</div>\n");
}

std::string scene_html(const Scene& scene) {
  const RenderRecord& first = *scene.front();
  const double scale = mean_exposure(first.reference);
  std::string html = fmt::format("<h3>{}</h3>\n", escaped(render_finding(scene)));
  html += paragraph(
      fmt::format("Map {}, receiver {}, material {}.", first.map, first.receiver, first.material));
  html += "<div class=\"renders\">\n";
  html +=
      fmt::format("<figure>{}\n{}<figcaption><strong>Reference</strong>{}</figcaption></figure>\n",
                  image_html(tone_mapped(first.reference, scale), "Reference picture"),
                  colour_bar_html(kErrorRange), reference_text(first));
  for (const RenderRecord* r : scene) {
    if (r->is_representative) html += estimator_figure(*r, scale);
  }
  return html + "</div>\n" + other_figures(scene, scale);
}

std::string render_table(const std::vector<RenderRecord>& renders) {
  Table table("Renders", {"Estimator", "Map", "Receiver", "Material", "Samples per pixel",
                          "RMSE / mean", "Seconds"});
  for (const RenderRecord& r : renders) {
    table.add({text_cell(r.estimator),
               text_cell(r.map),
               text_cell(r.receiver),
               text_cell(r.material),
               {with_thousands(r.samples), "number", ""},
               number_cell(r.rmse),
               number_cell(r.seconds)});
  }
  return table.html();
}

constexpr std::string_view kNote =
    "Above: the picture, exposed so that the mean luminance of the reference's lit pixels is 0.35, "
    "clipped and sRGB-encoded. Below: picture minus reference in luminance, relative to the "
    "reference's mean over the pixels that show the receiver, on one scale for all maps, "
    "receivers, "
    "materials and estimators; beyond half of the mean the colour stays. All have the same time "
    "for "
    "a pixel, and as many samples as fit into it, by a short measurement. What has no number of "
    "samples to choose, a look-up, lights, a table for each point, takes what it takes, less or "
    "more "
    "than that, and so does what a single sample takes longer for.";

}  // namespace

std::string render_section(const std::vector<RenderRecord>& renders) {
  std::string html = "<section id=\"renders\">\n<h2>Renders</h2>\n";
  if (renders.empty()) {
    return html + paragraph("Nothing was rendered in this study.", "empty") + "</section>\n";
  }
  html += paragraph(kNote, "note");
  for (const RenderScene& group : render_scenes(renders)) {
    html += scene_html(members_of(group, renders));
  }
  return html + collapsible("Renders as a table", render_table(renders)) +
         download_link("renders.csv", renders_csv(renders)) + "</section>\n";
}

}  // namespace lightproof
