#include "lightproof/prefilter/prefilter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_integrals.h"

namespace lightproof {
namespace {

/// A lobe, and the reference's own density of it.
struct LobeCase {
  std::string name;
  Lobe lobe;
  reference::Lobe exact;
};

LobeCase ggx(double roughness) {
  const double alpha = roughness * roughness;
  return {"GGX of roughness " + std::to_string(roughness), GgxLobe{alpha},
          reference::ggx_lobe(alpha)};
}

/// By harmonics alone, split by a window, and summed over texels as a whole.
std::vector<LobeCase> lobe_cases() {
  return {ggx(1.0),
          ggx(0.5),
          ggx(0.2),
          ggx(0.08),
          ggx(0.05),
          ggx(0.02),
          {"GGX .3 masked", GgxLobe{0.3, GgxWeight::masking, 0.04},
           reference::ggx_masked_lobe(0.3, 0.04)},
          {"Phong 60", PhongLobe{60.0}, reference::phong_lobe(60.0)},
          {"hemisphere", PhongLobe{0.0}, reference::phong_lobe(0.0)},
          {"half-vector 5", HalfVectorLobe{5.0}, reference::half_vector_lobe(5.0)}};
}

Grid<Rgb> map_of(std::string_view name, Extent extent) {
  return make_synthetic_map(name, extent).radiance;
}

Grid<Rgb> one_level(const Grid<Rgb>& map, const Lobe& lobe, Extent extent,
                    const PrefilterSettings& settings = {}) {
  const PrefilteredLevel level = {lobe, extent};
  return std::move(prefilter(map, {&level, 1}, settings).front());
}

double largest(const Grid<glm::dvec3>& grid) {
  double value = 0.0;
  for (const glm::dvec3 v : grid.values()) value = std::max({value, v.x, v.y, v.z});
  return value;
}

/// Every texel within this share of the brightest texel of the exact level, plus a float's rounding
/// of its own value.
void expect_near(const Grid<Rgb>& level, const Grid<glm::dvec3>& exact, double share,
                 const std::string& name) {
  const double tolerance = share * largest(exact);
  for (int y = 0; y < exact.extent().height; ++y) {
    for (int x = 0; x < exact.extent().width; ++x) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(level(x, y)[c], exact(x, y)[c], tolerance + 0x1p-23 * exact(x, y)[c])
            << name << " at " << x << ", " << y;
      }
    }
  }
}

// The reference divides each texel until its nodes are within 1e-5 of the integral over a cell.
// What the fast way leaves out of the harmonics is 1e-7, and less than 1e-4 where a kink or a jump
// at the horizon lets them fall off slowly: there it shows where a sun stands at the horizon.
constexpr double kOracle = 1e-5;
constexpr double kHorizon = 1e-4;

TEST(FastPrefilter, IsTheIntegralOverTexels) {
  const Extent out = {16, 8};
  for (const std::string_view name : {"sun-sky", "checker"}) {
    const Grid<Rgb> map = map_of(name, {64, 32});
    for (const LobeCase& each : lobe_cases()) {
      expect_near(one_level(map, each.lobe, out), reference::prefiltered(map, each.exact, out),
                  kOracle + kHorizon, each.name + " on " + std::string(name));
    }
  }
}

TEST(FastPrefilter, TakesMapsOfAnySize) {
  for (const Extent extent : {Extent{1, 1}, Extent{3, 2}, Extent{2, 5}, Extent{37, 19}}) {
    const Grid<Rgb> map = map_of("black-first-row", extent);
    for (const Extent out : {Extent{1, 1}, Extent{6, 4}}) {
      for (const LobeCase& each : {ggx(0.6), ggx(0.05)}) {
        expect_near(one_level(map, each.lobe, out), reference::prefiltered(map, each.exact, out),
                    kOracle + kHorizon, each.name + " of width " + std::to_string(extent.width));
      }
    }
  }
}

