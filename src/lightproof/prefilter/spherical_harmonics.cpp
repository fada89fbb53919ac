#include "lightproof/prefilter/spherical_harmonics.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cassert>
#include <cmath>
#include <glm/exponential.hpp>
#include <numbers>
#include <span>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/prefilter/legendre.h"

namespace lightproof {
namespace {

void check_degree(int degree) {
  if (degree >= 0 && degree <= kLargestHarmonicDegree) return;
  throw InputError(
      fmt::format("harmonics up to degree {}: 0 to {} needed", degree, kLargestHarmonicDegree));
}

/// The parts of a function of the longitude along cos(m phi) and sin(m phi), for m from 0.
struct FourierTerm {
  glm::dvec3 cosine = glm::dvec3(0.0);
  glm::dvec3 sine = glm::dvec3(0.0);
};

/// ∫ cos(m phi) and ∫ sin(m phi) over the columns of a map, for all m up to a degree.
class ColumnIntegrals {
 public:
  explicit ColumnIntegrals(int width) : width_(width) {
    // Middles of columns lie at odd multiples of pi/W, multiples of them by whole numbers modulo 2
    // W.
    for (int k = 0; k < 2 * width; ++k) {
      cosine_.push_back(std::cos(kPi * k / width));
      sine_.push_back(std::sin(kPi * k / width));
    }
  }

  FourierTerm of_row(std::span<const Rgb> row, int m) const {
    FourierTerm sum;
    const auto turn = static_cast<std::size_t>(2 * width_);
    const auto step = static_cast<std::size_t>(2 * m) % turn;
    auto angle = static_cast<std::size_t>(m) % turn;
    for (const Rgb texel : row) {
      sum.cosine += cosine_[angle] * glm::dvec3(texel);
      sum.sine += sine_[angle] * glm::dvec3(texel);
      angle += step;
      if (angle >= turn) angle -= turn;
    }
    // phi = pi - 2 pi s turns s around, and alternates with m.
    const double length = m == 0 ? 2.0 * kPi / width_ : 2.0 / m * std::sin(kPi * m / width_);
    const double sign = m % 2 == 0 ? 1.0 : -1.0;
    return {sign * length * sum.cosine, -sign * length * sum.sine};
  }

 private:
  int width_;
  std::vector<double> cosine_;
  std::vector<double> sine_;
};

/// ∫ P(l,m) sin d(theta) between two angles, at legendre_index(l, m). The integrand is made of
/// waves of up to l + 1 periods to the turn, so that its 20th derivative is at most (l + 1)^20 of
/// its largest value, and Gauss's rule of ten nodes is off by h 10!^4 / (21 20!^3) ((l + 1) h)^20
/// of that over a panel of width h: 7e-19 h for (l + 1) h = 4.
std::vector<double> latitude_integrals(const LegendreFunctions& legendre, double from, double to) {
  using Rule = boost::math::quadrature::gauss<double, 10>;
  const int panels = static_cast<int>(std::ceil((legendre.degree() + 1) * (to - from) / 4.0));
  const double half = 0.5 * (to - from) / panels;
  std::vector<double> values(legendre_count(legendre.degree()));
  std::vector<double> sums(values.size());
  const auto add = [&](double theta, double weight) {
    legendre.evaluate(std::sin(theta), std::cos(theta), values);
    const double factor = weight * half * std::sin(theta);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += factor * values[i];
  };
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = from + half * (2 * panel + 1);
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      add(middle - half * Rule::abscissa()[i], Rule::weights()[i]);
      add(middle + half * Rule::abscissa()[i], Rule::weights()[i]);
    }
  }
  return sums;
}

double norm(int m) { return m == 0 ? 1.0 : std::numbers::sqrt2; }

void add_row(const EnvironmentMap& map, const ColumnIntegrals& columns,
             const LegendreFunctions& legendre, int y, SphericalHarmonics& sum) {
  const int height = map.radiance.extent().height;
  const std::vector<double> latitude =
      latitude_integrals(legendre, kPi * (height - 1 - y) / height, kPi * (height - y) / height);
  for (int m = 0; m <= sum.degree; ++m) {
    const FourierTerm term = columns.of_row(map.radiance.row(y), m);
    for (int l = m; l <= sum.degree; ++l) {
      const double factor = norm(m) * latitude[legendre_index(l, m)];
      sum(l, m) += factor * term.cosine;
      if (m > 0) sum(l, -m) += factor * term.sine;
    }
  }
}

/// The function along a circle of latitude.
std::vector<FourierTerm> terms_of_latitude(const SphericalHarmonics& function,
                                           const LegendreFunctions& legendre, double t) {
  std::vector<double> values(legendre_count(function.degree));
  legendre.evaluate(sin_theta(t), cos_theta(t), values);
  std::vector<FourierTerm> terms(static_cast<std::size_t>(function.degree) + 1);
  for (int l = 0; l <= function.degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      const double factor = norm(m) * values[legendre_index(l, m)];
      FourierTerm& term = terms[static_cast<std::size_t>(m)];
      term.cosine += factor * function(l, m);
      if (m > 0) term.sine += factor * function(l, -m);
    }
  }
  return terms;
}

SphericalHarmonics zero(int degree) {
  return {degree, std::vector<glm::dvec3>(harmonic_count(degree), glm::dvec3(0.0))};
}

}  // namespace

