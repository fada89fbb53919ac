#include "reference/bilinear_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "lightproof/core/gauss_rule.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/look_up.h"
#include "lightproof/warp/lat_long.h"
#include "reference/bilinear_distribution.h"
#include "reference/kernel_nodes.h"
#include "reference/quadrature.h"

namespace lightproof::reference {
namespace {

/// ∫ of the interpolation over the square or in steradian.
double total_of(const Grid<double>& radiance, MapMeasure measure) {
  const auto weight = [measure](double t) {
    return measure == MapMeasure::square ? 1.0 : solid_angle_per_square(t);
  };
  const auto [width, height] = radiance.extent();
  double total = 0.0;
  for (const TentPart& part : tent_parts(0.0, 1.0, height, false, weight)) {
    const auto row = radiance.row(part.texel);
    total += part.integral * std::accumulate(row.begin(), row.end(), 0.0) / width;
  }
  return total;
}

/// Adds E[X^m] = ∫ X^(m-1) X p d(omega) of one node, where X p = L k.
void add(EstimatorMoments& moments, double light, double x) {
  for (double& raw : moments.raw) {
    raw += light;
    light *= x;
  }
}

void raise(EstimatorMoments& moments, double x) { moments.largest = std::max(moments.largest, x); }

void merge(EstimatorMoments& into, const EstimatorMoments& from) {
  for (std::size_t m = 0; m < into.raw.size(); ++m) into.raw[m] += from.raw[m];
  raise(into, from.largest);
}

/// The moments of the cells of a quadrature.
class CellMoments {
 public:
  CellMoments(const Kernel& kernel, const Grid<double>& radiance, Extent cells)
      : kernel_(&kernel),
        radiance_(&radiance),
        weighted_(interpolated_by(DensitySpace::sine_weighted, radiance)),
        quadrature_(cells),
        a_(2.0 * kPi * kPi * total_of(radiance, MapMeasure::square)),
        b_(total_of(radiance, MapMeasure::solid_angle)),
        c_(2.0 * kPi * kPi * total_of(weighted_, MapMeasure::square)) {}

  void add_row(LightMoments& moments, int j) const {
    const Edge low = edge_at(j);
    const Edge high = edge_at(j + 1);
    const auto corners = [&](int i, std::vector<double> Edge::*of) {
      const auto k = static_cast<std::size_t>(i);
      return Corners{{{{(low.*of)[k], (low.*of)[k + 1]}, {(high.*of)[k], (high.*of)[k + 1]}}}};
    };
    visit_kernel_row(
        *kernel_, quadrature_, CellRule::gauss, j,
        [&](int i) { return corners(i, &Edge::radiance).largest() > 0.0; },
        [&](int i, const Node& node, const KernelValue& value) {
          add_node(moments, node, value,
                   {i, j, corners(i, &Edge::radiance), corners(i, &Edge::weighted)});
        });
  }

 private:
  /// A function that is bilinear in a cell, by what it is at the corners.
  struct Corners {
    std::array<std::array<double, 2>, 2> values;  ///< [t][s]

    double largest() const {
      return std::max({values[0][0], values[0][1], values[1][0], values[1][1]});
    }
    double at(double p, double q) const {
      return (1.0 - q) * ((1.0 - p) * values[0][0] + p * values[0][1]) +
             q * ((1.0 - p) * values[1][0] + p * values[1][1]);
    }
  };

  /// A cell, in which the radiance is bilinear, and what the sine-weighted density interpolates.
  struct Cell {
    int i;
    int j;
    Corners radiance;
    Corners weighted;
  };

  /// Both at all corners of cells on one edge between rows.
  struct Edge {
    std::vector<double> radiance;
    std::vector<double> weighted;
  };
  /// The lower edge of row j.
  Edge edge_at(int j) const {
    const auto [width, height] = quadrature_.extent();
    Edge edge;
    for (int i = 0; i <= width; ++i) {
      const SquarePoint at = {static_cast<double>(i) / width, static_cast<double>(j) / height};
      edge.radiance.push_back(look_up_bilinear(*radiance_, at));
      edge.weighted.push_back(look_up_bilinear(weighted_, at));
    }
    return edge;
  }

  void add_node(LightMoments& moments, const Node& node, KernelValue value,
                const Cell& cell) const {
    const auto [width, height] = quadrature_.extent();
    const auto [k, pdf] = value;
    const SquarePoint within = {node.at.s * width - cell.i, node.at.t * height - cell.j};
    const double radiance = cell.radiance.at(within.s, within.t);
    const double brightest = cell.radiance.largest();
    const double light = radiance * k * node.solid_angle;
    const double over_pdf = pdf > 0.0 ? k / pdf : 0.0;
    add(moments[SampledDensity::uniform], light, kSphere * radiance * k);
    add(moments[SampledDensity::material], light, radiance * over_pdf);
    add(moments[SampledDensity::texture_space], light, a_ * k * node.sin_theta);
    add(moments[SampledDensity::solid_angle], light, b_ * k);
    const double weighted = cell.weighted.at(within.s, within.t);
    const double of_c = weighted > 0.0 ? c_ * k * node.sin_theta * radiance / weighted : 0.0;
    add(moments[SampledDensity::sine_weighted], light, of_c);
    // Bilinear functions are largest at a corner.
    raise(moments[SampledDensity::uniform], kSphere * brightest * k);
    raise(moments[SampledDensity::material], brightest * over_pdf);
    raise(moments[SampledDensity::texture_space], a_ * k * node.sin_theta);
    raise(moments[SampledDensity::solid_angle], b_ * k);
    raise(moments[SampledDensity::sine_weighted], of_c);
  }

