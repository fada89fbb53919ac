// Every way to draw a rough mirror, at every roughness and angle: densities that integrate to one,
// weights that are f cos / pdf, and the light that the model reflects.
#include "lightproof/materials/microfacet.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "reference/microfacet_reflectance.h"

namespace lightproof {
namespace {

constexpr double kRoughnesses[] = {0.01, 0.1, 0.25, 0.3, 0.5, 0.6, 0.75, 1.0};
constexpr double kDegrees[] = {0.0, 45.0, 80.0, 89.9};
constexpr MicrofacetSampling kSamplings[] = {
    MicrofacetSampling::normals, MicrofacetSampling::visible_normals,
    MicrofacetSampling::spherical_caps, MicrofacetSampling::bounded_caps};
constexpr SmithMasking kMaskings[] = {SmithMasking::karis, SmithMasking::separable,
                                      SmithMasking::height_correlated};

ShadingPoint seen_at(double degrees) {
  const double angle = degrees * kPi / 180.0;
  return {{}, frame_around({0, 0, 1}), {std::sin(angle), 0.0, std::cos(angle)}};
}

template <class Visit>
void for_each_view(const Visit& visit) {
  for (const double roughness : kRoughnesses) {
    for (const double degrees : kDegrees) {
      SCOPED_TRACE(fmt::format("roughness {} at {} degrees", roughness, degrees));
      visit(roughness, seen_at(degrees));
    }
  }
}

/// The plane's R2 sequence.
SquarePoint point(int i) {
  return {std::fmod(i * 0.75487766624669276, 1.0), std::fmod(i * 0.56984029099805327, 1.0)};
}

/// ∫ pdf over all directions of the sphere, by those normals above the surface that mirror the view
/// to them, in which the Jacobian 4 |v.h| makes all densities finite: at points of the azimuth and
/// of beta, tan(theta) = alpha tan(beta), in which the lobe is equally wide for every roughness.
template <class Material>
double integral_of_pdf(const Material& material, double alpha, const ShadingPoint& at) {
  constexpr int kPoints = 1 << 17;
  double sum = 0.0;
  for (int i = 1; i <= kPoints; ++i) {
    const double beta = 0.5 * kPi * point(i).t;
    const double phi = 2.0 * kPi * point(i).s;
    const double theta = std::atan(alpha * std::tan(beta));
    const double slope =
        alpha / (std::pow(std::cos(beta), 2) + std::pow(alpha * std::sin(beta), 2));
    const Direction h = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta)};
    sum += material.evaluate(at, reflect_about(at.view, h)).pdf.value * 4.0 *
           std::abs(glm::dot(at.view, h)) * std::sin(theta) * slope;
  }
  return sum * 0.5 * kPi * 2.0 * kPi / kPoints;
}

/// Bounded normals end with a step along a curve: N points that fill a plane evenly know the area
/// on either side to some N^(-3/4), 1.4e-4 here, times the height of the step, up to 3 in units of
/// the mean. All other densities are at least continuous.
constexpr double kIntegralError = 5e-4;

TEST(Ggx, HasPdfsThatIntegrateToOneOverTheSphere) {
  for_each_view([](double roughness, const ShadingPoint& at) {
    for (const MicrofacetSampling sampling : kSamplings) {
      const Ggx material = {roughness, 1.0, SmithMasking::height_correlated, sampling};
      EXPECT_NEAR(integral_of_pdf(material, ggx_alpha(roughness), at), 1.0, kIntegralError)
          << static_cast<int>(sampling);
    }
  });
}

TEST(BlinnMicrofacet, HasAPdfThatIntegratesToOneOverTheSphere) {
  for_each_view([](double roughness, const ShadingPoint& at) {
    const BlinnMicrofacet material = {roughness, 1.0};
    EXPECT_NEAR(integral_of_pdf(material, ggx_alpha(roughness), at), 1.0, kIntegralError);
  });
}

template <class Material>
void expect_scattering_of_its_own_direction(const Material& material, const ShadingPoint& at,
                                            SquarePoint u) {
  const DirectionSample drawn = material.sample(at, u);
  EXPECT_NEAR(glm::length(drawn.direction), 1.0, 1e-14);
  ASSERT_GT(drawn.scattering.pdf.value, 0.0);
  ASSERT_TRUE(std::isfinite(drawn.scattering.pdf.value));
  const Scattering again = material.evaluate(at, drawn.direction);
  EXPECT_NEAR(again.pdf.value / drawn.scattering.pdf.value, 1.0, 1e-6);
}

