#include "reference/combined_moments.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Integrals of one technique: of (w f / p)^n p for n from 1 to 4.
struct Technique {
  std::array<double, 4> raw = {};
  double largest = 0.0;  ///< w f / p

  void add(double weight, double f, double p, double solid_angle) {
    raw[0] += weight * f * solid_angle;
    if (!(p > 0.0)) return;
    const double estimate = weight * f / p;
    double term = weight * f * solid_angle;
    for (std::size_t n = 1; n < raw.size(); ++n) raw[n] += term *= estimate;
    largest = std::max(largest, estimate);
  }
  void merge(const Technique& other) {
    for (std::size_t n = 0; n < raw.size(); ++n) raw[n] += other.raw[n];
    largest = std::max(largest, other.largest);
  }
  EstimatorMoments moments() const { return {raw, largest}; }
};

struct Techniques {
  Technique lobes;
  Technique map;

  void merge(const Techniques& other) {
    lobes.merge(other.lobes);
    map.merge(other.map);
  }
};

/// The sums of several estimators; none before the first node.
template <class Sum>
struct AllOf {
  std::vector<Sum> of;

  void merge(const AllOf& other) {
    of.resize(std::max(of.size(), other.of.size()));
    for (std::size_t i = 0; i < other.of.size(); ++i) of[i].merge(other.of[i]);
  }
};

/// Sums add(sum of a row, map, radiance, value, node) over all nodes at which k is positive.
template <class Sum, class Add>
std::vector<Sum> sums_over(const Kernel& kernel, std::span<const Grid<double>> radiance,
                           CellRule rule, const Add& add) {
  const Extent extent = radiance.front().extent();
  const Extent parts = SphereQuadrature::cells_per_texel(extent);
  const SphereQuadrature quadrature({extent.width * parts.width, extent.height * parts.height});
  const auto height = static_cast<std::size_t>(quadrature.extent().height);
  std::vector<std::vector<Sum>> rows(height, std::vector<Sum>(radiance.size()));
  parallel_for(height, [&](std::size_t row) {
    const int y = static_cast<int>(row) / parts.height;
    visit_kernel_row(
        kernel, quadrature, rule, static_cast<int>(row),
        [&](int i) {
          return std::any_of(radiance.begin(), radiance.end(),
                             [&](const auto& grid) { return grid(i / parts.width, y) > 0.0; });
        },
        [&](int i, const Node& node, const KernelValue& value) {
          for (std::size_t map = 0; map < radiance.size(); ++map) {
            const double light = radiance[map](i / parts.width, y);
            if (light > 0.0) add(rows[row][map], map, light, value, node);
          }
        });
  });
  std::vector<Sum> sums(radiance.size());
  for (const auto& row : rows) {
    for (std::size_t map = 0; map < radiance.size(); ++map) sums[map].merge(row[map]);
  }
  return sums;
}

/// The moments of samples each of which chooses its technique by the toss of a coin.
MeanAndVariance one_sample_moments(const Techniques& techniques) {
  // An estimate is 2 w f / p with probability p / 2.
  EstimatorMoments moments;
  for (std::size_t n = 0; n < moments.raw.size(); ++n) {
    moments.raw[n] =
        std::ldexp(techniques.lobes.raw[n] + techniques.map.raw[n], static_cast<int>(n));
  }
  return {moments.mean(), moments.variance(),
          2.0 * std::max(techniques.lobes.largest, techniques.map.largest),
          moments.fourth_central()};
}

/// The moments of pairs of independent samples, one of each technique; the variance is that of one
/// sample.
MeanAndVariance pair_moments(const Techniques& techniques) {
  const EstimatorMoments lobes = techniques.lobes.moments();
  const EstimatorMoments map = techniques.map.moments();
  return {lobes.mean() + map.mean(), 2.0 * (lobes.variance() + map.variance()),
          lobes.largest + map.largest,
          lobes.fourth_central() + map.fourth_central() + 6.0 * lobes.variance() * map.variance()};
}

