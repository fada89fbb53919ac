// Biased estimators: what they converge to, how far that is from the exact light, which materials
// they serve; and what every estimator keeps to.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lightproof/accuracy/exact_light.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/estimators/diffuse_tables.h"
#include "lightproof/estimators/median_cut.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/estimators/riemann_sum.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/specular_chain.h"
#include "lightproof/prefilter/spherical_harmonics.h"
#include "lightproof/render/receiver.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr Extent kExtent = {64, 32};

/// A point in the open, seen at this angle from its normal.
ShadingPoint open_point(Direction normal, double angle) {
  const Frame frame = frame_around(glm::normalize(normal));
  return {glm::dvec3(0.0), frame, frame.to_world({std::sin(angle), 0.0, std::cos(angle)})};
}

const Scene& nothing() {
  static const Scene scene({false, false});
  return scene;
}

BoundEstimator bound(std::string_view estimator, const EnvironmentMap& map,
                     const Material& material) {
  return estimator_by_name(estimator).prepare(map).bind(nothing(), material);
}

double luminance(const BoundEstimator& estimator, const ShadingPoint& at, std::uint64_t samples) {
  return luminance_of(estimator.integrate(at, RandomStream("biased", 1), {0, samples}, {}));
}

reference::LightMoments exact_moments(const EnvironmentMap& map, const Material& material,
                                      const ShadingPoint& at) {
  const Grid<double> grid = luminance_of(map);
  return reference::light_moments(kernel_at(receiver_by_name("point"), nothing(), material, at),
                                  {&grid, 1})[0];
}
double exact_light_at(const EnvironmentMap& map, const Material& material, const ShadingPoint& at) {
  return exact_moments(map, material, at)[reference::SampledDensity::uniform].mean();
}

/// A sky of radiance 1 with a sun of few texels, so faint that nine harmonics stay positive: its
/// light is below a twentieth of the sky's, and they err by 3/32 of it.
EnvironmentMap faint_sun() {
  EnvironmentMap map = make_synthetic_map("constant", kExtent);
  for (int x = 14; x < 16; ++x) map.radiance(x, 24) = Rgb(20.0F);
  return map;
}

// The root mean square over normals is what the harmonics beyond degree 2 hold, sqrt(sum A^2
// |L|^2 / 4 pi); up to degree 40, beyond which A^2 falls like l^-5, to below 1e-4 of the whole. The
// normals of 128 x 64 texels weigh by solid angle.
TEST(NineHarmonics, HaveTheFloorOfTheOmittedOnes) {
  const EnvironmentMap map = faint_sun();
  const BoundEstimator estimator = bound("sh-9", map, Lambert{0.5});
  constexpr Extent kNormals = {128, 64};
  const IrradianceMap exact = irradiance_map(map, kNormals);
  double squares = 0.0;
  for (int y = 0; y < kNormals.height; ++y) {
    for (int x = 0; x < kNormals.width; ++x) {
      const Rgb reflected = estimator.integrate(open_point(normal_of_texel(kNormals, x, y), 0.3),
                                                RandomStream("sh", 1), {}, {});
      const double off = static_cast<double>(reflected.g) - 0.5 / kPi * exact.irradiance(x, y).g;
      squares += off * off * texel_solid_angle(kNormals, y) / kSphere;
    }
  }
  const double floor = 0.5 / kPi * omitted_irradiance(project(map, 40), 2).g;
  EXPECT_NEAR(std::sqrt(squares) / floor, 1.0, 0.01);
}

TEST(NineHarmonics, AreThoseOfTheProjection) {
  const EnvironmentMap map = make_synthetic_map("cosine-lobe", kExtent);
  const SphericalHarmonics irradiance = irradiance_harmonics(project(map, 2));
  const BoundEstimator estimator = bound("sh-9", map, Lambert{1.0});
  for (const Direction n : {Direction(0, 0, 1), Direction(1, 2, -2), Direction(-3, 1, 0.5)}) {
    const ShadingPoint at = open_point(n, 0.5);
    const glm::dvec3 expected =
        glm::max(evaluate(irradiance, at.frame.normal) / kPi, glm::dvec3(0.0));
    const Rgb found = estimator.integrate(at, RandomStream("sh", 1), {}, {});
    EXPECT_NEAR(found.r, expected.r, 1e-6);
    EXPECT_NEAR(found.b, expected.b, 1e-6);
  }
}

