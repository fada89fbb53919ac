// Drawn directions against the density that the material declares.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lightproof/core/moments.h"
#include "lightproof/core/random.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/warp/lat_long.h"
#include "shading.h"

namespace lightproof {
namespace {

constexpr Extent kBins = {16, 32};
/// Trapezoids per side of a bin. Nodes on the edges, too: no sliver of the support goes unseen.
constexpr int kTrapezoids = 64;
constexpr double kCells = 16.0 * 32.0 * kTrapezoids * kTrapezoids;
/// Between nodes, in radians of theta.
constexpr double kStep = kPi / (32.0 * kTrapezoids);
constexpr std::uint64_t kSamples = 1U << 19U;
constexpr double kLog10Alpha = -6.0;

PerSteradian pdf(const ShadingCase& at, Direction light) {
  return std::visit([&](const auto& m) { return m.evaluate(at.at, light).pdf; }, at.material);
}
DirectionSample sample(const ShadingCase& at, SquarePoint u) {
  return std::visit([&](const auto& m) { return m.sample(at.at, u); }, at.material);
}
double reflected_cosine(const ShadingCase& at, Direction light) {
  return std::visit([&](const auto& m) { return m.evaluate(at.at, light).reflected_cosine; },
                    at.material);
}

/// The mass of every bin, and the moments of the weight f_r (n.l)+ / pdf.
struct BinIntegrals {
  Grid<double> mass = Grid<double>(kBins);
  std::array<double, 5> raw = {};  ///< of order 0 to 4, about zero

  explicit BinIntegrals(const ShadingCase& at) {
    for (int y = 0; y < kBins.height; ++y) {
      for (int x = 0; x < kBins.width; ++x) add_bin(at, x, y);
    }
  }

 private:
  void add_bin(const ShadingCase& at, int x, int y) {
    for (int j = 0; j <= kTrapezoids; ++j) {
      for (int i = 0; i <= kTrapezoids; ++i) {
        const double halves =
            (i % kTrapezoids == 0 ? 0.5 : 1.0) * (j % kTrapezoids == 0 ? 0.5 : 1.0);
        const SquarePoint node = {(x + static_cast<double>(i) / kTrapezoids) / kBins.width,
                                  (y + static_cast<double>(j) / kTrapezoids) / kBins.height};
        const double area = halves / kCells;
        add_node(at, direction_from_square(node), area * solid_angle_per_square(node.t), x, y);
      }
    }
  }

  void add_node(const ShadingCase& at, Direction light, double solid_angle, int x, int y) {
    const double p = pdf(at, light).value;
    if (p <= 0.0) return;
    mass(x, y) += p * solid_angle;
    const double weight = reflected_cosine(at, light) / p;
    double term = p * solid_angle;
    for (double& moment : raw) {
      moment += term;
      term *= weight;
    }
  }
};

/// What the trapezoids may be off by: at a pole the integrand pdf sin(theta) has the slope pdf,
/// which costs h^2/12 of it all around; kinks of slope 1/pi at the horizon and of the lobe cost
/// h^2/8 on a circle, with the 4h between nodes in phi for h.
double quadrature_error(const ShadingCase& at) {
  const double poles = pdf(at, {0, 0, 1}).value + pdf(at, {0, 0, -1}).value;
  return kStep * kStep * (2.0 * kPi * poles / 12.0 + 2.0 * 16.0 / 8.0 * 2.0);
}

class EveryCase : public testing::TestWithParam<ShadingCase> {
 protected:
  RandomStream stream(std::string_view claim) const {
    return {"Materials." + std::string(claim) + "." + GetParam().name, 1};
  }
};

TEST_P(EveryCase, PdfIntegratesToOneOverTheSphere) {
  EXPECT_NEAR(BinIntegrals(GetParam()).raw[0], 1.0, quadrature_error(GetParam()));
}

TEST_P(EveryCase, SamplesFollowThePdf) {
  const RandomStream random = stream("SamplesFollowThePdf");
  Grid<std::uint64_t> counts(kBins);
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const SquarePoint at = square_from_direction(sample(GetParam(), random.point(i)).direction);
    ++counts(std::min(static_cast<int>(at.s * kBins.width), kBins.width - 1),
             std::min(static_cast<int>(at.t * kBins.height), kBins.height - 1));
  }
  const BinIntegrals exact(GetParam());
  std::vector<double> masses = serpentine(exact.mass);
  for (double& mass : masses) mass /= exact.raw[0];  // what the quadrature is off by
  const GoodnessOfFit fit = cressie_read(serpentine(counts), masses, kSamples);
  EXPECT_GT(fit.dof, 8.0);
  EXPECT_GT(fit.log10_p, kLog10Alpha)
      << "statistic " << fit.statistic << " on " << fit.dof << ", effect " << fit.effect
      << ", impossible " << fit.impossible_hits;
}

TEST_P(EveryCase, ReturnedPdfIsThatOfTheDirection) {
  const RandomStream random = stream("ReturnedPdfIsThatOfTheDirection");
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const DirectionSample drawn = sample(GetParam(), random.point(i));
    EXPECT_NEAR(glm::length(drawn.direction), 1.0, 2e-15);
    EXPECT_GT(drawn.scattering.pdf.value, 0.0);
    EXPECT_NEAR(drawn.scattering.pdf.value, pdf(GetParam(), drawn.direction).value,
                1e-12 * std::max(1.0, drawn.scattering.pdf.value));
    const double reflected = reflected_cosine(GetParam(), drawn.direction);
    EXPECT_NEAR(drawn.scattering.reflected_cosine, reflected, 1e-12 * std::max(1.0, reflected));
  }
}

