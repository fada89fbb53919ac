#include "lightproof/points/integrand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "lightproof/core/direction.h"
#include "lightproof/core/error.h"

namespace lightproof {
namespace {

constexpr double kE = std::numbers::e;

/// Unit vectors, 63.6 degrees apart.
constexpr Direction kNormal = {1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
constexpr Direction kBrightest = {-2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0};
constexpr double kCosine = 4.0 / 9.0;  ///< between the two

Direction equal_area_direction(SquarePoint at) {
  const double z = 2.0 * at.t - 1.0;
  const double sine = 2.0 * std::sqrt(at.t * (1.0 - at.t));
  return {sine * std::cos(2.0 * kPi * at.s), sine * std::sin(2.0 * kPi * at.s), z};
}

double received_cosine(Direction omega) { return std::max(0.0, glm::dot(kNormal, omega)); }

double exponential(SquarePoint at) { return std::exp(at.s + at.t); }

double quarter_disc(SquarePoint at) { return at.s * at.s + at.t * at.t < 1.0 ? 1.0 : 0.0; }

/// L = 1 + omega . d.
double gradient_map(SquarePoint at) {
  const Direction omega = equal_area_direction(at);
  return kSphere * (1.0 + glm::dot(kBrightest, omega)) * received_cosine(omega);
}

/// L = 1 where omega . d > 0, else 0.
double half_lit_map(SquarePoint at) {
  const Direction omega = equal_area_direction(at);
  return glm::dot(kBrightest, omega) > 0.0 ? kSphere * received_cosine(omega) : 0.0;
}

double square(double x) { return x * x; }

/// The integral over omega of (1 + omega . d)^2 (n . omega)+^2, d = c n + sqrt(1-c^2) e: with x =
/// n . omega the parts are 2 pi x^2, 2 c 2 pi x^3, c^2 2 pi x^4 and (1-c^2) pi x^2 (1-x^2) on
/// [0,1].
double gradient_second_moment(double c) {
  return kPi * (2.0 / 3.0 + c + 0.4 * c * c + 2.0 / 15.0 * (1.0 - c * c));
}

/// The integral of (n . omega)+^2 over the half of the sphere around d: over the lune of both
/// hemispheres, in polar coordinates around its edges, 4/3 times that of cos^2 over its angles.
double half_lit_second_moment(double c) {
  const double angle = std::acos(c);
  return 4.0 / 3.0 * (0.5 * (kPi - angle) + 0.25 * std::sin(2.0 * angle));
}

std::array<Integrand, 4> table() {
  const double gradient_mean = kPi + 2.0 * kPi / 3.0 * kCosine;
  const double half_lit_mean = 0.5 * kPi * (1.0 + kCosine);
  return {{{"exponential", "exp(s + t)", Roughness::smooth, square(kE - 1.0),
            square(0.5 * (kE * kE - 1.0)) - square(square(kE - 1.0)), exponential},
           {"quarter disc", "1 where s^2 + t^2 < 1, else 0", Roughness::edge, 0.25 * kPi,
            0.25 * kPi * (1.0 - 0.25 * kPi), quarter_disc},
           {"gradient map", "irradiance of L = 1 + omega . d", Roughness::kink, gradient_mean,
            kSphere * gradient_second_moment(kCosine) - square(gradient_mean), gradient_map},
           {"half-lit map", "irradiance of L = 1 on the half of the sphere around d",
            Roughness::edge, half_lit_mean,
            kSphere * half_lit_second_moment(kCosine) - square(half_lit_mean), half_lit_map}}};
}

}  // namespace

std::span<const Integrand> integrands() {
  static const std::array<Integrand, 4> all = table();
  return all;
}

const Integrand& integrand_by_name(std::string_view name) {
  std::string names;
  for (const Integrand& integrand : integrands()) {
    if (integrand.name == name) return integrand;
    names.append(names.empty() ? "" : ", ").append(integrand.name);
  }
  throw InputError("there is no integrand \"" + std::string(name) + "\": there are " + names);
}

}  // namespace lightproof
