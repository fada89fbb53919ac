// Four ways to draw GGX's microfacet normals, in local directions: z along the surface's normal,
// the view above it. Reflected at the normal, each gives a light direction, which may lie below the
// surface: all four densities integrate to one over the whole sphere.
//
//   normals            the distribution itself, whatever the view (Walter et al. 2007, eq. 35 and
//   36) visible_normals    what the view sees of it, by projecting a hemisphere (Heitz 2018)
//   spherical_caps     the same distribution, by a spherical cap (Dupuy & Benyoub 2023)
//   bounded_caps       a smaller cap that leaves out most of what reflects below the surface
//                      (Tokuyoshi & Eto 2023): the least variance
#pragma once

#include <algorithm>
#include <cmath>

#include "lightproof/materials/ggx.h"
#include "lightproof/materials/half_vector.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {

enum class MicrofacetSampling { normals, visible_normals, spherical_caps, bounded_caps };

/// Density D(h) (n.h). By the inverse of its distribution function in the height: u.t = 0 gives the
/// surface's normal.
inline Direction ggx_normal_from_square(double alpha, SquarePoint u) {
  const double left = 1.0 - u.t;
  // 1 + (alpha^2 - 1) u.t, which would cancel where u.t is near 1.
  const double whole = left + alpha * alpha * u.t;
  const double sine = alpha * std::sqrt(u.t / whole);
  const double phi = 2.0 * kPi * u.s;
  return {sine * std::cos(phi), sine * std::sin(phi), std::sqrt(left / whole)};
}
inline PerSteradian ggx_normal_pdf(double alpha, Direction h) {
  return {ggx_normal_distribution(alpha, h) * std::max(0.0, h.z)};
}

/// A direction as the surface sees it that is a hemisphere of microfacets: its part along the
/// surface scaled by alpha.
inline Direction to_hemisphere_of_normals(double alpha, Direction d) {
  return glm::normalize(Direction(alpha * d.x, alpha * d.y, d.z));
}
/// A normal of that hemisphere as one of GGX's; of any length.
inline Direction from_hemisphere_of_normals(double alpha, Direction h) {
  return glm::normalize(Direction(alpha * h.x, alpha * h.y, h.z));
}

/// A unit vector along the surface and across a direction.
inline Direction across(Direction d) {
  const double length = std::hypot(d.x, d.y);
  return length > 0.0 ? Direction(-d.y / length, d.x / length, 0.0) : Direction(1.0, 0.0, 0.0);
}

/// Density of visible normals, G1(v) (v.h)+ D(h) / (n.v). The hemisphere of normals, projected
/// along the view, is half a disc and half an ellipse, where visible normals are uniform: a disc is
/// squeezed into them (Heitz 2018, "Sampling the GGX Distribution of Visible Normals").
inline Direction ggx_visible_normal_from_square(double alpha, Direction view, SquarePoint u) {
  const Direction v = to_hemisphere_of_normals(alpha, view);
  const Direction x = across(v);
  const Direction y = glm::cross(v, x);
  const double radius = std::sqrt(u.t);
  const double phi = 2.0 * kPi * u.s;
  const double along_x = radius * std::cos(phi);
  const double in_disc = radius * std::sin(phi);
  // All distances from the rim by 1 - u.t, which is not 0 there: no normal is across the view.
  const double left = 1.0 - u.t;
  const double half_chord = std::sqrt(left + in_disc * in_disc);
  const double above = in_disc > 0.0 ? left / (half_chord + in_disc) : half_chord - in_disc;
  const double below = in_disc < 0.0 ? left / (half_chord - in_disc) : half_chord + in_disc;
  const double share = 0.5 * (1.0 + v.z);
  const double along_y = (1.0 - share) * half_chord + share * in_disc;
  // The root of half_chord^2 - along_y^2
  const double height =
      std::sqrt(share * above * (2.0 * (1.0 - share) * half_chord + share * below));
  const Direction h = along_x * x + along_y * y + height * v;
  return from_hemisphere_of_normals(alpha, {h.x, h.y, std::max(0.0, h.z)});
}
inline PerSteradian ggx_visible_normal_pdf(double alpha, Direction view, Direction h) {
  const double cosine = std::max(0.0, glm::dot(view, h));
  return {smith_masking(alpha, view.z) * cosine * ggx_normal_distribution(alpha, h) / view.z};
}

/// A normal of the hemisphere: the one that reflects `v`, which is of that hemisphere, to a
/// direction uniform over the cap of the sphere above the height -depth.
inline Direction normal_from_cap(Direction v, double depth, SquarePoint u) {
  const double phi = 2.0 * kPi * u.s;
  const double from_edge = (1.0 - u.t) * (1.0 + depth);
  const double z = from_edge - depth;
  const double sine = std::sqrt(std::max(0.0, (1.0 - z) * (1.0 + z)));
  // The height is the sum of two that cancel where the cap is that of all visible normals.
  const Direction h = {v.x + sine * std::cos(phi), v.y + sine * std::sin(phi),
                       from_edge + (v.z - depth)};
  // Opposite to the view but for roundings, once in 1e16 samples: a normal all but across the view.
  if (glm::dot(h, h) < 1e-16) return across(v) + 1e-7 * v;
  return h;
}

