#include "reference/uniform_chart.h"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

namespace lightproof::reference {
namespace {

/// How far beyond the edge rounding may put a direction.
constexpr double kSlack = 1e-6;

SquarePoint clamped(SquarePoint at) {
  constexpr double kBelowOne = 1.0 - 0x1p-53;
  return {std::clamp(at.s, 0.0, kBelowOne), std::clamp(at.t, 0.0, kBelowOne)};
}

std::optional<SquarePoint> inside(SquarePoint at) {
  const auto is_near = [](double x) { return x >= -kSlack && x <= 1.0 + kSlack; };
  if (!is_near(at.s) || !is_near(at.t)) return std::nullopt;  // takes what is not a number
  return clamped(at);
}

/// The azimuth of (x, y) as a share of the circle, in [0,1].
double turns(double x, double y) {
  const double share = std::atan2(y, x) / (2.0 * kPi);
  return share < 0.0 ? share + 1.0 : share;
}

Direction at_angles(double sine, double cosine, double turn) {
  return {sine * std::cos(2.0 * kPi * turn), sine * std::sin(2.0 * kPi * turn), cosine};
}

Direction mirrored(Direction view, Direction normal) {
  return 2.0 * glm::dot(view, normal) * normal - view;
}

/// The normal between view and light, on the side of both. If they are opposite every normal across
/// the view is: the steepest.
Direction normal_between(Direction view, Direction light) {
  const Direction sum = view + light;
  if (glm::length(sum) > 0.0) return glm::normalize(sum);
  const Direction steepest = Direction(0, 0, 1) - view.z * view;
  return glm::length(steepest) > 0.0 ? glm::normalize(steepest) : Direction(1, 0, 0);
}

/// Solid angle of light directions per solid angle of the normals that mirror the view to them,
/// 4 |v.h|. By the length of the sum, since their product cancels where they are nearly opposite;
/// of opposite ones what a rounding leaves of it, so that densities stay finite.
double light_per_normal(Direction view, Direction light) {
  return 2.0 * std::max(0x1p-53, glm::length(view + light));
}

/// Two unit vectors across `axis` and each other, by Gram and Schmidt.
struct Axes {
  Direction x;
  Direction y;

  explicit Axes(Direction axis) {
    const Direction aside = std::abs(axis.z) < 0.6 ? Direction(0, 0, 1) : Direction(1, 0, 0);
    x = glm::normalize(aside - glm::dot(aside, axis) * axis);
    y = glm::cross(axis, x);
  }
};

// The distributions of normals, in tan(theta) or cos(theta).

/// P(the angle to the surface's normal is at most that of h).
double cumulative(const NormalDistribution& distribution, Direction h) {
  const double square = h.x * h.x + h.y * h.y;
  if (distribution.kind == NormalDistribution::Kind::ggx) {
    const double a = distribution.parameter;
    return square / (square + a * a * h.z * h.z);
  }
  const double log_cosine = square < 0.5 ? 0.5 * std::log1p(-square) : std::log(h.z);
  return -std::expm1((distribution.parameter + 2.0) * log_cosine);
}

Direction normal_at(const NormalDistribution& distribution, SquarePoint at) {
  if (distribution.kind == NormalDistribution::Kind::ggx) {
    const double theta = std::atan(distribution.parameter * std::sqrt(at.t / (1.0 - at.t)));
    return at_angles(std::sin(theta), std::cos(theta), at.s);
  }
  const double log_cosine = std::log1p(-at.t) / (distribution.parameter + 2.0);
  return at_angles(std::sqrt(-std::expm1(2.0 * log_cosine)), std::exp(log_cosine), at.s);
}

/// D(h) (n.h), per steradian.
double density_of_normal(const NormalDistribution& distribution, Direction h) {
  const double square = h.x * h.x + h.y * h.y;
  if (distribution.kind == NormalDistribution::Kind::ggx) {
    const double a2 = distribution.parameter * distribution.parameter;
    const double tangent2 = square / (h.z * h.z);
    const double d = a2 + tangent2;
    return a2 / (kPi * h.z * h.z * h.z * d * d);
  }
  const double n = distribution.parameter + 1.0;
  const double log_cosine = square < 0.5 ? 0.5 * std::log1p(-square) : std::log(h.z);
  return (n + 1.0) / (2.0 * kPi) * std::exp(n * log_cosine);
}

// GGX as a hemisphere of normals that is squeezed.

/// The view, and GGX's normals, as the hemisphere of normals has them: vectors of the surface are
/// scaled by alpha, normals by its inverse.
struct Hemisphere {
  double alpha;
  Direction scaled_view;
  Direction view;  ///< on the hemisphere

