#include "lightproof/report/picture_html.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "lightproof/image/writer.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/pictures.h"

namespace lightproof {
namespace {

std::string stop_text(int stops) {
  return stops == 0 ? "0 EV" : fmt::format("{}{} EV", stops < 0 ? "\u2212" : "+", std::abs(stops));
}

std::string hex(Rgb colour) {
  const auto byte = [](float v) { return static_cast<int>(std::lround(v * 255.0F)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.r), byte(colour.g), byte(colour.b));
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

std::string colour_bar_html(double range) {
  return fmt::format(
      "<div class=\"colour-bar\"><svg viewBox=\"0 0 100 6\" preserveAspectRatio=\"none\" "
      "role=\"img\" aria-label=\"Colour scale from {0} (blue) over 0 (white) to {1} (red)\">"
      "<defs><linearGradient id=\"signed\"><stop offset=\"0\" stop-color=\"{2}\"/>"
      "<stop offset=\".5\" stop-color=\"{3}\"/><stop offset=\"1\" stop-color=\"{4}\"/>"
      "</linearGradient></defs><rect width=\"100\" height=\"6\" fill=\"url(#signed)\"/></svg>"
      "<p><span>\u2264 {0}<br>too dark</span><span>0</span><span>\u2265 {1}<br>too bright</span>"
      "</p></div>\n",
      format_number(-range, 1), "+" + format_number(range, 1), hex(diverging_colour(-range, range)),
      hex(diverging_colour(0.0, range)), hex(diverging_colour(range, range)));
}

}  // namespace lightproof