TEST(Ggx, ReturnsTheDensityOfTheDirectionDrawn) {
  for_each_view([](double roughness, const ShadingPoint& at) {
    for (const MicrofacetSampling sampling : kSamplings) {
      const Ggx material = {roughness, 1.0, SmithMasking::height_correlated, sampling};
      for (int i = 1; i <= 500; ++i) expect_scattering_of_its_own_direction(material, at, point(i));
    }
    for (int i = 1; i <= 500; ++i) {
      expect_scattering_of_its_own_direction(BlinnMicrofacet{roughness, 1.0}, at, point(i));
    }
  });
}

// One density over normals, the other over the directions that they reflect the view to.
TEST(GgxNormals, HaveThePdfOfTheirReflectedDirections) {
  for_each_view([](double roughness, const ShadingPoint& at) {
    const double alpha = ggx_alpha(roughness);
    for (int i = 1; i <= 100; ++i) {
      const Direction h = ggx_visible_normal_from_square(alpha, at.view, point(i));
      const HalfVector half = half_vector(at.view, reflect_about(at.view, h));
      const auto pdf = [&](MicrofacetSampling sampling) {
        return ggx_reflected_pdf(sampling, alpha, at.view, half).value;
      };
      const PerSteradian visible = ggx_visible_normal_pdf(alpha, at.view, h);
      const PerSteradian all = ggx_normal_pdf(alpha, h);
      EXPECT_NEAR(
          reflected_density(visible, half.cosine).value / pdf(MicrofacetSampling::visible_normals),
          1.0, 1e-6);
      EXPECT_NEAR(reflected_density(all, half.cosine).value / pdf(MicrofacetSampling::normals), 1.0,
                  1e-6);
    }
  });
}

// The closed forms, in which D has been divided out, against the quotient.
TEST(GgxWeight, IsReflectedCosineOverPdf) {
  for_each_view([](double roughness, const ShadingPoint& at) {
    const double alpha = ggx_alpha(roughness);
    for (const MicrofacetSampling sampling : kSamplings) {
      for (const SmithMasking masking : kMaskings) {
        const Ggx material = {roughness, 0.04, masking, sampling};
        for (int i = 1; i <= 100; ++i) {
          const auto [light, scattering] = material.sample(at, point(i));
          if (!(light.z > 1e-9)) {
            if (light.z <= 0.0) {
              EXPECT_EQ(scattering.reflected_cosine, 0.0);
            }
            continue;
          }
          const HalfVector half = half_vector(at.view, light);
          const double weight = schlick_fresnel(0.04, half.cosine) *
                                ggx_weight(sampling, masking, alpha, at.view, light, half);
          EXPECT_NEAR(scattering.reflected_cosine / scattering.pdf.value / weight, 1.0, 1e-9);
        }
      }
    }
  });
}

// D has gone from the quotient, and with it the lobe: F G (v.h) / ((n.v)(n.h)).
TEST(BlinnMicrofacet, WeighsByMaskingAndCosines) {
  for_each_view([](double roughness, const ShadingPoint& at) {
    const BlinnMicrofacet material = {roughness, 0.04};
    for (int i = 1; i <= 200; ++i) {
      const auto [light, scattering] = material.sample(at, point(i));
      if (!(light.z > 1e-9)) continue;
      const auto [h, cosine] = half_vector(at.view, light);
      const double groove = 2.0 * h.z * std::min(at.view.z, light.z) / cosine;
      const double weight =
          schlick_fresnel(0.04, cosine) * std::min(1.0, groove) * cosine / (at.view.z * h.z);
      EXPECT_NEAR(scattering.reflected_cosine / scattering.pdf.value / weight, 1.0, 1e-9);
    }
  });
}

