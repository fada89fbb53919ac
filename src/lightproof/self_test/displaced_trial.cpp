#include "lightproof/self_test/displaced_trial.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"

namespace lightproof {

double effect_on(std::span<const double> declared, std::span<const double> drawn) {
  double square = 0.0;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    square += (drawn[i] - declared[i]) * (drawn[i] - declared[i]) / declared[i];
  }
  return std::sqrt(square);
}

double distance_of_bins(const Grid<double>& declared, const Grid<double>& drawn) {
  return effect_on(reference::bin_masses(declared, kTrialTarget.density_space, kGateBins).values(),
                   reference::bin_masses(drawn, kTrialTarget.density_space, kGateBins).values());
}

double distance_of_texels(const Grid<double>& declared, const Grid<double>& drawn) {
  return effect_on(declared.values(), drawn.values());
}

double distance_of_rows(const Grid<double>& declared, const Grid<double>& drawn) {
  return effect_on(reference::row_marginal(declared), reference::row_marginal(drawn));
}

double distance_of_columns(const Grid<double>& declared, const Grid<double>& drawn) {
  return effect_on(reference::column_marginal(declared), reference::column_marginal(drawn));
}

Trial trial_off_by(double effect, DistributionDistance distance) {
  const EnvironmentMap map = calibration_map();
  const Grid<double> declared = reference::texel_masses(map, kTrialTarget);
  Grid<double> other(declared.extent());
  for (int y = 0; y < other.extent().height; ++y) {
    for (int x = 0; x < other.extent().width; ++x) {
      const double side = 2 * x < other.extent().width ? 4.0 / 3.0 : 2.0 / 3.0;
      other(x, y) = side * texel_solid_angle(other.extent(), y) / kSphere;
    }
  }
  const double share = effect / distance(declared, other);
  for (std::size_t i = 0; i < other.values().size(); ++i) {
    other.values()[i] = (1.0 - share) * declared.values()[i] + share * other.values()[i];
  }
  return {map, std::move(other)};
}

TransformedDistance transformed_distance(std::span<const double> declared,
                                         std::span<const double> actual) {
  double above = 0.0;
  double below = 0.0;
  double p = 0.0;
  double q = 0.0;
  double square = 0.0;
  using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
  constexpr unsigned kMostHalvings = 10;
  constexpr double kRelativeError = 1e-9;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    // Both distributions are linear inside a cell; 1/u and 1/(1-u) may be steep.
    const auto weighted = [&](double share) {
      const double u = p + share * declared[i];
      const double d = q + share * actual[i] - u;
      return d * d / (u * (1.0 - u));
    };
    square += declared[i] * Rule::integrate(weighted, 0.0, 1.0, kMostHalvings, kRelativeError);
    p += declared[i];
    q += actual[i];
    above = std::max(above, q - p);
    below = std::max(below, p - q);
  }
  return {above + below, std::sqrt(square)};
}

double distance_of_phi(const Grid<double>& declared, const Grid<double>& drawn) {
  return transformed_distance(reference::column_marginal(declared),
                              reference::column_marginal(drawn))
      .kuiper;
}

double distance_of_theta(const Grid<double>& declared, const Grid<double>& drawn) {
  return transformed_distance(reference::row_marginal(declared), reference::row_marginal(drawn))
      .anderson;
}

}  // namespace lightproof