// The gradient's irradiance is pi c (1 + n.z/3), linear in the height: between rows h = pi/32 apart
// interpolation loses h^2/8 of the height at the most.
TEST(TabulatedIrradiance, LosesNoMoreThanItsStep) {
  const EnvironmentMap map = make_synthetic_map("gradient", {128, 64});
  const BoundEstimator estimator = bound("tabulated irradiance", map, Lambert{1.0});
  const double h = kPi / 32.0;
  const RandomStream normals("normals", 1);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const SquarePoint u = normals.point(i);
    const ShadingPoint at =
        open_point(direction_from_square({u.s, std::acos(1 - 2 * u.t) / kPi}), 0.3);
    const double exact = irradiance(map, at.frame.normal).rgb.r / kPi;
    const Rgb found = estimator.integrate(at, RandomStream("table", 1), {}, {});
    EXPECT_NEAR(found.r, exact, 1.05 / 3.0 * h * h / 8.0);
  }
}

TEST(MedianCut, KeepsAllLight) {
  for (const std::string_view name : {"gradient", "sun-sky", "checker"}) {
    const EnvironmentMap map = make_synthetic_map(name, {256, 128});
    const double whole = project(map, 0)(0, 0).g * std::sqrt(kSphere);
    for (const int cuts : {0, 4, 10}) {
      const auto lights = median_cut(map, cuts);
      const std::size_t most = std::size_t{1} << static_cast<unsigned>(cuts);
      // The sun's nine texels are cut no further.
      EXPECT_LE(lights.size(), most) << name;
      EXPECT_EQ(lights.size() < most, name == "sun-sky" && cuts == 10) << name;
      double sum = 0.0;
      for (const DirectedLight& light : lights) {
        sum += light.flux.g;
        EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-12);
      }
      EXPECT_NEAR(sum / whole, 1.0, 1e-6) << name << ", " << cuts;
    }
  }
}

// Of a map without a bright texel, sixteen regions hold a sixteenth of the light each, but for what
// half a row or a column of texels holds at four cuts: 1/64 of the map at the first, twice that of
// what is left at each later one.
TEST(MedianCut, MakesLightsOfEqualPower) {
  const EnvironmentMap map = make_synthetic_map("gradient", {256, 128});
  const auto lights = median_cut(map, 4);
  double sum = 0.0;
  for (const DirectedLight& light : lights) sum += light.flux.g;
  for (const DirectedLight& light : lights) {
    EXPECT_NEAR(light.flux.g / (sum / 16.0), 1.0, 4.0 / 32.0);
  }
}

// Cut down to texels, the sum over lights is the rule of the texels' centres.
TEST(MedianCut, EndsAtTheTexels) {
  const EnvironmentMap map = make_synthetic_map("gradient", {16, 8});
  const ShadingPoint at = open_point({1, 2, 3}, 0.6);
  const Material material = ModifiedPhong{0.3, 0.6, 5.0};
  const Extent extent = map.radiance.extent();
  double expected = 0.0;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const Direction centre =
          direction_from_square({(x + 0.5) / extent.width, (y + 0.5) / extent.height});
      expected += luminance_of(map.radiance(x, y)) * texel_solid_angle(extent, y) *
                  std::get<ModifiedPhong>(material).evaluate(at, centre).reflected_cosine;
    }
  }
  const BoundEstimator estimator = median_cut_lights(map, 7).bind(nothing(), material);
  EXPECT_NEAR(luminance(estimator, at, 1) / expected, 1.0, 1e-5);
}

// Error against the exact light falls with the number of lights, for what is as broad as regions.
TEST(MedianCut, NeedsManyLightsForASmallError) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  double before = 1.0;
  for (const int lights : {16, 64, 256, 1024}) {
    const BoundEstimator estimator = bound(fmt::format("median cut {}", lights), map, Lambert{0.8});
    double squares = 0.0;
    for (const Direction n : {Direction(0, 0, 1), Direction(1, 2, -2), Direction(-3, 1, 0.5),
                              Direction(0, 1, 0.2), Direction(0.5, -1, -0.1)}) {
      const ShadingPoint at = open_point(n, 0.4);
      const double exact = exact_light_at(map, Lambert{0.8}, at);
      squares += std::pow(luminance(estimator, at, 1) / exact - 1.0, 2.0);
    }
    const double error = std::sqrt(squares / 5.0);
    EXPECT_LT(error, before) << lights;
    before = error;
  }
  EXPECT_LT(before, 0.01);
}

