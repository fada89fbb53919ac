// Frames around a normal: how far they are from orthonormal next to the poles.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/measured_csv.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

/// What rounding a unit vector and some products of its components leaves, ten times over.
constexpr double kRoundingInFloat = 1e-6;
constexpr double kRoundingInDouble = 1e-14;
/// Smaller errors are drawn here: far below what rounding leaves in double.
constexpr double kSmallestDrawn = 1e-17;

using Frames = std::vector<FrameErrorRecord>;

std::string_view precision_of(const FrameErrorRecord& r) { return r.is_float ? "float" : "double"; }

/// How one construction does in one precision around one pole.
struct Line {
  std::string construction;
  std::string source;
  bool is_float = false;
  bool is_nadir = false;
  double worst = 0.0;         ///< of what is finite
  double worst_at = 0.0;      ///< radians
  double broken_up_to = 0.0;  ///< the largest distance at which something is not finite; 0: none

  bool is_orthonormal() const {
    return broken_up_to == 0.0 && worst <= (is_float ? kRoundingInFloat : kRoundingInDouble);
  }
};

std::vector<Line> lines_of(const Frames& frames) {
  std::vector<Line> lines;
  for (const FrameErrorRecord& r : frames) {
    const bool goes_on = !lines.empty() && lines.back().construction == r.construction &&
                         lines.back().is_float == r.is_float && lines.back().is_nadir == r.is_nadir;
    if (!goes_on) lines.push_back({r.construction, r.source, r.is_float, r.is_nadir});
    Line& line = lines.back();
    if (!std::isfinite(r.error)) {
      line.broken_up_to = std::max(line.broken_up_to, r.distance);
    } else if (r.error > line.worst) {
      line.worst = r.error;
      line.worst_at = r.distance;
    }
  }
  return lines;
}

std::string finding(const std::vector<Line>& lines) {
  std::vector<std::string> good;
  std::vector<std::string> bad;
  for (const Line& line : lines) {
    if (!line.is_float || !line.is_nadir) continue;
    const bool everywhere = std::ranges::all_of(lines, [&](const Line& other) {
      return other.construction != line.construction || other.is_orthonormal();
    });
    if (everywhere) {
      good.push_back(line.construction);
    } else if (line.broken_up_to > 0.0) {
      bad.push_back(fmt::format("{} is not finite within {} rad", line.construction,
                                format_number(line.broken_up_to, 2)));
    } else {
      bad.push_back(
          fmt::format("{} errs by up to {}", line.construction, format_number(line.worst, 2)));
    }
  }
  std::string text = good.empty()
                         ? "No frame is orthonormal at every normal"
                         : fmt::format("Orthonormal at every normal: {}", fmt::join(good, "; "));
  if (bad.empty()) return text;
  return text + fmt::format(". Around \u2212z, in float, {}", fmt::join(bad, "; "));
}

Json row_of(const FrameErrorRecord& r) {
  return {{"series", r.construction},
          {"precision", precision_of(r)},
          {"distance", rounded(r.distance)},
          {"error", rounded(r.error)},
          {"drawn", rounded(std::max(r.error, kSmallestDrawn))}};
}