  Hemisphere(double a, Direction v)
      : alpha(a), scaled_view(a * v.x, a * v.y, v.z), view(glm::normalize(scaled_view)) {}

  Direction stretched(Direction h) const { return {h.x / alpha, h.y / alpha, h.z}; }
  Direction to(Direction h) const { return glm::normalize(stretched(h)); }
  Direction from(Direction m) const {
    return glm::normalize(Direction(alpha * m.x, alpha * m.y, m.z));
  }
  /// The density of light directions, given that of normals m on the hemisphere as a multiple of
  /// m.view. Solid angle on the hemisphere is that of normals h by 1/(alpha^2 length^3), the
  /// determinant of the stretching over the cube of the length; m.view is v.h by the lengths of
  /// both vectors; light is four times v.h of the normals, and v.h is gone.
  PerSteradian pdf_of_light(double per_cosine, Direction h) const {
    const double length2 = glm::dot(stretched(h), stretched(h));
    return {per_cosine / (4.0 * alpha * alpha * length2 * length2 * glm::length(scaled_view))};
  }
};

/// The part of a unit disc to the left of the abscissa sin(psi): the chord's length integrated.
double disc_to_the_left(double psi) { return 0.5 + (psi + 0.5 * std::sin(2.0 * psi)) / kPi; }

/// The angle psi of which disc_to_the_left(psi) is this share.
double angle_of_share(double share) {
  if (!(share > 0.0)) return -0.5 * kPi;
  if (share >= 1.0) return 0.5 * kPi;
  const auto adjacent = [](double a, double b) { return std::nextafter(a, b) >= b; };
  std::uintmax_t halvings = 64;
  const auto [low, high] =
      boost::math::tools::bisect([share](double psi) { return disc_to_the_left(psi) - share; },
                                 -0.5 * kPi, 0.5 * kPi, adjacent, halvings);
  return 0.5 * (low + high);
}

/// The hemisphere of normals projected along the view. Normals above the surface that face the view
/// fill the disc's half on the far side of the abscissae, and on the near side an ellipse whose
/// half axis is the view's cosine.
struct Projection {
  Hemisphere hemisphere;
  Direction x = {1.0, 0.0, 0.0};  ///< along the surface
  Direction y;

  Projection(double alpha, Direction v) : hemisphere(alpha, v) {
    const Direction along = glm::cross(Direction(0, 0, 1), hemisphere.view);
    if (glm::length(along) > 0.0) x = glm::normalize(along);
    y = glm::cross(hemisphere.view, x);
  }

