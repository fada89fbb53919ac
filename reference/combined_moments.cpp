#include "reference/combined_moments.h"

#include <algorithm>

#include "lightproof/core/parallel.h"
#include "lightproof/warp/lat_long.h"
#include "reference/kernel_nodes.h"
#include "reference/quadrature.h"

namespace lightproof::reference {
namespace {

/// The density of a map over directions, after compensation.
struct MapDensity {
  double floor = 0.0;  ///< radiance that is taken off
  double left = 0.0;   ///< ∫ of what is left

  double pdf(double radiance) const { return std::max(0.0, radiance - floor) / left; }
};

double integral_above(const Grid<double>& radiance, double floor) {
  double sum = 0.0;
  for (int y = 0; y < radiance.extent().height; ++y) {
    double row = 0.0;
    for (const double value : radiance.row(y)) row += std::max(0.0, value - floor);
    sum += row * texel_solid_angle(radiance.extent(), y);
  }
  return sum;
}

MapDensity density_of(const Grid<double>& radiance, double compensation) {
  const double whole = integral_above(radiance, 0.0);
  const double floor = compensation * whole / kSphere;
  const double left = integral_above(radiance, floor);
  return left < 1e-6 * whole ? MapDensity{0.0, whole} : MapDensity{floor, left};
}

/// Integrals of one technique: of w f, and of w^2 f^2 / p.
struct Technique {
  double light = 0.0;
  double square = 0.0;
  double largest = 0.0;  ///< w f / p

  void add(double weight, double f, double p, double solid_angle) {
    light += weight * f * solid_angle;
    if (!(p > 0.0)) return;
    square += weight * weight * f * f / p * solid_angle;
    largest = std::max(largest, weight * f / p);
  }
  void merge(const Technique& other) {
    light += other.light;
    square += other.square;
    largest = std::max(largest, other.largest);
  }
};

struct Techniques {
  Technique lobes;
  Technique map;

  void merge(const Techniques& other) {
    lobes.merge(other.lobes);
    map.merge(other.map);
  }
};

/// The techniques of several estimators; none before the first node.
struct AllTechniques {
  std::vector<Techniques> of;

  void merge(const AllTechniques& other) {
    of.resize(std::max(of.size(), other.of.size()));
    for (std::size_t i = 0; i < other.of.size(); ++i) of[i].merge(other.of[i]);
  }
};

/// Sums add(sum of a row, map, radiance, value, node) over all nodes at which k is positive.
template <class Sum, class Add>
std::vector<Sum> sums_over(const Kernel& kernel, std::span<const Grid<double>> radiance,
                           const Add& add) {
  const Extent extent = radiance.front().extent();
  constexpr Extent kLeast = SphereQuadrature::kLeastCells;
  const Extent parts = {(kLeast.width + extent.width - 1) / extent.width,
                        (kLeast.height + extent.height - 1) / extent.height};
  const SphereQuadrature quadrature({extent.width * parts.width, extent.height * parts.height});
  const auto height = static_cast<std::size_t>(quadrature.extent().height);
  std::vector<std::vector<Sum>> rows(height, std::vector<Sum>(radiance.size()));
  const auto add_cell = [&](int x, int y, std::vector<Sum>& sums) {
    visit_kernel(kernel, quadrature, x, y, [&](const Node& node, const KernelValue& value) {
      for (std::size_t map = 0; map < radiance.size(); ++map) {
        const double light = radiance[map](x / parts.width, y / parts.height);
        if (light > 0.0) add(sums[map], map, light, value, node);
      }
    });
  };
  parallel_for(height, [&](std::size_t row) {
    for (int x = 0; x < quadrature.extent().width; ++x) {
      add_cell(x, static_cast<int>(row), rows[row]);
    }
  });
  std::vector<Sum> sums(radiance.size());
  for (const auto& row : rows) {
    for (std::size_t map = 0; map < radiance.size(); ++map) sums[map].merge(row[map]);
  }
  return sums;
}

MeanAndVariance moments_of(const Techniques& techniques, const CombinedSampling& sampling) {
  const auto& [lobes, map] = techniques;
  const double mean = lobes.light + map.light;
  const double squares = lobes.square + map.square;
  const double off = sampling.is_one_sample ? 0.5 * mean * mean
                                            : lobes.light * lobes.light + map.light * map.light;
  const double largest = sampling.is_one_sample ? 2.0 * std::max(lobes.largest, map.largest)
                                                : lobes.largest + map.largest;
  return {mean, std::max(0.0, 2.0 * (squares - off)), largest};
}

double emphasised(Heuristic heuristic, double x) {
  return heuristic == Heuristic::balance ? x : x * x;
}

}  // namespace

std::vector<std::vector<MeanAndVariance>> combined_moments(
    const Kernel& kernel, std::span<const Grid<double>> radiance,
    std::span<const CombinedSampling> samplings) {
  std::vector<std::vector<MapDensity>> densities;  // [estimator][grid]
  for (const CombinedSampling& sampling : samplings) {
    densities.emplace_back();
    for (const auto& grid : radiance) {
      densities.back().push_back(density_of(grid, sampling.compensation));
    }
  }
  const auto sums =
      sums_over<AllTechniques>(kernel, radiance,
                               [&](AllTechniques& sum, std::size_t map, double light,
                                   const KernelValue& value, const Node& node) {
                                 sum.of.resize(samplings.size());
                                 for (std::size_t i = 0; i < samplings.size(); ++i) {
                                   const double f = light * value.k;
                                   const double p = value.pdf;
                                   const double q = densities[i][map].pdf(light);
                                   const double a = emphasised(samplings[i].heuristic, p);
                                   const double b = emphasised(samplings[i].heuristic, q);
                                   sum.of[i].lobes.add(a / (a + b), f, p, node.solid_angle);
                                   sum.of[i].map.add(b / (a + b), f, q, node.solid_angle);
                                 }
                               });
  std::vector<std::vector<MeanAndVariance>> moments(samplings.size());
  for (std::size_t i = 0; i < samplings.size(); ++i) {
    for (const AllTechniques& all : sums) {
      moments[i].push_back(all.of.empty() ? MeanAndVariance{}
                                          : moments_of(all.of[i], samplings[i]));
    }
  }
  return moments;
}

std::vector<MeanAndVariance> combined_moments(const Kernel& kernel,
                                              std::span<const Grid<double>> radiance,
                                              const CombinedSampling& sampling) {
  return combined_moments(kernel, radiance, std::span(&sampling, 1)).front();
}

std::vector<MeanAndVariance> density_moments(const Kernel& kernel,
                                             std::span<const Grid<double>> radiance,
                                             const std::function<double(Direction)>& pdf) {
  const auto sums =
      sums_over<Technique>(kernel, radiance,
                           [&](Technique& sum, std::size_t /*map*/, double light,
                               const KernelValue& value, const Node& node) {
                             sum.add(1.0, light * value.k, pdf(node.direction), node.solid_angle);
                           });
  std::vector<MeanAndVariance> moments;
  for (const auto& [light, square, largest] : sums) {
    moments.push_back({light, std::max(0.0, square - light * light), largest});
  }
  return moments;
}

}  // namespace lightproof::reference