/// Density as ggx_visible_normal_pdf. On the hemisphere of normals a visible normal reflects the
/// view uniformly into the cap above the height -v.z (Dupuy & Benyoub 2023, "Sampling Visible GGX
/// Normals with Spherical Caps").
inline Direction ggx_visible_normal_from_cap(double alpha, Direction view, SquarePoint u) {
  const Direction v = to_hemisphere_of_normals(alpha, view);
  return from_hemisphere_of_normals(alpha, normal_from_cap(v, v.z, u));
}

/// k in [0,1]: on the hemisphere of normals no light direction above the surface lies below the
/// height -k v.z (Tokuyoshi & Eto 2023, "Bounded VNDF Sampling for Smith-GGX Reflections", eq. 5).
/// The lowest one is that along the surface on the side of the view.
inline double cap_bound(double alpha, Direction view) {
  const double a2 = alpha * alpha;
  const double s = 1.0 + std::hypot(view.x, view.y);
  return (1.0 - a2) * s * s / (s * s + a2 * view.z * view.z);
}

/// Uniform over the cap above -k v.z.
inline Direction ggx_bounded_normal_from_cap(double alpha, Direction view, SquarePoint u) {
  const Direction v = to_hemisphere_of_normals(alpha, view);
  return from_hemisphere_of_normals(alpha, normal_from_cap(v, cap_bound(alpha, view) * v.z, u));
}

inline Direction ggx_normal_from_square(MicrofacetSampling sampling, double alpha, Direction view,
                                        SquarePoint u) {
  switch (sampling) {
    case MicrofacetSampling::normals:
      return ggx_normal_from_square(alpha, u);
    case MicrofacetSampling::visible_normals:
      return ggx_visible_normal_from_square(alpha, view, u);
    case MicrofacetSampling::spherical_caps:
      return ggx_visible_normal_from_cap(alpha, view, u);
    case MicrofacetSampling::bounded_caps:
      return ggx_bounded_normal_from_cap(alpha, view, u);
  }
  return {};
}

/// Whether the bounded cap holds the direction that the view is reflected to. One that is outside
/// by the roundings of its half vector, stretched by 1/alpha, counts as inside: it may have been
/// drawn.
inline bool is_in_bounded_cap(double alpha, Direction view, const HalfVector& half) {
  const double rounding = 0x1p-50 / (alpha * half.cosine);
  const Direction v = to_hemisphere_of_normals(alpha, view);
  const Direction h = half.normal;
  const Direction m = glm::normalize(Direction(h.x / alpha, h.y / alpha, h.z));
  const double height = 2.0 * glm::dot(v, m) * m.z - v.z;
  return height >= -cap_bound(alpha, view) * v.z - rounding;
}

/// The density over light directions with which this way of sampling draws the one whose half
/// vector is given, above the surface or below.
inline PerSteradian ggx_reflected_pdf(MicrofacetSampling sampling, double alpha, Direction view,
                                      const HalfVector& half) {
  const Direction h = half.normal;
  const double length = smith_stretched_length(alpha, view.z);
  switch (sampling) {
    case MicrofacetSampling::normals: {
      // Reflecting at h and at -h is the same; only one of them is above the surface.
      const Direction upper = h.z < 0.0 ? -h : h;
      return reflected_density(ggx_normal_pdf(alpha, upper), half.cosine);
    }
    case MicrofacetSampling::visible_normals:
    case MicrofacetSampling::spherical_caps:
      return {0.5 * ggx_normal_distribution(alpha, h) / (view.z + length)};
    case MicrofacetSampling::bounded_caps: {
      const double bound = cap_bound(alpha, view);
      const bool may_be_outside = 2.0 * half.cosine * h.z < view.z;  // below the surface
      if (may_be_outside && !is_in_bounded_cap(alpha, view, half)) return {0.0};
      return {0.5 * ggx_normal_distribution(alpha, h) / (bound * view.z + length)};
    }
  }
  return {0.0};
}

/// f_r (n.l) / pdf without the Fresnel factor, of a light direction above the surface, in the
/// closed forms in which nothing of the lobe's height is left: `half` is its half vector.
inline double ggx_weight(MicrofacetSampling sampling, SmithMasking masking, double alpha,
                         Direction view, Direction light, const HalfVector& half) {
  const double g2 = smith_masking_shadowing(masking, alpha, view.z, light.z);
  const double length = smith_stretched_length(alpha, view.z);
  switch (sampling) {
    case MicrofacetSampling::normals:
      return g2 * half.cosine / (view.z * half.normal.z);
    case MicrofacetSampling::visible_normals:
    case MicrofacetSampling::spherical_caps:
      return g2 * (view.z + length) / (2.0 * view.z);
    case MicrofacetSampling::bounded_caps:
      return g2 * (cap_bound(alpha, view) * view.z + length) / (2.0 * view.z);
  }
  return 0.0;
}

}  // namespace lightproof