/// One lit texel, where rows and columns meet their ends: the largest error is where it is nearest.
TEST(FastPrefilter, SeesOneBrightTexelAcrossTheSeamAndAtThePoles) {
  const Extent extent = {32, 16};
  struct Place {
    int x;
    int y;
  };
  for (const Place lit : {Place{0, 8}, Place{31, 5}, Place{0, 15}, Place{13, 0}, Place{31, 15}}) {
    Grid<Rgb> map(extent);
    map(lit.x, lit.y) = Rgb(1000.0F);
    for (const LobeCase& each : {ggx(0.4), ggx(0.15), ggx(0.03)}) {
      expect_near(one_level(map, each.lobe, extent),
                  reference::prefiltered(map, each.exact, extent), kOracle + kHorizon, each.name);
    }
  }
}

/// The mean over a lobe of a map whose only lit texel has the value 1: midpoints of small parts of
/// the texel, over the lobe's own integral.
double mean_of_lit_texel(const reference::Lobe& lobe, Direction axis, Extent extent, int x, int y) {
  constexpr int kParts = 200;
  double sum = 0.0;
  for (int j = 0; j < kParts; ++j) {
    for (int i = 0; i < kParts; ++i) {
      const SquarePoint at = {(x + (i + 0.5) / kParts) / extent.width,
                              (y + (j + 0.5) / kParts) / extent.height};
      sum += lobe.value(direction_from_square(at), axis) * solid_angle_per_square(at.t);
    }
  }
  const double area = 1.0 / static_cast<double>(extent.count());
  const reference::PeakedDensity density = {
      [&](Direction light) { return lobe.value(light, axis); }, axis, lobe.width, axis, lobe.jumps};
  double whole = 0.0;
  const Grid<double> parts = reference::texel_integrals(density, {64, 32});
  for (const double part : parts.values()) whole += part;
  return sum / (kParts * kParts) * area / whole;
}

// A lobe's slope at the horizon would leave some 1e-3 of the light of a sun that stands there. What
// is left of its curvature q, over the solid angle O of the lobe, is 2 q/O L^(-2) at the most, of
// degrees beyond L = 256, relative to the map's mean radiance: below 1e-5 for these lobes.
TEST(FastPrefilter, SeesASunOnTheHorizonOfBroadLobes) {
  Grid<Rgb> map({200, 100});
  map(150, 50) = Rgb(1e5F);
  const double mean = 1e5 * texel_solid_angle({200, 100}, 50) / kSphere;
  const Direction sun = direction_from_square({150.5 / 200.0, 50.5 / 100.0});
  const Direction above = glm::normalize(glm::cross(sun, Direction(0.3, 0.2, 1.0)));
  const Direction beside = glm::cross(sun, above);
  std::vector<Direction> axes;
  for (const double tilt : {-0.02, -0.005, 0.0, 0.005, 0.02}) {
    axes.push_back(std::cos(tilt) * above + std::sin(tilt) * sun);
    axes.push_back(std::cos(tilt) * beside + std::sin(tilt) * sun);
  }
  for (const double roughness : {0.6, 0.8, 0.9, 1.0}) {
    const LobeCase each = ggx(roughness);
    const std::vector<Rgb> values = prefilter(map, each.lobe, axes);
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const double exact = 1e5 * mean_of_lit_texel(each.exact, axes[i], map.extent(), 150, 50);
      EXPECT_NEAR(values[i].x, exact, kOracle * (mean + exact)) << each.name << ", axis " << i;
    }
  }
}

TEST(FastPrefilter, IsSymmetricAboutTheSeam) {
  const Extent extent = {32, 16};
  Grid<Rgb> map(extent);
  for (int y = 0; y < extent.height; ++y) map(0, y) = map(31, y) = Rgb(static_cast<float>(1 + y));
  for (const double roughness : {0.03, 0.2, 0.7}) {
    const Grid<Rgb> level = one_level(map, GgxLobe{alpha_of_roughness(roughness)}, extent);
    float brightest = 0.0F;
    for (const Rgb value : level.values()) brightest = std::max(brightest, value.r);
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < 16; ++x) {
        // Roundings of sums, the harmonics' and the window's.
        EXPECT_NEAR(level(x, y).r, level(31 - x, y).r, 1e-6F * brightest) << roughness;
      }
    }
  }
}