TEST(RiemannSum, UsesNoMoreThanItsBudget) {
  for (std::uint64_t n = 1; n <= 65536; n = n * 3 / 2 + 1) {
    const auto [azimuths, polar] = riemann_steps(n);
    EXPECT_GE(azimuths * polar, 1U);
    EXPECT_LE(azimuths * polar, n);
    EXPECT_GT(azimuths * polar, n - polar);
  }
}

TEST(RiemannSum, IsExactForConstantLightOnLambert) {
  const EnvironmentMap map = make_synthetic_map("constant", kExtent);
  const BoundEstimator estimator = bound("riemann", map, Lambert{0.8});
  for (const std::uint64_t n : {1U, 2U, 50U, 1000U}) {
    EXPECT_NEAR(luminance(estimator, open_point({1, 2, 3}, 0.4), n), 0.8, 1e-6) << n;
  }
}

/// How far an estimator is off at one point, relative to the exact light.
double relative_error(std::string_view estimator, const EnvironmentMap& map,
                      const Material& material, const ShadingPoint& at, std::uint64_t samples) {
  const double exact = exact_light_at(map, material, at);
  return std::abs(luminance(bound(estimator, map, material), at, samples) / exact - 1.0);
}

// With 65536 samples a cell is pi/362 wide, smaller than a texel and than the lobes. The map's
// steps from texel to texel, 0.5 pi/32 of the light, are met on average; what is left of them is
// below a step over the square root of the thousand texels, 2e-3.
TEST(RiemannSum, ConvergesToTheExactLight) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const ShadingPoint at = open_point({1, 2, 3}, 0.6);
  for (const std::string_view name : {"lambert", "phong", "ggx"}) {
    const Material& material = material_by_name(name).material;
    EXPECT_LT(relative_error("riemann", map, material, at, 65536), 2e-3) << name;
  }
}

// The bilinear look-up is all that is left of the filter, and of a smooth map it changes h^2/8 of
// its curvature; points of Hammersley's err by less than 1e-3 at 65536.
TEST(FilteredSampling, ConvergesToTheExactLightOfASmoothMap) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const ShadingPoint at = open_point({1, 2, 3}, 0.6);
  for (const std::string_view name : {"lambert", "phong", "ggx"}) {
    const Material& material = material_by_name(name).material;
    EXPECT_LT(relative_error("filtered importance sampling", map, material, at, 65536), 2e-3)
        << name;
  }
}

// Few samples see a small sun through the filter, and scatter less than the lobe's own samples.
TEST(FilteredSampling, ScattersLessThanTheLobeAlone) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {128, 64});
  const Material& material = material_by_name("lambert").material;
  const ShadingPoint at = open_point({0, 0, 1}, 0.6);
  const auto squares = [&](std::string_view name) {
    const BoundEstimator estimator = bound(name, map, material);
    const double exact = exact_light_at(map, material, at);
    double sum = 0.0;
    for (std::uint64_t i = 0; i < 256; ++i) {
      const Rgb one = estimator.integrate(at, RandomStream("filter", 1), {16 * i, 16}, {});
      sum += std::pow(luminance_of(one) / exact - 1.0, 2.0);
    }
    return sum;
  };
  EXPECT_LT(squares("filtered importance sampling"), squares("brdf hammersley"));
}

// A set of 1024 lights at Sobol's points errs by no more than 1024 independent samples would, six
// times their standard error; those of the map alone have more variance than those of the map times
// a cosine.
TEST(LightSets, HaveTheFloorOfTheirSize) {
  for (const std::string_view map_name : {"constant", "gradient", "sun-sky"}) {
    const EnvironmentMap map = make_synthetic_map(map_name, kExtent);
    for (const std::string_view name : {"lambert", "phong"}) {
      const Material& material = material_by_name(name).material;
      const BoundEstimator estimator = bound("light sets", map, material);
      for (const Direction n : {Direction(0, 0, 1), Direction(1, 2, -2), Direction(-3, 1, 0.5)}) {
        const ShadingPoint at = open_point(n, 0.6);
        const auto moments =
            exact_moments(map, material, at)[reference::SampledDensity::solid_angle];
        const double error = std::sqrt(moments.variance() / 1024.0);
        const double all = luminance(estimator, at, 1024);
        EXPECT_NEAR(all, moments.mean(), 6.0 * error) << map_name << ", " << name;
        EXPECT_EQ(luminance(estimator, at, 65536), all) << "all of them, whatever the budget";
        EXPECT_NE(luminance(estimator, at, 16), all);
      }
    }
  }
}