/// The mean of reflected cosine over pdf, over the whole square. Normals drawn without the view
/// have their large weights where u.t is near 1: the points go there more often, and weigh less.
template <class Material>
double mean_weight(const Material& material, const ShadingPoint& at, bool weighs_steep_normals) {
  constexpr int kPoints = 1 << 15;
  double sum = 0.0;
  for (int i = 1; i <= kPoints; ++i) {
    SquarePoint u = point(i);
    const double left = 1.0 - u.t;
    double slope = 1.0;
    if (weighs_steep_normals) {
      u.t = 1.0 - left * left * left * left;
      slope = 4.0 * left * left * left;
    }
    const Scattering scattering = material.sample(at, u).scattering;
    if (scattering.reflected_cosine > 0.0) {
      sum += slope * scattering.reflected_cosine / scattering.pdf.value;
    }
  }
  return sum / kPoints;
}

/// What is asked of a white furnace. The points alone leave 2e-4.
constexpr double kFurnace = 1e-3;

reference::Masking as_reference(SmithMasking masking) {
  switch (masking) {
    case SmithMasking::karis:
      return reference::Masking::smith_karis;
    case SmithMasking::separable:
      return reference::Masking::smith_separable;
    case SmithMasking::height_correlated:
      break;
  }
  return reference::Masking::smith_height_correlated;
}

TEST(Ggx, ReflectsInAWhiteFurnaceWhatItsModelDoes) {
  for_each_view([](double roughness, const ShadingPoint& at) {
    for (const SmithMasking masking : kMaskings) {
      const reference::RoughMirror model = {
          {reference::NormalDistribution::Kind::ggx, ggx_alpha(roughness)}, as_reference(masking)};
      const double exact = reference::split_sum(model, at.view.z).white();
      for (const MicrofacetSampling sampling : kSamplings) {
        const Ggx material = {roughness, 1.0, masking, sampling};
        EXPECT_NEAR(mean_weight(material, at, sampling == MicrofacetSampling::normals), exact,
                    kFurnace)
            << static_cast<int>(sampling) << ", " << static_cast<int>(masking);
      }
    }
  });
}

TEST(Ggx, ReflectsWithFresnelWhatItsModelDoes) {
  for_each_view([](double roughness, const ShadingPoint& at) {
    const reference::RoughMirror model = {
        {reference::NormalDistribution::Kind::ggx, ggx_alpha(roughness)},
        reference::Masking::smith_height_correlated};
    EXPECT_NEAR(mean_weight(Ggx{roughness, 0.04}, at, false),
                reference::split_sum(model, at.view.z).of(0.04), kFurnace);
  });
}

TEST(BlinnMicrofacet, ReflectsInAWhiteFurnaceWhatItsModelDoes) {
  for_each_view([](double roughness, const ShadingPoint& at) {
    const reference::RoughMirror model = {
        {reference::NormalDistribution::Kind::blinn, blinn_shininess(roughness)},
        reference::Masking::v_grooves};
    EXPECT_NEAR(mean_weight(BlinnMicrofacet{roughness, 1.0}, at, true),
                reference::split_sum(model, at.view.z).white(), kFurnace);
  });
}

// One less the logarithm of two, seen from the normal of the roughest surface.
TEST(Ggx, LosesTwoThirdsOfTheLightAtRoughnessOne) {
  for (const SmithMasking masking : kMaskings) {
    EXPECT_NEAR(mean_weight(Ggx{1.0, 1.0, masking}, seen_at(0.0), false), 1.0 - std::log(2.0),
                kFurnace);
  }
}

// Of light mirrored at normals drawn without the view; seen from the normal, alpha^2/(1+alpha^2) go
// below the surface, beyond a normal of 45 degrees: u.t = 1/(1+alpha^2) is the edge.
TEST(GgxNormals, ReflectBelowTheSurfaceFromTheirEdgeOn) {
  for (const double roughness : kRoughnesses) {
    const double alpha = ggx_alpha(roughness);
    const double edge = 1.0 / (1.0 + alpha * alpha);
    const auto height = [&](double t) {
      return reflect_about({0, 0, 1}, ggx_normal_from_square(alpha, {0.3, t})).z;
    };
    EXPECT_GT(height(edge * (1.0 - 1e-9)), 0.0);
    EXPECT_LT(height(edge + 1e-9 * (1.0 - edge)), 0.0);
  }
}

