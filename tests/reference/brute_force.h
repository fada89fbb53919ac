// Maps and integrals once more, as slowly and plainly as can be, sharing no code with what they
// check: values by tents around all centres, integrals by the midpoint rule.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "lightproof/core/grid.h"

namespace lightproof::test {

inline const double kPi = std::acos(-1.0);

/// The value at (s, t) of the texel there.
inline double nearest_value(const Grid<double>& luminance, double s, double t) {
  const auto [width, height] = luminance.extent();
  return luminance(std::min(static_cast<int>(s * width), width - 1),
                   std::min(static_cast<int>(t * height), height - 1));
}

/// Every centre's value, weighted by tents as wide as two texels: around the seam in s, held fast
/// beyond the last centres in t.
inline double interpolated_value(const Grid<double>& luminance, double s, double t) {
  const auto [width, height] = luminance.extent();
  const auto tent = [](double distance) { return std::max(0.0, 1.0 - std::abs(distance)); };
  const double row = std::clamp(t * height, 0.5, height - 0.5);
  double sum = 0.0;
  for (int y = 0; y < height; ++y) {
    for (int x = -width; x < 2 * width; ++x) {
      sum += tent(row - 0.5 - y) * tent(s * width - 0.5 - x) * luminance((x + width) % width, y);
    }
  }
  return sum;
}

using Value = double (*)(const Grid<double>& luminance, double s, double t);

/// Calls visit(s, t, area) at the middle of each of so many cells of the square.
template <class Visit>
void visit_middles(Extent cells, const Visit& visit) {
  const double area = 1.0 / cells.width / cells.height;
  for (int j = 0; j < cells.height; ++j) {
    for (int i = 0; i < cells.width; ++i) {
      visit((i + 0.5) / cells.width, (j + 0.5) / cells.height, area);
    }
  }
}

/// Masses of the cells of a lattice, of density value (times sin(pi t) if over directions); they
/// sum to 1.
inline Grid<double> lattice_masses(const Grid<double>& luminance, Value value, bool over_directions,
                                   Extent cells) {
  Grid<double> masses(cells);
  double total = 0.0;
  std::size_t i = 0;
  visit_middles(cells, [&](double s, double t, double /*area*/) {
    masses.values()[i] = value(luminance, s, t) * (over_directions ? std::sin(kPi * t) : 1.0);
    total += masses.values()[i++];
  });
  for (double& mass : masses.values()) mass /= total;
  return masses;
}

/// Every texel's value times the solid angle of the texel, up to a constant.
inline Grid<double> times_solid_angle(Grid<double> luminance) {
  const int height = luminance.extent().height;
  for (int y = 0; y < height; ++y) {
    const double bottom = std::cos(kPi * y / height);
    const double top = std::cos(kPi * (y + 1) / height);
    for (double& value : luminance.row(y)) value *= bottom - top;
  }
  return luminance;
}

/// Of all five estimators E[X^m], X = L k / p, and the largest X.
struct EstimatorSums {
  struct RawMoments {
    std::array<double, 4> raw = {};
    double largest = 0.0;
  };
  RawMoments uniform;
  RawMoments material;
  RawMoments environment_a;
  RawMoments environment_b;
  RawMoments environment_c;
};

/// The integrand's other factor at a unit vector, and the density that a material draws it with.
struct Factor {
  double k;
  double pdf;
};

inline EstimatorSums estimator_sums(const Grid<double>& luminance, Value value,
                                    const std::function<Factor(double, double, double)>& at,
                                    Extent cells) {
  const Grid<double> weighted = times_solid_angle(luminance);
  double mean = 0.0;  // of L over the square
  double mean_weighted = 0.0;
  double whole = 0.0;  // of L over the sphere
  visit_middles(cells, [&](double s, double t, double area) {
    mean += value(luminance, s, t) * area;
    mean_weighted += value(weighted, s, t) * area;
    whole += value(luminance, s, t) * 2.0 * kPi * kPi * std::sin(kPi * t) * area;
  });
  EstimatorSums moments;
  visit_middles(cells, [&](double s, double t, double area) {
    const double theta = kPi - kPi * t;
    const double phi = kPi - 2.0 * kPi * s;
    const Factor factor =
        at(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    const double light = value(luminance, s, t);
    const double jacobian = 2.0 * kPi * kPi * std::sin(theta);
    const auto add = [&](EstimatorSums::RawMoments& of, double density) {
      if (!(density > 0.0)) return;
      const double x = light * factor.k / density;
      for (std::size_t m = 0; m < 4; ++m) {
        of.raw[m] += std::pow(x, static_cast<double>(m + 1)) * density * jacobian * area;
      }
      of.largest = std::max(of.largest, x);
    };
    add(moments.uniform, 1.0 / (4.0 * kPi));
    add(moments.material, factor.pdf);
    add(moments.environment_a, light / mean / jacobian);
    add(moments.environment_b, light / whole);
    add(moments.environment_c, value(weighted, s, t) / mean_weighted / jacobian);
  });
  return moments;
}

}  // namespace lightproof::test
