#include "lightproof/report/picture_html.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "lightproof/image/writer.h"
#include "lightproof/page/html.h"
#include "lightproof/report/pictures.h"

namespace lightproof {
namespace {

std::string stop_text(int stops) {
  return stops == 0 ? "0 EV" : fmt::format("{}{} EV", stops < 0 ? "\u2212" : "+", std::abs(stops));
}

std::string exposures(const Grid<Rgb>& linear, double scale, std::string_view name,
                      std::string_view css_class) {
  std::string html = fmt::format("<div class=\"{}\">\n", css_class);
  for (const int stops : kStops) {
    const std::string text = stop_text(stops);
    html += fmt::format("<figure><div>{}</div><figcaption>{}</figcaption></figure>\n",
                        image_html(tone_mapped(linear, scale * std::exp2(stops)),
                                   fmt::format("{} exposed at {}", name, text)),
                        text);
  }
  return html + "</div>\n";
}

}  // namespace

std::string image_html(const Grid<Rgb>& encoded, std::string_view alternative) {
  return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">",
                     data_uri("image/png", png_bytes(encoded)), encoded.extent().width,
                     encoded.extent().height, escaped(alternative));
}

std::string exposures_html(const Grid<Rgb>& linear, double scale, std::string_view name) {
  return exposures(linear, scale, name, "exposures");
}

std::string unfolded_exposures_html(const Grid<Rgb>& linear, double scale, std::string_view name) {
  return exposures(linear, scale, name, "exposures unfolded");
}

}  // namespace lightproof