TEST(FastPrefilter, AtDirectionsIsTheGrid) {
  const Extent out = {12, 6};
  std::vector<Direction> centres;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      centres.push_back(direction_from_square({(x + 0.5) / out.width, (y + 0.5) / out.height}));
    }
  }
  const Grid<Rgb> map = map_of("sun-sky", {32, 16});
  for (const LobeCase& each : lobe_cases()) {
    const Grid<Rgb> grid = one_level(map, each.lobe, out);
    float brightest = 0.0F;
    for (const Rgb value : grid.values()) brightest = std::max(brightest, value.r);
    const std::vector<Rgb> values = prefilter(map, each.lobe, centres);
    // Interpolation of a function with a kink, where there is one: h^2/8 times what a slope of at
    // most 4 per radian jumps by over a step h = pi/128, averaged over the texels of a sun.
    const double kink = 4.0 * std::pow(kPi / 128.0, 2) / 8.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(values[i].r, grid.values()[i].r, kink * static_cast<double>(brightest))
          << each.name;
    }
  }
}

TEST(Prefilter, KeepsAConstantMap) {
  const Grid<Rgb> map = map_of("constant", {24, 12});
  for (const PrefilterMethodInfo& info : prefilter_methods()) {
    for (const LobeCase& each : lobe_cases()) {
      const Grid<Rgb> level = one_level(map, each.lobe, {6, 3}, {info.method, 100, 12});
      for (const Rgb value : level.values()) {
        // Floats near 1, and shares that add up to 1 to 1e-7.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], 1.0F, 4e-7F) << info.name << each.name;
      }
    }
  }
}

TEST(Prefilter, KeepsTheLightOfASun) {
  // The integral over all directions is that of the map. A row's mean g, at its centre, for all of
  // the row of height h: summed by parts, the rows are off by h^2/24 times 2 pi times the integral
  // of g' cos(theta), which is at most the total variation of g. What comes next is (h/alpha)^2, a
  // hundredth, of it.
  const Grid<Rgb> map = map_of("sun-sky", {64, 32});
  glm::dvec3 light(0.0);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      light += texel_solid_angle({64, 32}, y) * glm::dvec3(map(x, y));
    }
  }
  const Extent out = {256, 128};
  const Grid<Rgb> level = one_level(map, GgxLobe{0.25}, out);
  glm::dvec3 kept(0.0);
  glm::dvec3 variation(0.0);
  glm::dvec3 last(0.0);
  for (int y = 0; y < out.height; ++y) {
    glm::dvec3 mean(0.0);
    for (const Rgb value : level.row(y)) mean += glm::dvec3(value) / 256.0;
    kept += 256.0 * texel_solid_angle(out, y) * mean;
    if (y > 0) variation += glm::abs(mean - last);
    last = mean;
  }
  const double step = kPi / 128.0;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(kept[c], light[c], 1.1 * step * step / 24.0 * 2.0 * kPi * variation[c]);
    EXPECT_LT(step * step / 24.0 * 2.0 * kPi * variation[c], 1e-3 * light[c])
        << "it says something";
  }
}

TEST(Prefilter, ShowsTheMapItselfInAMirror) {
  const Grid<Rgb> map = map_of("black-first-row", {20, 10});
  const PrefilteredLevel same = {std::nullopt, {20, 10}};
  const Grid<Rgb> level = std::move(prefilter(map, {&same, 1}).front());
  for (std::size_t i = 0; i < map.values().size(); ++i) {
    EXPECT_EQ(level.values()[i], map.values()[i]);
  }
  const Direction direction = direction_from_square({0.33, 0.71});
  const std::vector<Rgb> at = prefilter(map, std::nullopt, {&direction, 1});
  EXPECT_EQ(at.front(), map(6, 7));
}

TEST(Prefilter, LosesNoLightInASmallerMirror) {
  const Grid<Rgb> map = map_of("sun-sky", {50, 30});
  const Extent out = {12, 7};
  const PrefilteredLevel smaller = {std::nullopt, out};
  const Grid<Rgb> level = std::move(prefilter(map, {&smaller, 1}).front());
  double whole = 0.0;
  double kept = 0.0;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 50; ++x)
      whole += texel_solid_angle({50, 30}, y) * static_cast<double>(map(x, y).r);
  }
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x)
      kept += texel_solid_angle(out, y) * static_cast<double>(level(x, y).r);
  }
  EXPECT_NEAR(kept, whole, 0x1p-24 * whole) << "each texel is rounded once";
}

