#include "lightproof/report/map_drawing.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "lightproof/image/synthetic.h"
#include "lightproof/warp/preset.h"

namespace lightproof {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::array<std::string, 3> kOwnAxes = {"X", "Y", "Z"};

// Where the drawing has its picture.
constexpr double kLeft = 60.0;
constexpr double kTop = 85.0;

class EveryPreset : public ::testing::TestWithParam<PresetInfo> {
 protected:
  Preset preset() const { return GetParam().preset; }
  double width() const {
    const double aspect = GetParam().aspect;
    return aspect == 1.0 ? 480.0 : aspect == 2.0 ? 640.0 : 1080.0;
  }
  double height() const { return width() / GetParam().aspect; }
  std::string drawing() const {
    return map_drawing(make_synthetic_map("sun-sky", {64, 32}), preset(), kOwnAxes);
  }
  /// What is written beside the ring at a direction; empty if there is no ring.
  std::string name_at(const std::string& svg, Direction direction) const {
    const SquarePoint at = image_from_direction(preset(), direction);
    const std::size_t ring =
        svg.find(fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\"", kLeft + at.s * width(),
                             kTop + (1.0 - at.t) * height()));
    if (ring == std::string::npos) return "";
    const std::size_t text = svg.find('>', svg.find("<text", ring)) + 1;
    return svg.substr(text, svg.find('<', text) - text);
  }
};

TEST_P(EveryPreset, HasARingWhereEachAxisPointsAndItsName) {
  const std::string svg = drawing();
  EXPECT_EQ(name_at(svg, {1, 0, 0}), "+x = +X");
  EXPECT_EQ(name_at(svg, {-1, 0, 0}), "−x = −X");
  EXPECT_EQ(name_at(svg, {0, 1, 0}), "+y = +Y");
  EXPECT_EQ(name_at(svg, {0, -1, 0}), "−y = −Y");
  EXPECT_EQ(name_at(svg, {0, 0, 1}), "+z = +Z");
  EXPECT_EQ(name_at(svg, {0, 0, -1}), "−z = −Z");
}

/// Two degrees are at most 1.6 % of the picture's width along either side (at the equator of an
/// octahedron, which is 2.8 widths long): a step of 3 % has jumped.
TEST_P(EveryPreset, DrawsNoLineAcrossWhereThePictureIsCut) {
  const std::string svg = drawing();
  std::size_t steps = 0;
  for (std::size_t at = svg.find("<path d=\"M"); at != std::string::npos;
       at = svg.find("<path d=\"M", at + 1)) {
    const std::string path = svg.substr(at + 9, svg.find('"', at + 9) - at - 9);
    if (path.find('L') == std::string::npos) continue;  // a tick
    double x = 0.0;
    double y = 0.0;
    for (const char* rest = path.c_str(); *rest != '\0';) {
      const bool is_step = *rest == 'L';
      char* end = nullptr;
      const double next_x = std::strtod(rest + 1, &end);
      const double next_y = std::strtod(end, &end);
      if (is_step) {
        ++steps;
        EXPECT_LT(std::hypot(next_x - x, next_y - y), 0.03 * width()) << path.substr(0, 40);
      }
      x = next_x;
      y = next_y;
      rest = end;
    }
  }
  EXPECT_GT(steps, 1800U);  // of 5 parallels of 180 and 12 meridians of 90, less those over cuts
}

/// The sun is where the map has it, whatever the convention.
TEST_P(EveryPreset, ShowsTheLightInItsPlace) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const Extent pixels = {static_cast<int>(128 * GetParam().aspect), 128};
  const Grid<Rgb> picture = picture_in_convention(map, preset(), pixels);
  const auto values = picture.values();
  const auto brightest = std::ranges::max_element(values, {}, [](Rgb c) { return c.g; });
  const auto index = static_cast<int>(brightest - values.begin());
  const int column = index % pixels.width;
  const int row = index / pixels.width;
  const Direction found = direction_from_image(
      preset(), {(column + 0.5) / pixels.width, 1.0 - (row + 0.5) / pixels.height});
  // The centre of the texel (16, 26); the sun has three by three texels of 5.6 degrees.
  const double theta = kPi * (1.0 - 26.5 / 32.0);
  const double phi = kPi - 2.0 * kPi * 16.5 / 64.0;
  const Direction sun = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta)};
  EXPECT_GT(glm::dot(found, sun), std::cos(1.5 * std::sqrt(2.0) * kPi / 32.0));
}

INSTANTIATE_TEST_SUITE_P(MapDrawing, EveryPreset,
                         ::testing::ValuesIn(presets().begin(), presets().end()),
                         [](const auto& row) {
                           std::string name(row.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(MapDrawing, NamesAxesOfOtherFramesByTheirSigns) {
  const EnvironmentMap map = make_synthetic_map("constant", {8, 4});
  const std::string svg = map_drawing(map, Preset::cube, {"-X", "-Z", "Y"});
  EXPECT_THAT(svg, AllOf(HasSubstr("+x = −X<"), HasSubstr("−x = +X<"), HasSubstr("−y = +Z<"),
                         HasSubstr("+z = +Y<")));
}

TEST(MapDrawing, KeepsANameFromBecomingMarkup) {
  EnvironmentMap map = make_synthetic_map("constant", {8, 4});
  map.name = "<script>&";
  const std::string svg = map_drawing(map, Preset::z_up, kOwnAxes);
  EXPECT_THAT(svg, AllOf(Not(HasSubstr("<script")), HasSubstr("&lt;script&gt;&amp;")));
}

}  // namespace
}  // namespace lightproof
