// Reflectances of the materials by quadrature, against closed forms.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <functional>

#include "lightproof/core/random.h"
#include "shading.h"

namespace lightproof {
namespace {

constexpr Direction kUp = {0, 0, 1};

/// The integral over the upper hemisphere: 60 Gauss-Legendre nodes in theta and in each quarter of
/// phi, which is exact to rounding for what is smooth in each quarter.
double hemisphere_integral(const std::function<double(Direction)>& f) {
  using Gauss = boost::math::quadrature::gauss<double, 60>;
  double sum = 0.0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    sum += Gauss::integrate(
        [&](double phi) {
          return Gauss::integrate(
              [&](double theta) {
                const double sine = std::sin(theta);
                return sine * f({sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)});
              },
              0.0, 0.5 * kPi);
        },
        0.5 * kPi * quarter, 0.5 * kPi * (quarter + 1));
  }
  return sum;
}

template <class M>
double albedo(const M& material, Direction view) {
  const ShadingPoint at = {{}, frame_around(kUp), view};
  return hemisphere_integral(
      [&](Direction light) { return material.evaluate(at, light).reflected_cosine; });
}

Direction view_at(double angle) { return {std::sin(angle), 0.0, std::cos(angle)}; }

// 14400 additions of numbers of one sign, and powers that amplify a rounding up to 100 times.
constexpr double kRounding = 1e-12;

TEST(Lambert, ReflectsItsAlbedoFromEveryView) {
  for (const double angle : {0.0, 0.7, 1.5}) {
    EXPECT_NEAR(albedo(Lambert{0.8}, view_at(angle)), 0.8, kRounding);
  }
}

TEST(Lambert, IsAlbedoOverPiTimesTheCosine) {
  const ShadingPoint at = shading_point(kUp, 0.5);
  EXPECT_DOUBLE_EQ(Lambert{0.8}.evaluate(at, kUp).reflected_cosine, 0.8 / kPi);
  EXPECT_DOUBLE_EQ(Lambert{0.8}.evaluate(at, {0.8, 0.0, 0.6}).reflected_cosine, 0.8 * 0.6 / kPi);
  EXPECT_EQ(Lambert{0.8}.evaluate(at, {0.8, 0.0, -0.6}).reflected_cosine, 0.0);
}

TEST(ModifiedPhong, ReflectsItsSpecularShareWholeAtNormalView) {
  for (const double exponent : {0.0, 1.0, 10.0, 50.0, 100.0}) {
    EXPECT_NEAR(albedo(ModifiedPhong{0.0, 1.0, exponent}, view_at(0.0)), 1.0, kRounding);
    EXPECT_NEAR(albedo(ModifiedPhong{0.3, 0.6, exponent}, view_at(0.0)), 0.9, kRounding);
  }
}

TEST(ModifiedPhong, LosesHalfOfItsLobeAndMoreAtGrazingView) {
  struct Row {
    double exponent;
    double printed;
  };
  for (const Row& row : {Row{1.0, 0.3183}, Row{10.0, 0.1230}, Row{100.0, 0.0398}}) {
    const double n = row.exponent;
    const double exact = (n + 2.0) / (2.0 * kPi) * std::beta(0.5 * (n + 1.0), 1.5);
    const double measured = albedo(ModifiedPhong{0.0, 1.0, n}, {1, 0, 0});
    EXPECT_NEAR(measured, exact, kRounding) << n;
    EXPECT_NEAR(measured, row.printed, 5e-5) << "as printed";
  }
}

TEST(ModifiedPhong, OfExponentOneHasAClosedFormForEveryView) {
  // The irradiance of a cosine lobe, times 3/2pi. The horizon of the lobe is a kink of slope 1
  // across nodes that are 0.07 apart at most: 0.07^2/8 on a circle where the cosine integrates to
  // 2, were all of the errors on one side.
  for (const double gamma : {0.0, 0.3, 0.8, 1.2, 0.5 * kPi}) {
    const double exact = ((kPi - gamma) * std::cos(gamma) + std::sin(gamma)) / kPi;
    EXPECT_NEAR(albedo(ModifiedPhong{0.0, 1.0, 1.0}, view_at(gamma)), exact,
                1.5 / kPi * 0.07 * 0.07 / 4.0);
  }
}

/// (n+2)/2pi times the integral of cos^n(alpha) (n.l)+ over the lobe of a mirrored view at the
/// angle gamma. Around the lobe's axis n.l is a + b cos(phi), whose positive part has a closed
/// form; what is left is integrated over the share of the lobe, between the angles where its form
/// changes.
double lobe_albedo(double n, double gamma) {
  using Rule = boost::math::quadrature::tanh_sinh<double>;
  const auto ring = [&](double share) {
    const double cosine = std::pow(share, 1.0 / (n + 1.0));
    const double a = std::cos(gamma) * cosine;
    const double b = std::sin(gamma) * std::sqrt((1.0 - cosine) * (1.0 + cosine));
    if (a >= b) return 2.0 * kPi * a;
    const double last = std::acos(-a / b);
    return 2.0 * (a * last + b * std::sin(last));
  };
  const double edge = std::pow(std::sin(gamma), n + 1.0);
  const double whole = edge < 1.0 ? Rule().integrate(ring, edge, 1.0) : 0.0;
  const double part = edge > 0.0 ? Rule().integrate(ring, 0.0, edge) : 0.0;
  return (n + 2.0) / (2.0 * kPi) * (whole + part) / (n + 1.0);
}

