#include "reference/uniform_chart.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lightproof::reference {
namespace {

using Kind = NormalDistribution::Kind;

Direction view_at(double degrees) {
  const double angle = degrees * kPi / 180.0;
  // Along no axis.
  return {0.6 * std::sin(angle), 0.8 * std::sin(angle), std::cos(angle)};
}

struct NamedChart {
  std::string name;
  UniformChart chart;
  double width;  ///< of the lobe in radians, where it is narrowest
};

std::vector<NamedChart> charts() {
  std::vector<NamedChart> all;
  for (const double exponent : {0.0, 1.0, 50.0, 1e6}) {
    for (const Direction axis :
         {Direction(0, 0, 1), Direction(0, 0, -1), Direction(0.6, 0.0, 0.8)}) {
      all.push_back({fmt::format("lobe {}", exponent), cosine_lobe_chart(axis, exponent),
                     1.0 / std::sqrt(1.0 + exponent)});
    }
  }
  for (const double g : {-0.9, 0.0, 0.3, 0.9}) {
    all.push_back({fmt::format("Henyey-Greenstein {}", g), henyey_greenstein_chart(g),
                   (1.0 - std::abs(g)) * (1.0 - std::abs(g))});
  }
  for (const double roughness : {0.01, 0.1, 0.3, 0.6, 1.0}) {
    const double alpha = roughness * roughness;
    const double shininess = 2.0 / (alpha * alpha) - 2.0;
    for (const double degrees : {0.0, 45.0, 80.0, 89.9}) {
      const Direction view = view_at(degrees);
      // Turning the normal by an angle across the view turns the light by 2 v.h of it.
      const double width = alpha * std::min(1.0, 2.0 * view.z);
      const std::string at = fmt::format(" {} at {}", roughness, degrees);
      all.push_back({"GGX" + at, mirrored_at_normals({Kind::ggx, alpha}, view), width});
      all.push_back({"Blinn" + at, mirrored_at_normals({Kind::blinn, shininess}, view), width});
      all.push_back({"visible" + at, mirrored_at_visible_normals(alpha, view), width});
      all.push_back({"bounded" + at, mirrored_at_bounded_normals(alpha, view), width});
    }
  }
  return all;
}

std::vector<SquarePoint> points() {
  std::vector<SquarePoint> all;
  for (int i = 1; i <= 200; ++i) {
    // The plane's R2 sequence, away from the edges, where derivatives may be infinite.
    all.push_back({0.01 + 0.98 * std::fmod(i * 0.75487766624669276, 1.0),
                   0.01 + 0.98 * std::fmod(i * 0.56984029099805327, 1.0)});
  }
  return all;
}

TEST(UniformChart, GivesUnitVectorsAndTakesThemBack) {
  for (const NamedChart& each : charts()) {
    SCOPED_TRACE(each.name);
    for (const SquarePoint at : points()) {
      const Direction d = each.chart.direction_from_square(at);
      EXPECT_NEAR(glm::length(d), 1.0, 1e-14);
      const auto back = each.chart.square_from_direction(d);
      ASSERT_TRUE(back.has_value());
      // A few roundings of the direction, as a share of the lobe, where its slope is up to a
      // hundred: at a hundredth from the edges.
      const double error = 100.0 * (1e-15 / each.width + 1e-15);
      EXPECT_NEAR(back->s, at.s, error);
      EXPECT_NEAR(back->t, at.t, error);
    }
  }
}

/// Solid angle per area of the square, by central differences.
double jacobian(const UniformChart& chart, SquarePoint at, double step) {
  const auto along = [&](double s, double t) {
    return (chart.direction_from_square({at.s + s, at.t + t}) -
            chart.direction_from_square({at.s - s, at.t - t})) /
           (2.0 * step);
  };
  return glm::length(glm::cross(along(step, 0.0), along(0.0, step)));
}

TEST(UniformChart, HasThePdfThatItsOwnDerivativesGive) {
  constexpr double kStep = 1e-5;
  for (const NamedChart& each : charts()) {
    SCOPED_TRACE(each.name);
    for (const SquarePoint at : points()) {
      const Direction d = each.chart.direction_from_square(at);
      const double pdf = each.chart.pdf(d).value;
      // At a hundredth from the edges, third derivatives are some 1e4 times the first, and so is
      // the error of differences 1e4 step^2/6 relatively: 1e-6. Roundings of 1e-16 are divided by
      // the lobe's width and by the step.
      const double error = 1e-5 + 1e-15 / each.width / kStep;
      EXPECT_NEAR(jacobian(each.chart, at, kStep) * pdf, 1.0, error) << at.s << ", " << at.t;
    }
  }
}

TEST(UniformChart, TellsDirectionsThatCannotBeDrawn) {
  const Direction view = view_at(80.0);
  const auto expect_impossible = [](const UniformChart& chart, Direction d) {
    EXPECT_FALSE(chart.square_from_direction(d).has_value());
    EXPECT_EQ(chart.pdf(d).value, 0.0);
  };
  expect_impossible(cosine_lobe_chart({0.6, 0.0, 0.8}, 1.0), {-0.8, 0.0, -0.6});
  // Farther below the surface than the view is above: no normal above it is halfway.
  const Direction deep = {0.6, 0.0, -0.8};
  EXPECT_TRUE(mirrored_at_normals({Kind::ggx, 0.5}, view).square_from_direction(deep).has_value());
  expect_impossible(mirrored_at_visible_normals(0.5, view), deep);
  expect_impossible(mirrored_at_bounded_normals(0.5, view), deep);
  // Below the surface, where visible normals reflect light to, and bounded ones do not.
  const Direction below = glm::normalize(Direction(0.6, 0.8, -0.1));
  EXPECT_TRUE(mirrored_at_visible_normals(0.5, view).square_from_direction(below).has_value());
  expect_impossible(mirrored_at_bounded_normals(0.5, view), below);
}

// The light opposite to the view has no normal of its own.
TEST(UniformChart, PlacesTheDirectionOppositeToTheView) {
  for (const double degrees : {0.0, 45.0, 89.9}) {
    const Direction view = view_at(degrees);
    EXPECT_TRUE(mirrored_at_normals({Kind::ggx, 0.5}, view).square_from_direction(-view));
    EXPECT_TRUE(mirrored_at_visible_normals(0.5, view).square_from_direction(-view));
    EXPECT_GT(mirrored_at_visible_normals(0.5, view).pdf(-view).value, 0.0);
  }
}

// What the bounded cap leaves out lies below the surface, and its edge touches the surface.
TEST(UniformChart, OfBoundedNormalsHoldsAllDirectionsAboveTheSurface) {
  for (const double alpha : {0.01, 0.3, 1.0}) {
    for (const double degrees : {0.0, 45.0, 80.0, 89.9}) {
      const Direction view = view_at(degrees);
      const UniformChart chart = mirrored_at_bounded_normals(alpha, view);
      double farthest = 0.0;
      for (int i = 0; i < 10000; ++i) {
        const double phi = 2.0 * kPi * i / 10000.0;
        for (const double height : {0.0, 1e-3, 0.1, 0.9}) {
          const double sine = std::sqrt(1.0 - height * height);
          const auto at =
              chart.square_from_direction({sine * std::cos(phi), sine * std::sin(phi), height});
          ASSERT_TRUE(at.has_value()) << alpha << ", " << degrees << ", " << phi << ", " << height;
          farthest = std::max(farthest, at->t);
        }
      }
      // Of 1e4 azimuths one is within 3e-4 of the view's.
      EXPECT_GT(farthest, 1.0 - 1e-4) << alpha << ", " << degrees;
    }
  }
}

// Seen from the normal, tan^2 is alpha^2 t/(1-t): beyond half a right angle lie
// alpha^2/(1+alpha^2).
TEST(UniformChart, OfNormalsPutsTheShareBelowTheHorizonWhereItBelongs) {
  for (const double alpha : {0.01, 0.25, 0.5, 1.0}) {
    const UniformChart chart = mirrored_at_normals({Kind::ggx, alpha}, {0, 0, 1});
    const auto horizon = chart.square_from_direction({1, 0, 0});
    EXPECT_NEAR(1.0 - horizon->t, alpha * alpha / (1.0 + alpha * alpha), 1e-15);
  }
}

}  // namespace
}  // namespace lightproof::reference