std::vector<double> harmonics_at(Direction direction, int degree) {
  check_degree(degree);
  std::vector<double> legendre(legendre_count(degree));
  const double sine = std::hypot(direction.x, direction.y);
  LegendreFunctions(degree).evaluate(sine, direction.z, legendre);
  const double phi = std::atan2(direction.y, direction.x);
  std::vector<double> values(harmonic_count(degree));
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      const double factor = norm(m) * legendre[legendre_index(l, m)];
      values[harmonic_index(l, -m)] = factor * std::sin(m * phi);
      values[harmonic_index(l, m)] = factor * std::cos(m * phi);
    }
  }
  return values;
}

glm::dvec3 evaluate(const SphericalHarmonics& function, Direction direction) {
  const std::vector<double> values = harmonics_at(direction, function.degree);
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * function.coefficients[i];
  return sum;
}

SphericalHarmonics project(const EnvironmentMap& map, int degree) {
  check_degree(degree);
  require_lat_long(map, "a projection onto spherical harmonics");
  const auto [width, height] = map.radiance.extent();
  const ColumnIntegrals columns(width);
  const LegendreFunctions legendre(degree);
  // A fixed number of chunks: their sums show in the last bits.
  constexpr std::size_t kChunks = 16;
  const auto rows = static_cast<std::size_t>(height);
  const std::size_t size = chunks_of(rows, kChunks);
  std::vector<SphericalHarmonics> sums(chunks_of(rows, size), zero(degree));
  parallel_chunks(rows, size, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t y = first; y < last; ++y) {
      add_row(map, columns, legendre, static_cast<int>(y), sums[chunk]);
    }
  });
  SphericalHarmonics all = zero(degree);
  for (const SphericalHarmonics& sum : sums) {
    std::ranges::transform(all.coefficients, sum.coefficients, all.coefficients.begin(),
                           [](glm::dvec3 a, glm::dvec3 b) { return a + b; });
  }
  return all;
}

double clamped_cosine_factor(int l) {
  assert(l >= 0);
  if (l == 0) return kPi;
  if (l == 1) return 2.0 * kPi / 3.0;
  if (l % 2 == 1) return 0.0;
  // l! / (2^l (l/2)!^2), the share of the middle term of 2^l = (1 + 1)^l.
  double middle = 1.0;
  for (int k = 2; k <= l; k += 2) middle *= (k - 1.0) / k;
  const double sign = l % 4 == 0 ? -1.0 : 1.0;
  return sign * 2.0 * kPi * middle / ((l + 2.0) * (l - 1.0));
}

SphericalHarmonics irradiance_harmonics(const SphericalHarmonics& radiance) {
  SphericalHarmonics irradiance = radiance;
  for (int l = 0; l <= radiance.degree; ++l) {
    for (int m = -l; m <= l; ++m) irradiance(l, m) *= clamped_cosine_factor(l);
  }
  return irradiance;
}

IrradianceMap irradiance_map(const SphericalHarmonics& irradiance, Extent normals) {
  IrradianceMap map = dark_irradiance_map(normals);
  const LegendreFunctions legendre(irradiance.degree);
  parallel_for(static_cast<std::size_t>(normals.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const std::vector<FourierTerm> terms =
        terms_of_latitude(irradiance, legendre, (y + 0.5) / normals.height);
    for (int x = 0; x < normals.width; ++x) {
      const double phi = kPi - 2.0 * kPi * (x + 0.5) / normals.width;
      glm::dvec3& sum = map.irradiance(x, y);
      for (std::size_t m = 0; m < terms.size(); ++m) {
        const double angle = static_cast<double>(m) * phi;
        sum += std::cos(angle) * terms[m].cosine + std::sin(angle) * terms[m].sine;
      }
    }
  });
  return map;
}

HarmonicTruncation irradiance_truncation(int degree) {
  check_degree(degree);
  // Light from one direction: (cos)+ against its sum of Legendre polynomials, of norm 1 at 1. The
  // largest error of any sum of such lights, in proportion to their powers, is that of one of them.
  const auto term = [](int l) { return (2 * l + 1) / kSphere * clamped_cosine_factor(l); };
  double square = 1.0 / 6.0;  // of (cos)+, over the sphere
  for (int l = 0; l <= degree; ++l) square -= term(l) * term(l) / (2 * l + 1);
  if (degree == 0) return {0.75, std::sqrt(square)};
  // The remainder is largest where (cos)+ bends, at the horizon; P(l) is there 0 for odd l, and for
  // even l (-1)^(l/2) l! / (2^l (l/2)!^2).
  double at_horizon = 0.0;
  double legendre = 1.0;
  for (int l = 0; l <= degree; l += 2) {
    at_horizon += term(l) * legendre;
    legendre *= -(l + 1.0) / (l + 2.0);
  }
  return {at_horizon, std::sqrt(square)};
}

glm::dvec3 omitted_irradiance(const SphericalHarmonics& radiance, int kept) {
  glm::dvec3 square(0.0);
  for (int l = kept + 1; l <= radiance.degree; ++l) {
    const double factor = clamped_cosine_factor(l);
    for (int m = -l; m <= l; ++m) square += factor * factor * radiance(l, m) * radiance(l, m);
  }
  return glm::sqrt(square / kSphere);
}

}  // namespace lightproof