/// The mean of reflected cosine over pdf, at points of the plane's R2 sequence.
template <class M>
double mean_weight(const M& material, const ShadingPoint& at) {
  constexpr int kPoints = 1 << 16;
  double sum = 0.0;
  for (int i = 1; i <= kPoints; ++i) {
    const SquarePoint u = {std::fmod(i * 0.75487766624669276, 1.0),
                           std::fmod(i * 0.56984029099805327, 1.0)};
    const Scattering scattering = material.sample(at, u).scattering;
    sum += scattering.reflected_cosine / scattering.pdf.value;
  }
  return sum / kPoints;
}

// A white furnace at every exponent and angle; N^(-3/4) of the points is 2.5e-4.
TEST(ModifiedPhong, ReflectsInAWhiteFurnaceWhatItsLobeDoes) {
  for (const double exponent : {0.0, 1.0, 10.0, 50.0, 100.0, 1000.0, 1e6}) {
    for (const double degrees : {0.0, 45.0, 80.0, 89.9}) {
      const double gamma = degrees * kPi / 180.0;
      const double exact = 0.3 + 0.6 * lobe_albedo(exponent, gamma);
      const ShadingPoint at = {{}, frame_around(kUp), view_at(gamma)};
      EXPECT_NEAR(mean_weight(ModifiedPhong{0.3, 0.6, exponent}, at), exact, 1e-3)
          << exponent << ", " << degrees;
    }
  }
  // Its own closed forms, at both ends.
  EXPECT_NEAR(lobe_albedo(50.0, 0.0), 1.0, 1e-9);
  EXPECT_NEAR(lobe_albedo(10.0, 0.5 * kPi), 12.0 / (2.0 * kPi) * std::beta(5.5, 1.5), 1e-9);
}

TEST(Lambert, ReflectsItsAlbedoInAWhiteFurnace) {
  for (const double degrees : {0.0, 45.0, 80.0, 89.9}) {
    const ShadingPoint at = {{}, frame_around(kUp), view_at(degrees * kPi / 180.0)};
    EXPECT_NEAR(mean_weight(Lambert{0.8}, at), 0.8, kRounding);
  }
}

TEST(ModifiedPhong, NeverReflectsMoreThanItsReflectances) {
  for (const double exponent : {1.0, 10.0, 100.0}) {
    const ModifiedPhong material{0.3, 0.6, exponent};
    for (int degrees = 0; degrees <= 90; degrees += 15) {
      EXPECT_LE(albedo(material, view_at(degrees * kPi / 180.0)), 0.9 + kRounding);
    }
  }
}

TEST(ModifiedPhong, PeaksAtTheMirroredView) {
  const ShadingPoint at = shading_point(kUp, 0.6);
  const Direction mirrored = reflect_about(at.view, kUp);
  const double cosine = std::cos(0.6);
  // (n+2)/2pi at the peak; its power of 50 takes 50 ulp.
  EXPECT_NEAR((ModifiedPhong{0.0, 1.0, 50.0}.evaluate(at, mirrored).reflected_cosine),
              52.0 / (2.0 * kPi) * cosine, 1e-12);
  EXPECT_NEAR((ModifiedPhong{0.3, 0.0, 50.0}.evaluate(at, mirrored).reflected_cosine),
              0.3 / kPi * cosine, 1e-15);
}

/// A direction of the upper hemisphere, away from its rim.
Direction upper_direction(SquarePoint u) {
  const double z = 0.01 + 0.99 * u.t;
  const double sine = std::sqrt((1.0 - z) * (1.0 + z));
  return {sine * std::cos(2.0 * kPi * u.s), sine * std::sin(2.0 * kPi * u.s), z};
}

/// f_r around the z axis.
double brdf(const Material& material, Direction view, Direction light) {
  const ShadingPoint at = {{}, frame_around(kUp), view};
  return std::visit([&](const auto& m) { return m.evaluate(at, light).reflected_cosine; },
                    material) /
         light.z;
}

TEST(Materials, AreReciprocal) {
  const RandomStream stream("Materials.AreReciprocal", 1);
  for (const MaterialInfo& info : materials()) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Direction a = upper_direction(stream.point(2 * i));
      const Direction b = upper_direction(stream.point(2 * i + 1));
      const double forwards = brdf(info.material, a, b);
      // The cosine of the lobe, 1e-16 off, to the power of 50.
      EXPECT_NEAR(brdf(info.material, b, a), forwards, 1e-13 * forwards) << info.name;
    }
  }
}

TEST(Materials, ReflectNothingFromBelow) {
  for (const ShadingCase& each : shading_cases()) {
    const Direction normal = each.at.frame.normal;
    const Direction below = glm::normalize(-0.01 * normal - each.at.frame.tangent);
    const double reflected = std::visit(
        [&](const auto& m) { return m.evaluate(each.at, below).reflected_cosine; }, each.material);
    EXPECT_EQ(reflected, 0.0) << each.name;
  }
}

}  // namespace
}  // namespace lightproof