  const Kernel* kernel_;
  const Grid<double>* radiance_;
  Grid<double> weighted_;
  SphereQuadrature quadrature_;
  double a_;  ///< X = a k sin(theta) under A
  double b_;  ///< X = b k under B
  double c_;  ///< X = c k sin(theta) L / (what is interpolated) under C
};

/// A quarter of a texel, from its centre to a corner.
struct Quarter {
  std::array<double, 2> near;  ///< radiance at the centre's s, at both ends in t
  std::array<double, 2> far;   ///< at the texel's edge
  double t;                    ///< of the centre
  double height;               ///< of the corner above it, signed
};

double between(const std::array<double, 2>& ends, double v) {
  return ends[0] + (ends[1] - ends[0]) * v;
}

/// ∫ du / ((1-u) low + u high) over [0,1].
double mean_reciprocal(double low, double high) {
  const double x = (high - low) / low;
  return (std::abs(x) < 1e-8 ? 1.0 - 0.5 * x : std::log1p(x) / x) / low;
}

/// Where L changes by less than a quarter and t by less than 1/64 its error is below 1e-7.
const GaussRule<3> kRule;

/// Mean of weight(t) / L between two shares of the way: exact over s, by pieces of that size over
/// t.
template <class Weight>
double mean_over_light(const Quarter& quarter, double from, double to, const Weight& weight) {
  constexpr double kMostChange = 1.25;
  const auto changes = [&](const std::array<double, 2>& ends) {
    const double a = between(ends, from);
    const double b = between(ends, to);
    return std::max(a, b) > kMostChange * std::min(a, b);
  };
  const bool wide = (to - from) * std::abs(quarter.height) > 1.0 / 64.0;
  if (wide || changes(quarter.near) || changes(quarter.far)) {
    const double middle = 0.5 * (from + to);
    return mean_over_light(quarter, from, middle, weight) +
           mean_over_light(quarter, middle, to, weight);
  }
  return kRule.integrate(from, to, [&](double v) {
    return weight(quarter.t + v * quarter.height) *
           mean_reciprocal(between(quarter.near, v), between(quarter.far, v));
  });
}

/// The quarters of texel (x, y).
std::array<Quarter, 4> quarters_of(const Grid<double>& luminance, int x, int y) {
  const auto [width, height] = luminance.extent();
  std::array<Quarter, 4> quarters;
  for (std::size_t k = 0; k < 4; ++k) {
    const int beside = (x + (k % 2 == 0 ? width - 1 : 1)) % width;
    const int up = k < 2 ? -1 : 1;
    const int above = std::clamp(y + up, 0, height - 1);
    const double centre = luminance(x, y);
    const double edge = 0.5 * (centre + luminance(beside, y));
    quarters[k] = {{centre, 0.5 * (centre + luminance(x, above))},
                   {edge, 0.5 * (edge + 0.5 * (luminance(x, above) + luminance(beside, above)))},
                   (y + 0.5) / height,
                   0.5 * up / height};
  }
  return quarters;
}

}  // namespace

LightMoments bilinear_light_moments(const Kernel& kernel, const Grid<double>& radiance) {
  const auto [width, height] = radiance.extent();
  // An even number of cells a texel, so that none has a centre inside.
  const Extent halves = SphereQuadrature::cells_per_texel({2 * width, 2 * height});
  const Extent parts = {2 * halves.width, 2 * halves.height};
  const Extent cells = {width * parts.width, height * parts.height};
  const CellMoments moments(kernel, radiance, cells);
  std::vector<LightMoments> rows(static_cast<std::size_t>(cells.height));
  parallel_for(rows.size(), [&](std::size_t j) { moments.add_row(rows[j], static_cast<int>(j)); });
  LightMoments sum;
  for (const LightMoments& row : rows) sum.merge(row);
  return sum;
}

EstimatorMoments bilinear_inverse_pdf(const Grid<double>& radiance, DensitySpace density_space,
                                      const std::function<bool(double)>& is_bright) {
  const Extent extent = radiance.extent();
  const MapMeasure measure = position_measure(density_space);
  const Grid<double> interpolated = interpolated_by(density_space, radiance);
  const double total = total_of(interpolated, measure);
  // 1/p(omega) = factor(t) / what is interpolated.
  const auto factor = [&](double t) {
    return total * (measure == MapMeasure::square ? solid_angle_per_square(t) : 1.0);
  };
  const auto weight = [&](double t) { return factor(t) * solid_angle_per_square(t); };
  const double quarter_area = 0.25 / static_cast<double>(extent.count());
  std::vector<EstimatorMoments> rows(static_cast<std::size_t>(extent.height));
  parallel_for(rows.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const double t[2] = {static_cast<double>(y) / extent.height, (y + 1.0) / extent.height};
    const double most = factor(std::clamp(0.5, t[0], t[1]));  // nearest to the equator
    for (int x = 0; x < extent.width; ++x) {
      if (!is_bright(radiance(x, y))) continue;
      rows[row].raw[0] += texel_solid_angle(extent, y);
      for (const Quarter& quarter : quarters_of(interpolated, x, y)) {
        const auto [near, far, centre, height] = quarter;
        rows[row].raw[1] += quarter_area * mean_over_light(quarter, 0.0, 1.0, weight);
        raise(rows[row], most / std::min({near[0], near[1], far[0], far[1]}));
      }
    }
  });
  EstimatorMoments sum;
  for (const EstimatorMoments& row : rows) merge(sum, row);
  return sum;
}

}  // namespace lightproof::reference