  /// The point of the square for the normal m; none if it is below the surface.
  std::optional<SquarePoint> square(Direction m) const {
    const double abscissa = std::clamp(glm::dot(m, x), -1.0, 1.0);
    const double half_chord = std::sqrt((1.0 - abscissa) * (1.0 + abscissa));
    const double cosine = hemisphere.view.z;
    const double from_end = glm::dot(m, y) + cosine * half_chord;
    const double chord = (1.0 + cosine) * half_chord;
    if (!(from_end >= -kSlack && from_end <= chord + kSlack)) return std::nullopt;
    return clamped({chord > 0.0 ? from_end / chord : 0.0, disc_to_the_left(std::asin(abscissa))});
  }
  Direction normal(SquarePoint at) const {
    const double psi = angle_of_share(at.t);
    const double cosine = hemisphere.view.z;
    const double ordinate = std::cos(psi) * (at.s * (1.0 + cosine) - cosine);
    const double depth =
        std::sqrt(std::max(0.0, std::cos(psi) * std::cos(psi) - ordinate * ordinate));
    return std::sin(psi) * x + ordinate * y + depth * hemisphere.view;
  }
  /// The density over the projection is uniform: one over its area pi (1 + cosine) / 2, as a
  /// multiple of m.view.
  double per_cosine() const { return 2.0 / (kPi * (1.0 + hemisphere.view.z)); }
};

/// The height on the hemisphere of the light along the surface on the side of the view, at which
/// the cap of light directions ends: twice the angle of its normal less that of the view.
double lowest_height(double alpha, Direction view) {
  const double along = std::hypot(view.x, view.y);
  const double of_normal = std::atan2(1.0 + along, alpha * view.z);
  const double of_view = std::atan2(alpha * along, view.z);
  return std::cos(2.0 * of_normal - of_view);
}

}  // namespace

UniformChart cosine_lobe_chart(Direction axis, double exponent) {
  const Axes axes(axis);
  return {[=](Direction d) -> std::optional<SquarePoint> {
            const double cosine = glm::dot(d, axis);
            if (cosine < 0.0) return std::nullopt;
            const double x = glm::dot(d, axes.x);
            const double y = glm::dot(d, axes.y);
            // The cosine of a direction near the axis by its sine, which has more digits.
            const double log_cosine =
                cosine > 0.7 ? 0.5 * std::log1p(-(x * x + y * y)) : std::log(cosine);
            return inside({turns(x, y), -std::expm1((exponent + 1.0) * log_cosine)});
          },
          [=](SquarePoint at) {
            const double log_cosine = std::log1p(-at.t) / (exponent + 1.0);
            const Direction local =
                at_angles(std::sqrt(-std::expm1(2.0 * log_cosine)), std::exp(log_cosine), at.s);
            return local.x * axes.x + local.y * axes.y + local.z * axis;
          },
          [=](Direction d) {
            const double cosine = glm::dot(d, axis);
            if (cosine <= 0.0) return PerSteradian{0.0};
            return PerSteradian{(exponent + 1.0) / (2.0 * kPi) * std::pow(cosine, exponent)};
          }};
}

UniformChart henyey_greenstein_chart(double g) {
  // The square root that the cumulative distribution and the density share.
  const auto root = [g](double z) { return std::sqrt(1.0 + g * g - 2.0 * g * z); };
  return {[=](Direction d) -> std::optional<SquarePoint> {
            const double here = root(d.z);
            const double at_bottom = 1.0 + g;
            const double below =
                (1.0 - g * g) * (1.0 + d.z) / (here * at_bottom * (here + at_bottom));
            return inside({turns(d.x, d.y), below});
          },
          [=](SquarePoint at) {
            const double u = at.t;
            const double w = 1.0 - g + 2.0 * g * u;
            const double z =
                (2.0 * u * (1.0 + g * g) * (1.0 - g + g * u) - (1.0 - g) * (1.0 - g)) / (w * w);
            return at_angles(std::sqrt(std::max(0.0, (1.0 - z) * (1.0 + z))), z, at.s);
          },
          [=](Direction d) {
            const double here = root(d.z);
            return PerSteradian{(1.0 - g * g) / (4.0 * kPi * here * here * here)};
          }};
}

UniformChart mirrored_at_normals(NormalDistribution distribution, Direction view) {
  const auto upper_normal = [view](Direction light) {
    const Direction normal = normal_between(view, light);
    return normal.z < 0.0 ? -normal : normal;
  };
  return {[=](Direction light) -> std::optional<SquarePoint> {
            const Direction h = upper_normal(light);
            return inside({turns(h.x, h.y), cumulative(distribution, h)});
          },
          [=](SquarePoint at) { return mirrored(view, normal_at(distribution, at)); },
          [=](Direction light) {
            const Direction h = upper_normal(light);
            if (h.z <= 0.0) return PerSteradian{0.0};
            return PerSteradian{density_of_normal(distribution, h) / light_per_normal(view, light)};
          }};
}

UniformChart mirrored_at_visible_normals(double alpha, Direction view) {
  const Projection projection(alpha, view);
  const Hemisphere& hemisphere = projection.hemisphere;
  const auto square = [=](Direction light) {
    return projection.square(hemisphere.to(normal_between(view, light)));
  };
  return {square,
          [=](SquarePoint at) { return mirrored(view, hemisphere.from(projection.normal(at))); },
          [=](Direction light) {
            if (!square(light)) return PerSteradian{0.0};
            return hemisphere.pdf_of_light(projection.per_cosine(), normal_between(view, light));
          }};
}

UniformChart mirrored_at_bounded_normals(double alpha, Direction view) {
  const Hemisphere hemisphere(alpha, view);
  const double lowest = lowest_height(alpha, view);
  const auto square = [=](Direction light) {
    const Direction on_cap = mirrored(hemisphere.view, hemisphere.to(normal_between(view, light)));
    return inside({turns(on_cap.x, on_cap.y), (1.0 - on_cap.z) / (1.0 - lowest)});
  };
  return {square,
          [=](SquarePoint at) {
            const double height = 1.0 - at.t * (1.0 - lowest);
            const double sine = std::sqrt(std::max(0.0, 1.0 - height * height));
            const Direction m = glm::normalize(hemisphere.view + at_angles(sine, height, at.s));
            return mirrored(view, hemisphere.from(m));
          },
          [=](Direction light) {
            if (!square(light)) return PerSteradian{0.0};
            // The density is uniform on the cap, which has four times m.view of the solid angle of
            // its normals.
            const double per_cosine = 4.0 / (2.0 * kPi * (1.0 - lowest));
            return hemisphere.pdf_of_light(per_cosine, normal_between(view, light));
          }};
}

}  // namespace lightproof::reference