TEST(Prefilter, FilteredSamplesFindASunThatOthersMiss) {
  const Grid<Rgb> map = map_of("sun-sky", {128, 64});
  const Extent out = {16, 8};
  const Lobe lobe = GgxLobe{0.25};
  const Grid<glm::dvec3> exact = reference::prefiltered(map, reference::ggx_lobe(0.25), out);
  const auto error = [&](PrefilterMethod method) {
    const Grid<Rgb> level = one_level(map, lobe, out, {method, 64});
    double sum = 0.0;
    for (std::size_t i = 0; i < exact.values().size(); ++i) {
      const glm::dvec3 difference = glm::dvec3(level.values()[i]) - exact.values()[i];
      sum += glm::dot(difference, difference);
    }
    return std::sqrt(sum);
  };
  EXPECT_LT(2.0 * error(PrefilterMethod::filtered), error(PrefilterMethod::half_vector));
  EXPECT_LT(2.0 * error(PrefilterMethod::filtered), error(PrefilterMethod::lobe));
}

TEST(Prefilter, BySamplesTendsToTheIntegral) {
  // A map that is linear in z: the mean of 1 + z/2 over the lobe is 1 + lambda_1 z/2, but for the
  // steps of 1/256 from row to row, and for the discrepancy of 4096 points in two dimensions, below
  // (log2(4096) + 2)/4096, times a variation of at most some units.
  const Grid<Rgb> map = map_of("gradient", {512, 256});
  const Lobe lobe = GgxLobe{0.3};
  const double factor = zonal_factors(lobe, 1)[1];
  for (const PrefilterMethod method :
       {PrefilterMethod::half_vector, PrefilterMethod::lobe, PrefilterMethod::filtered}) {
    const Grid<Rgb> level = one_level(map, lobe, {8, 4}, {method, 4096});
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 8; ++x) {
        const double z = cos_theta((y + 0.5) / 4.0);
        EXPECT_NEAR(level(x, y).r, 1.0 + 0.5 * factor * z, 4.0 * 14.0 / 4096.0 + 1.0 / 256.0);
      }
    }
  }
}

TEST(Prefilter, HasTheSameBitsOnAnyNumberOfThreads) {
  const Grid<Rgb> map = map_of("sun-sky", {40, 20});
  std::vector<PrefilteredLevel> levels = {{std::nullopt, {10, 5}}};
  for (const LobeCase& each : lobe_cases()) levels.push_back({each.lobe, {16, 8}});
  for (const PrefilterMethodInfo& info : prefilter_methods()) {
    const PrefilterSettings settings = {info.method, 64, 8};
    const std::vector<Grid<Rgb>> many = prefilter(map, levels, settings);
    const ThreadLimit limit(1);
    const std::vector<Grid<Rgb>> one = prefilter(map, levels, settings);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      for (std::size_t k = 0; k < one[i].values().size(); ++k) {
        ASSERT_EQ(one[i].values()[k], many[i].values()[k]) << info.name;
      }
    }
  }
}

TEST(Prefilter, RefusesWhatItCannotDo) {
  const Grid<Rgb> map = map_of("constant", {4, 2});
  const auto with = [&](const PrefilterSettings& settings) {
    one_level(map, GgxLobe{0.5}, {4, 2}, settings);
  };
  const auto says = [](std::string_view words) {
    return testing::ThrowsMessage<InputError>(testing::HasSubstr(std::string(words)));
  };
  EXPECT_THAT([&] { with({PrefilterMethod::half_vector, 0}); }, says("0 samples"));
  EXPECT_THAT([&] { with({PrefilterMethod::spherical_harmonics, 1, 5000}); }, says("0 to 1800"));
  EXPECT_THAT([] { prefilter_method_by_name("slow"); }, says("fast"));
  EXPECT_EQ(prefilter_method_by_name("half-vector"), PrefilterMethod::half_vector);
}

}  // namespace
}  // namespace lightproof