std::string frame_chart(const Frames& frames, bool is_nadir) {
  Json rows = Json::array();
  LogRange errors;
  std::vector<std::string> names;
  for (const FrameErrorRecord& r : frames) {
    names.push_back(r.construction);
    if (std::isfinite(r.error)) errors.add(std::max(r.error, kSmallestDrawn));
    if (r.is_nadir == is_nadir && std::isfinite(r.error)) rows.push_back(row_of(r));
  }
  const std::vector<SeriesStyle> styles = series_styles(names);
  Json x = quantity("distance",
                    is_nadir ? "angle between the normal and \u2212z (rad, log)"
                             : "angle between the normal and +z (rad, log)",
                    "log");
  x["axis"] = log_axis(1e-12, 1.6);
  x["axis"]["tickCount"] = 12;
  x["scale"]["nice"] = false;
  Json y = quantity("drawn", "largest entry of |M\u1d40M \u2212 1| (log)", "log");
  y["axis"] = log_axis(errors.low, errors.high);
  y["scale"]["domain"] = {kSmallestDrawn, std::max(1.0, errors.high)};
  const Json dash = {
      {"field", "precision"},
      {"type", "nominal"},
      {"scale", {{"domain", {"float", "double"}}, {"range", {{1, 0}, {5, 4}}}}},
      {"legend", {{"title", nullptr}, {"symbolType", "stroke"}, {"symbolSize", 300}}}};
  Json chart = base_chart(320);
  chart["data"] = {{"values", rows}};
  chart["layer"] = Json::array(
      {{{"mark", {{"type", "line"}, {"strokeWidth", 2}}}, {"encoding", Json::object()}}});
  chart["encoding"] = {
      {"x", x},
      {"y", y},
      {"color", series(styles, &SeriesStyle::colour, {{"title", nullptr}})},
      {"strokeDash", dash},
      {"tooltip",
       {tooltip("series", "frame", ""), tooltip("precision", "precision", ""),
        tooltip("distance", "distance, rad", ".2~g"), tooltip("error", "error", ".2~g")}}};
  return text_of(chart);
}

std::string finding_around(const std::vector<Line>& lines, bool is_nadir) {
  std::size_t off = 0;
  std::size_t all = 0;
  for (const Line& line : lines) {
    if (line.is_nadir != is_nadir || !line.is_float) continue;
    ++all;
    if (!line.is_orthonormal()) ++off;
  }
  return fmt::format("Around {}z, {} of {} constructions {} more than rounding in float",
                     is_nadir ? "\u2212" : "+", off == 0 ? "none" : count_word(off),
                     count_word(all), off == 1 ? "loses" : "lose");
}

std::string table_of(const std::vector<Line>& lines) {
  Table table("Frames next to the poles", {"Frame", "Source", "Precision", "Pole", "Largest error",
                                           "at, rad", "Not finite up to, rad"});
  for (const Line& line : lines) {
    table.add({text_cell(line.construction), text_cell(line.source),
               text_cell(line.is_float ? "float" : "double"),
               text_cell(line.is_nadir ? "\u2212z" : "+z"), number_cell(line.worst, 2),
               number_cell(line.worst_at, 2),
               line.broken_up_to > 0.0 ? number_cell(line.broken_up_to, 2)
                                       : text_cell("finite everywhere")});
  }
  return table.html();
}

constexpr std::string_view kNote =
    "M has tangent, bitangent and normal as its columns. At each distance the worst of 64 normals "
    "on a circle around the pole, rounded to the precision, so that what rounding alone leaves is "
    "some 1e\u22127 in float and 2e\u221216 in double; smaller errors than 1e\u221217 are drawn at "
    "1e\u221217. Where a line is missing, the frame has entries that are not finite; lines that "
    "coincide hide each other.";

}  // namespace

std::string frame_section(const Frames& frames) {
  std::string html = "<section id=\"frames\">\n<h2>Frames around a normal</h2>\n";
  if (frames.empty()) {
    return html + paragraph("Frames were not measured in this study.", "empty") + "</section>\n";
  }
  const std::vector<Line> lines = lines_of(frames);
  html += paragraph(finding(lines) + ".", "note");
  html += chart_figure({"frames-nadir", finding_around(lines, true),
                        "Orthonormality error of frames against the distance from minus z",
                        std::string(kNote), frame_chart(frames, true)},
                       "");
  html += chart_figure({"frames-zenith", finding_around(lines, false),
                        "Orthonormality error of frames against the distance from plus z", "",
                        frame_chart(frames, false)},
                       collapsible("Frames as a table", table_of(lines)) +
                           download_link("frames.csv", frames_csv(frames)));
  return html + "</section>\n";
}

}  // namespace lightproof