TEST_P(EveryCase, EstimatorOfTheAlbedoHasItsMeanAndVariance) {
  const BinIntegrals exact(GetParam());
  const auto& raw = exact.raw;
  const double variance = raw[2] - raw[1] * raw[1];
  const RandomStream random = stream("EstimatorOfTheAlbedoHasItsMeanAndVariance");
  Moments weights;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const DirectionSample drawn = sample(GetParam(), random.point(i));
    weights.add(reflected_cosine(GetParam(), drawn.direction) / drawn.scattering.pdf.value);
  }
  if (variance < 1e-6) {
    // A weight that is constant up to rounding.
    EXPECT_NEAR(weights.mean(), raw[1], quadrature_error(GetParam()));
    EXPECT_LT(weights.variance(), 1e-20);
    return;
  }
  const double fourth =
      raw[4] - 4.0 * raw[1] * raw[3] + 6.0 * raw[1] * raw[1] * raw[2] - 3.0 * std::pow(raw[1], 4);
  EXPECT_GT(mean_test(weights, {raw[1], variance}).log10_p, kLog10Alpha);
  EXPECT_GT(variance_test(weights, {raw[1], variance}, fourth).log10_p, kLog10Alpha);
}

TEST_P(EveryCase, EdgesOfTheSquareGiveDirections) {
  constexpr double kBelowOne = 1.0 - 0x1p-53;
  for (const double s : {0.0, 0x1p-53, 0.25, 1.0 / 3.0, 0.5, kBelowOne}) {
    for (const double t : {0.0, 0x1p-53, 0.5, kBelowOne}) {
      const DirectionSample drawn = sample(GetParam(), {s, t});
      EXPECT_NEAR(glm::length(drawn.direction), 1.0, 2e-15);
      EXPECT_TRUE(std::isfinite(drawn.scattering.pdf.value) && drawn.scattering.pdf.value >= 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryCase, testing::ValuesIn(shading_cases()),
                         [](const auto& param) { return param.param.name; });

TEST(Materials, PdfOverTheUpperHemisphereIsAtMostOne) {
  for (const ShadingCase& each : shading_cases()) {
    if (each.at.frame.normal.z != 1.0) continue;
    const BinIntegrals exact(each);
    double upper = 0.0;
    for (int y = kBins.height / 2; y < kBins.height; ++y) {
      for (const double mass : exact.mass.row(y)) upper += mass;
    }
    EXPECT_LE(upper, 1.0 + quadrature_error(each)) << each.name;
    // Diffuse light never goes below; of a lobe at grazing view nearly half does.
    const bool diffuse = std::holds_alternative<Lambert>(each.material);
    EXPECT_GE(upper, diffuse ? 1.0 - quadrature_error(each) : 0.5) << each.name;
    const bool grazing_lobe = each.name == "PhongSpecularOnlyUp85";
    EXPECT_LE(upper, grazing_lobe ? 0.7 : 2.0) << each.name;
  }
}

}  // namespace
}  // namespace lightproof
