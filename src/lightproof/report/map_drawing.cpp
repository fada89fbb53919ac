#include "lightproof/report/map_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/image/writer.h"
#include "lightproof/page/html.h"
#include "lightproof/report/pictures.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

constexpr int kLookUps = 4;   // along a side of a pixel
constexpr int kPixels = 256;  // along the longer side of the picture
constexpr double kLeft = 60;
constexpr double kTop = 85;
constexpr double kRight = 30;
constexpr double kBottom = 50;
constexpr double kLetter = 6.4;  // width, in the heading
constexpr int kLineDegrees = 30;
/// A line is broken where a step of two degrees leads farther across the picture than it does
/// inside of one piece.
constexpr double kLongestStep = 0.02;

/// Of the picture, in units of the drawing.
double width_of(Preset preset) {
  const double aspect = info(preset).aspect;
  return aspect == 1.0 ? 480.0 : aspect == 2.0 ? 640.0 : 1080.0;
}
double height_of(Preset preset) { return width_of(preset) / info(preset).aspect; }

struct Place {
  double x;
  double y;
};

Place place_of(Preset preset, Direction direction) {
  const SquarePoint at = image_from_direction(preset, direction);
  return {kLeft + at.s * width_of(preset), kTop + (1.0 - at.t) * height_of(preset)};
}

Direction direction_of(double theta_degrees, double phi_degrees) {
  const double theta = theta_degrees * kPi / 180.0;
  const double phi = phi_degrees * kPi / 180.0;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// A path through directions, in pieces where the picture is cut.
std::string path_of(Preset preset, const std::vector<Direction>& directions) {
  std::string path;
  Place before = {};
  for (const Direction& direction : directions) {
    const Place place = place_of(preset, direction);
    const bool goes_on = !path.empty() &&
                         std::abs(place.x - before.x) < kLongestStep * width_of(preset) &&
                         std::abs(place.y - before.y) < kLongestStep * width_of(preset);
    path += fmt::format("{}{:.1f} {:.1f}", goes_on ? "L" : "M", place.x, place.y);
    before = place;
  }
  return fmt::format("<path d=\"{}\"/>\n", path);
}

std::string grid_lines(Preset preset) {
  std::string lines =
      "<g fill=\"none\" stroke=\"#fff\" stroke-opacity=\".55\" stroke-width=\".8\">\n";
  for (int theta = kLineDegrees; theta < 180; theta += kLineDegrees) {
    std::vector<Direction> parallel;
    for (int i = 0; i <= 180; ++i) parallel.push_back(direction_of(theta, 2.0 * i - 179.99));
    lines += path_of(preset, parallel);
  }
  for (int phi = -180; phi < 180; phi += kLineDegrees) {
    std::vector<Direction> meridian;
    for (int i = 0; i <= 90; ++i) meridian.push_back(direction_of(1.9998 * i + 0.009, phi + 0.01));
    lines += path_of(preset, meridian);
  }
  return lines + "</g>\n";
}

std::string text_at(Place place, std::string_view text, std::string_view attributes) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", place.x, place.y, attributes,
                     escaped(text));
}

/// Below the lines, because axes are named above them.
std::string angle_labels(Preset preset) {
  std::string labels = "<g font-size=\"10\" text-anchor=\"middle\" class=\"on-picture\">\n";
  for (const int phi : {-150, -120, -60, -30, 30, 60, 120, 150}) {
    Place place = place_of(preset, direction_of(90.0, phi));
    place.y += 11.0;
    labels += text_at(place, fmt::format("φ {}°", phi), "");
  }
  for (const int theta : {30, 60, 120, 150}) {
    for (const int phi : {-45, 135}) {
      Place place = place_of(preset, direction_of(theta, phi));
      place.y += 11.0;
      labels += text_at(place, fmt::format("θ {}°", theta), "");
    }
  }
  return labels + "</g>\n";
}

/// "+X" for "X", "-X" for "-X"; the opposite where `sign` is -1.
std::string signed_name(std::string_view axis, int sign) {
  const bool is_negative = axis.starts_with('-');
  if (is_negative) axis.remove_prefix(1);
  return fmt::format("{}{}", is_negative == (sign > 0) ? "−" : "+", axis);
}

/// The six ends of the axes, each with a ring at its place and its name beside.
std::string axis_marks(Preset preset, const std::array<std::string, 3>& their_axes) {
  const double bottom = kTop + height_of(preset);
  std::string marks = "<g font-size=\"13\" font-weight=\"bold\" class=\"on-picture\">\n";
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      Direction direction(0.0);
      direction[axis] = sign;
      const Place place = place_of(preset, direction);
      const std::string_view own =
          std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1);
      const bool is_at_right = place.x > kLeft + width_of(preset) - 90.0;
      const Place beside = {place.x + (is_at_right ? -8.0 : 8.0),
                            std::clamp(place.y - 5.0, kTop + 14.0, bottom - 5.0)};
      marks += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"#d62728\" stroke=\"#fff\" "
          "stroke-width=\"1.5\"/>\n",
          place.x, place.y);
      marks += text_at(beside,
                       fmt::format("{} = {}", signed_name(own, sign),
                                   signed_name(their_axes[static_cast<std::size_t>(axis)], sign)),
                       is_at_right ? "text-anchor=\"end\"" : "text-anchor=\"start\"");
    }
  }
  return marks + "</g>\n";
}