// omega = (2 theta, phi) in the frame of the view along the normal.
TEST(GgxNormals, ReflectToTwiceTheirAngle) {
  for (const double t : {0.1, 0.6, 0.9}) {
    const Direction h = ggx_normal_from_square(0.3, {0.2, t});
    const double theta = std::acos(std::sqrt((1.0 - t) / (1.0 + (0.09 - 1.0) * t)));
    EXPECT_NEAR(std::acos(h.z), theta, 1e-14);
    const Direction light = reflect_about({0, 0, 1}, h);
    EXPECT_NEAR(std::acos(light.z), 2.0 * theta, 1e-14);
    EXPECT_NEAR(std::atan2(light.y, light.x), 0.4 * kPi, 1e-14);
  }
}

// Seen from the normal, the cap may end at the height of light along the surface, whose normal
// leans by 45 degrees: -(1 - alpha^2)/(1 + alpha^2). At roughness 1 it is half the sphere, whatever
// the view: no sample is lost.
TEST(CapBound, IsThatOfLightAlongTheSurface) {
  for (const double alpha : {1e-4, 0.3, 1.0}) {
    const double a2 = alpha * alpha;
    EXPECT_NEAR(cap_bound(alpha, {0, 0, 1}), (1.0 - a2) / (1.0 + a2), 1e-15);
  }
  for (const double degrees : kDegrees) EXPECT_EQ(cap_bound(1.0, seen_at(degrees).view), 0.0);
}

TEST(BoundedCaps, LoseNoSampleAtRoughnessOneAndFewerThanVisibleNormalsElsewhere) {
  constexpr int kPoints = 4096;
  for_each_view([](double roughness, const ShadingPoint& at) {
    const auto lost = [&](MicrofacetSampling sampling) {
      int below = 0;
      for (int i = 1; i <= kPoints; ++i) {
        const Ggx material = {roughness, 1.0, SmithMasking::height_correlated, sampling};
        below += material.sample(at, point(i)).direction.z <= 0.0 ? 1 : 0;
      }
      return below;
    };
    const int bounded = lost(MicrofacetSampling::bounded_caps);
    if (roughness == 1.0) {
      EXPECT_LE(bounded, 1);
    }  // the surface itself, by a rounding
    // Whose shares the points know to a few of them.
    EXPECT_LE(bounded, lost(MicrofacetSampling::visible_normals) + 20);
    EXPECT_LE(lost(MicrofacetSampling::visible_normals), lost(MicrofacetSampling::normals) + 20);
  });
}

TEST(HalfVector, IsHalfwayAndItsOwnMirror) {
  const Direction view = glm::normalize(Direction(0.3, -0.2, 0.8));
  const Direction light = glm::normalize(Direction(-0.7, 0.1, 0.2));
  const HalfVector half = half_vector(view, light);
  EXPECT_NEAR(glm::distance(reflect_about(view, half.normal), light), 0.0, 1e-15);
  EXPECT_NEAR(half.cosine, glm::dot(view, half.normal), 1e-15);
}

// Any normal across the view is halfway: a density is drawn there, however unlikely.
TEST(HalfVector, OfOppositeDirectionsIsAcrossAndUp) {
  for (const Direction view : {Direction(0, 0, 1), glm::normalize(Direction(0.3, -0.2, 0.8))}) {
    const HalfVector half = half_vector(view, -view);
    EXPECT_NEAR(glm::length(half.normal), 1.0, 1e-15);
    EXPECT_NEAR(glm::dot(half.normal, view), 0.0, 1e-15);
    EXPECT_GE(half.normal.z, 0.0);
    EXPECT_GT(half.cosine, 0.0);
    EXPECT_LT(half.cosine, 1e-16);
  }
}

TEST(Microfacets, ReflectNothingFromOppositeTheView) {
  const ShadingPoint at = seen_at(45.0);
  for (const MicrofacetSampling sampling : kSamplings) {
    const Scattering back = Ggx{0.3, 1.0, SmithMasking::karis, sampling}.evaluate(at, -at.view);
    EXPECT_EQ(back.reflected_cosine, 0.0);
    EXPECT_TRUE(back.pdf.value > 0.0 && std::isfinite(back.pdf.value));
  }
  const Scattering back = BlinnMicrofacet{0.3, 1.0}.evaluate(at, -at.view);
  EXPECT_EQ(back.reflected_cosine, 0.0);
  EXPECT_TRUE(back.pdf.value > 0.0 && std::isfinite(back.pdf.value));
}

}  // namespace
}  // namespace lightproof