// Constant light: what the material reflects of a white sky, to the error of a table of 64 cosines,
// (1/64)^2/8 of its second derivative, which is below 30, and of its nodes, 5e-5.
TEST(SplitSum, IsExactForConstantLight) {
  const EnvironmentMap map = make_synthetic_map("constant", kExtent);
  for (const SmithMasking masking :
       {SmithMasking::karis, SmithMasking::separable, SmithMasking::height_correlated}) {
    for (const double roughness : {0.3, 0.5, 0.8}) {
      const Material material = Ggx{roughness, 0.04, masking};
      const BoundEstimator estimator = bound("split-sum", map, material);
      for (const double angle : {0.0, 0.5, 1.0, 1.3}) {
        const ShadingPoint at = open_point({1, 2, 3}, angle);
        EXPECT_NEAR(luminance(estimator, at, 1), exact_light_at(map, material, at), 2e-3)
            << roughness << ", " << angle;
      }
    }
  }
}

TEST(SplitSum, IsTheProductOfItsTwoLookUps) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", kExtent);
  const Ggx ggx{0.5, 0.3};
  const SpecularChain chain = ggx_chain(map.radiance, {256, 128}, 5);
  const ShadingPoint at = open_point({1, 2, 3}, 0.7);
  const Direction mirrored = reflect_about(at.view, at.frame.normal);
  const double white =
      integrate_brdf(std::cos(0.7), 0.5, Masking::height_correlated).reflected(0.3);
  const double expected = white * luminance_of(look_up(chain, mirrored, 2.0));
  EXPECT_NEAR(luminance(bound("split-sum", map, ggx), at, 1) / expected, 1.0, 1e-3);
}

// Constant light again; the lobe's share of it falls off at grazing views.
TEST(PrefilteredPhong, IsExactForConstantLight) {
  const EnvironmentMap map = make_synthetic_map("constant", kExtent);
  for (const double exponent : {1.0, 10.0, 200.0}) {
    const Material material = ModifiedPhong{0.3, 0.6, exponent};
    const BoundEstimator estimator = bound("prefiltered phong", map, material);
    for (const double angle : {0.0, 0.5, 1.0, 1.4}) {
      const ShadingPoint at = open_point({1, 2, 3}, angle);
      EXPECT_NEAR(luminance(estimator, at, 1), exact_light_at(map, material, at), 2e-3)
          << exponent << ", " << angle;
    }
  }
}

// ... and at n = v = r for any light: that is what the map was filtered for. The map has a texel
// for every eighth of the lobe's width.
TEST(PrefilteredPhong, IsExactAtNormalView) {
  const EnvironmentMap map = make_synthetic_map("checker", kExtent);
  const Material material = ModifiedPhong{0.3, 0.6, 20.0};
  const BoundEstimator estimator = bound("prefiltered phong", map, material);
  for (const Direction n : {Direction(0.1, 0, 1), Direction(1, 2, -2), Direction(-3, 1, 0.5)}) {
    const ShadingPoint at = open_point(n, 0.0);
    EXPECT_NEAR(luminance(estimator, at, 1) / exact_light_at(map, material, at), 1.0, 0.01);
  }
}

// At the middle of an entry the table has no step, but what 64 samples leave: at Sobol's points
// less than independent ones, whose relative variance is below 2 where half are of the lobes and
// the map is nearly uniform.
TEST(OutgoingTable, HoldsTheLightOfItsEntries) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  for (const std::string_view name : {"lambert", "phong", "ggx"}) {
    const Material& material = material_by_name(name).material;
    const BoundEstimator estimator = bound("outgoing table", map, material);
    EXPECT_GT(estimator.bytes, 32U * 16U * 16U * 8U * sizeof(float));
    double squares = 0.0;
    constexpr int kEntries = 16;
    for (int i = 0; i < kEntries; ++i) {
      const Frame frame = frame_around(direction_from_square({(2 * i + 0.5) / 32, (i + 0.5) / 16}));
      const double cosine = (i % 8 + 0.5) / 8.0;
      const double sine = std::sqrt(1.0 - cosine * cosine);
      const double phi = kPi - 2.0 * kPi * (i + 0.5) / 16.0;
      const ShadingPoint at = {
          glm::dvec3(0.0), frame,
          frame.to_world({sine * std::cos(phi), sine * std::sin(phi), cosine})};
      const double exact = exact_light_at(map, material, at);
      squares += std::pow(luminance(estimator, at, 1) / exact - 1.0, 2.0) / kEntries;
    }
    EXPECT_LT(std::sqrt(squares), std::sqrt(2.0 / 64.0)) << name;
  }
}