std::string tick_labels(Preset preset) {
  const double width = width_of(preset);
  const double height = height_of(preset);
  const int columns = preset == Preset::cube ? 6 : 4;
  const int rows = preset == Preset::cube ? 1 : 4;
  std::string ticks = "<g font-size=\"12\" stroke=\"none\">\n";
  for (int i = 0; i <= columns; ++i) {
    const double x = kLeft + width * i / columns;
    ticks += fmt::format("<path d=\"M{0:.1f} {1:.1f}v5\" stroke=\"#333\"/>\n", x, kTop + height);
    ticks +=
        text_at({x, kTop + height + 18.0}, fmt::format("{:.3g}", static_cast<double>(i) / columns),
                "text-anchor=\"middle\"");
  }
  for (int i = 0; i <= rows; ++i) {
    const double y = kTop + height * i / rows;
    ticks += fmt::format("<path d=\"M{0:.1f} {1:.1f}h-5\" stroke=\"#333\"/>\n", kLeft, y);
    ticks += text_at({kLeft - 8.0, y + 4.0}, fmt::format("{:.3g}", static_cast<double>(i) / rows),
                     "text-anchor=\"end\"");
  }
  ticks += text_at({kLeft + 0.5 * width, kTop + height + 38.0}, "u, from the left",
                   "text-anchor=\"middle\"");
  ticks += fmt::format(
      "<text transform=\"translate(18 {:.1f}) rotate(-90)\" text-anchor=\"middle\">v, from the "
      "top</text>\n",
      kTop + 0.5 * height);
  return ticks + "</g>\n";
}

std::string heading(const EnvironmentMap& map, Preset preset) {
  std::string text = text_at({kLeft, 20.0}, fmt::format("{} in `{}`", map.name, info(preset).name),
                             "font-size=\"15\" font-weight=\"bold\"");
  const auto letters = static_cast<std::size_t>(width_of(preset) / kLetter);
  std::string_view rest = info(preset).description;
  for (double y = 38.0; !rest.empty(); y += 15.0) {
    std::size_t end = rest.size() <= letters ? rest.size() : rest.rfind(' ', letters);
    if (end == std::string_view::npos) end = rest.size();
    text += text_at({kLeft, y}, rest.substr(0, end), "font-size=\"12\"");
    rest.remove_prefix(std::min(rest.size(), end + 1));
  }
  return text;
}

std::string image(const EnvironmentMap& map, Preset preset) {
  const int width = info(preset).aspect > 1.0 ? kPixels * 2 : kPixels;
  const Extent pixels = {width, std::max(1, static_cast<int>(width / info(preset).aspect))};
  const Grid<Rgb> picture = picture_in_convention(map, preset, pixels);
  const std::string bytes = png_bytes(tone_mapped(picture, grey_exposure(picture)));
  return fmt::format(
      "<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
      "preserveAspectRatio=\"none\" href=\"{}\"/>\n",
      kLeft, kTop, width_of(preset), height_of(preset), data_uri("image/png", bytes));
}

}  // namespace

Grid<Rgb> picture_in_convention(const EnvironmentMap& map, Preset preset, Extent pixels) {
  const Extent texels = map.radiance.extent();
  const auto look_up = [&](double u, double v) {
    const Direction direction = direction_from_image(preset, {u, 1.0 - v});
    const SquarePoint at = square_point_of(map.mapping, direction);
    return map.radiance(std::min(static_cast<int>(at.s * texels.width), texels.width - 1),
                        std::min(static_cast<int>(at.t * texels.height), texels.height - 1));
  };
  Grid<Rgb> picture(pixels);
  parallel_for(static_cast<std::size_t>(pixels.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < pixels.width; ++x) {
      Rgb sum(0.0F);
      for (int i = 0; i < kLookUps * kLookUps; ++i) {
        const int column = i % kLookUps;
        const int line = i / kLookUps;
        const double right = (column + 0.5) / kLookUps;
        const double down = (line + 0.5) / kLookUps;
        sum += look_up((x + right) / pixels.width, (y + down) / pixels.height);
      }
      picture(x, y) = sum / static_cast<float>(kLookUps * kLookUps);
    }
  });
  return picture;
}

std::string map_drawing(const EnvironmentMap& map, Preset preset,
                        const std::array<std::string, 3>& their_axes) {
  const double width = kLeft + width_of(preset) + kRight;
  const double height = kTop + height_of(preset) + kBottom;
  const std::string head = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"DejaVu Sans, sans-serif\" fill=\"#222\">\n"
      "<style>.on-picture text {{ fill: #fff; stroke: #000; stroke-width: 2.5px; "
      "stroke-linejoin: round; paint-order: stroke; }}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height);
  return head + heading(map, preset) + image(map, preset) + grid_lines(preset) +
         tick_labels(preset) + angle_labels(preset) + axis_marks(preset, their_axes) + "</svg>\n";
}

}  // namespace lightproof