double emphasised(Heuristic heuristic, double x) {
  return heuristic == Heuristic::balance ? x : x * x;
}

/// The sums of combined estimators and of densities.
struct SumsOfBoth {
  AllOf<Techniques> combined;
  AllOf<Technique> densities;

  void merge(const SumsOfBoth& other) {
    combined.merge(other.combined);
    densities.merge(other.densities);
  }
};

}  // namespace

SamplingMoments sampling_moments(const Kernel& kernel, std::span<const Grid<double>> radiance,
                                 std::span<const CombinedSampling> samplings,
                                 std::span<const DensityAtNode> pdfs, CellRule rule) {
  std::vector<std::vector<MapDensity>> of_maps;  // [estimator][grid]
  for (const CombinedSampling& sampling : samplings) {
    of_maps.emplace_back();
    for (const auto& grid : radiance) {
      of_maps.back().push_back(density_of(grid, sampling.compensation));
    }
  }
  const auto sums =
      sums_over<SumsOfBoth>(kernel, radiance, rule,
                            [&](SumsOfBoth& sum, std::size_t map, double light,
                                const KernelValue& value, const Node& node) {
                              sum.combined.of.resize(samplings.size());
                              sum.densities.of.resize(pdfs.size());
                              const double f = light * value.k;
                              for (std::size_t i = 0; i < samplings.size(); ++i) {
                                const double p = value.pdf;
                                const double q = of_maps[i][map].pdf(light);
                                const double a = emphasised(samplings[i].heuristic, p);
                                const double b = emphasised(samplings[i].heuristic, q);
                                sum.combined.of[i].lobes.add(a / (a + b), f, p, node.solid_angle);
                                sum.combined.of[i].map.add(b / (a + b), f, q, node.solid_angle);
                              }
                              for (std::size_t i = 0; i < pdfs.size(); ++i) {
                                sum.densities.of[i].add(1.0, f, pdfs[i](node), node.solid_angle);
                              }
                            });
  SamplingMoments moments{std::vector<std::vector<MeanAndVariance>>(samplings.size()),
                          std::vector<std::vector<MeanAndVariance>>(pdfs.size())};
  for (const SumsOfBoth& all : sums) {
    for (std::size_t i = 0; i < samplings.size(); ++i) {
      const bool is_black = all.combined.of.empty();
      moments.combined[i].push_back(is_black ? MeanAndVariance{}
                                    : samplings[i].is_one_sample
                                        ? one_sample_moments(all.combined.of[i])
                                        : pair_moments(all.combined.of[i]));
    }
    for (std::size_t i = 0; i < pdfs.size(); ++i) {
      const bool is_black = all.densities.of.empty();
      const EstimatorMoments sum = is_black ? EstimatorMoments{} : all.densities.of[i].moments();
      moments.densities[i].push_back(
          {sum.mean(), sum.variance(), sum.largest, sum.fourth_central()});
    }
  }
  return moments;
}

std::vector<std::vector<MeanAndVariance>> combined_moments(
    const Kernel& kernel, std::span<const Grid<double>> radiance,
    std::span<const CombinedSampling> samplings, CellRule rule) {
  return sampling_moments(kernel, radiance, samplings, {}, rule).combined;
}

std::vector<MeanAndVariance> combined_moments(const Kernel& kernel,
                                              std::span<const Grid<double>> radiance,
                                              const CombinedSampling& sampling) {
  return combined_moments(kernel, radiance, std::span(&sampling, 1)).front();
}

std::vector<MeanAndVariance> density_moments(const Kernel& kernel,
                                             std::span<const Grid<double>> radiance,
                                             const DensityAtNode& pdf) {
  return sampling_moments(kernel, radiance, {}, std::span(&pdf, 1)).densities.front();
}

}  // namespace lightproof::reference