class EveryEstimator : public testing::TestWithParam<std::string_view> {};

// All materials, in the open and with something in the way: finite, not negative, the same for the
// same stream and budget; the same for any budget, if it is said to ignore it; what is not served
// is refused.
TEST_P(EveryEstimator, ServesItsMaterialsAndRefusesOthers) {
  const EstimatorInfo& info = estimator_by_name(GetParam());
  const EnvironmentMap map = make_synthetic_map("sun-sky", {32, 16});
  const PreparedEstimator prepared = info.prepare(map);
  const RandomStream stream("every", 1);
  bool serves_any = false;
  for (const std::string_view name : {"point", "sphere-on-plane"}) {
    const ReceiverInfo& receiver = receiver_by_name(name);
    const Scene scene(receiver.content);
    const ShadingPoint at = visible_pixels(receiver, scene, {3, 2}).front().point;
    for (const MaterialInfo& material : materials()) {
      if (!info.serves(material.material)) {
        EXPECT_THROW(prepared.bind(scene, material.material), InputError) << material.name;
        continue;
      }
      serves_any = true;
      const BoundEstimator estimator = prepared.bind(scene, material.material);
      for (const std::uint64_t samples : {1U, 3U, 300U}) {
        const Rgb once = estimator.integrate(at, stream, {5, samples}, {});
        for (const float channel : {once.r, once.g, once.b}) {
          EXPECT_TRUE(std::isfinite(channel) && channel >= 0.0F) << material.name;
        }
        EXPECT_EQ(estimator.integrate(at, stream, {5, samples}, {}), once);
        if (info.ignores_budget) {
          EXPECT_EQ(estimator.integrate(at, stream, {9, 7}, {}), once);
        }
      }
    }
  }
  EXPECT_TRUE(serves_any);
}

// Below a plane's horizon nothing shows; behind a sphere it does to those that say so alone.
TEST_P(EveryEstimator, SeesWhatIsInTheWayUnlessItSaysOtherwise) {
  const EstimatorInfo& info = estimator_by_name(GetParam());
  const EnvironmentMap map = make_synthetic_map("constant", {32, 16});
  const PreparedEstimator prepared = info.prepare(map);
  const Scene open({false, true});
  const Scene shaded({true, true});
  const ShadingPoint near = {{1.2, 0.0, -1.0 + kSurfaceOffset},
                             frame_around({0, 0, 1}),
                             glm::normalize(Direction(-0.1, 0.0, 1.0))};
  for (const MaterialInfo& material : materials()) {
    if (!info.serves(material.material)) continue;
    const auto light = [&](const Scene& scene) {
      return luminance_of(prepared.bind(scene, material.material)
                              .integrate(near, RandomStream("shaded", 1), {0, 4096}, {}));
    };
    if (info.ignores_occlusion) {
      EXPECT_EQ(light(shaded), light(open)) << material.name;
    } else {
      EXPECT_LT(light(shaded), light(open)) << material.name;
    }
  }
}

std::vector<std::string_view> all_names() {
  std::vector<std::string_view> names;
  for (const EstimatorInfo& info : estimators()) names.push_back(info.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Rows, EveryEstimator, testing::ValuesIn(all_names()),
                         [](const auto& test) {
                           std::string name(test.param);
                           std::ranges::replace_if(
                               name, [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

// Black maps: nothing to draw from is an error, nothing to gather is no light.
TEST(BlackMap, GivesNoLightOrIsRefused) {
  EnvironmentMap map = make_synthetic_map("constant", {16, 8});
  std::ranges::fill(map.radiance.values(), Rgb(0.0F));
  for (const EstimatorInfo& info : estimators()) {
    PreparedEstimator prepared;
    try {
      prepared = info.prepare(map);
    } catch (const InputError&) {
      EXPECT_TRUE(info.name.starts_with("environment") || info.name.starts_with("product") ||
                  info.name == "light sets")
          << info.name;
      continue;
    }
    for (const MaterialInfo& material : materials()) {
      if (!info.serves(material.material)) continue;
      const Rgb light =
          prepared.bind(nothing(), material.material)
              .integrate(open_point({1, 2, 3}, 0.5), RandomStream("black", 1), {0, 100}, {});
      EXPECT_EQ(light, Rgb(0.0F)) << info.name << ", " << material.name;
    }
  }
}

}  // namespace
}  // namespace lightproof
