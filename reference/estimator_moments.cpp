#include "reference/estimator_moments.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "lightproof/core/parallel.h"
#include "lightproof/warp/lat_long.h"
#include "reference/kernel_nodes.h"
#include "reference/mapped_texels.h"
#include "reference/quadrature.h"

namespace lightproof::reference {
namespace {

/// ∫ over one texel of the powers of k that the moments of all estimators are made of.
struct TexelIntegrals {
  std::array<double, 4> plain = {};     ///< k^m
  std::array<double, 4> sine = {};      ///< k^m sin^(m-1)(theta)
  std::array<double, 4> material = {};  ///< k^m / pdf^(m-1)
  double largest = 0.0;                 ///< k
  double largest_sine = 0.0;            ///< k sin(theta)
  double largest_ratio = 0.0;           ///< k / pdf

  void add(const KernelValue& value, const Node& node) {
    largest = std::max(largest, value.k);
    largest_sine = std::max(largest_sine, value.k * node.sin_theta);
    if (value.pdf > 0.0) largest_ratio = std::max(largest_ratio, value.k / value.pdf);
    double p = value.k * node.solid_angle;
    double q = p;
    double r = p;
    for (std::size_t m = 0; m < plain.size(); ++m) {
      plain[m] += p;
      sine[m] += q;
      material[m] += r;
      p *= value.k;
      q *= value.k * node.sin_theta;
      r *= value.pdf > 0.0 ? value.k / value.pdf : 0.0;
    }
  }
};

/// The texels of row y as their parts, which are the cells of the quadrature.
template <class IsWanted>
std::vector<TexelIntegrals> integrate_row(const Kernel& kernel, const SphereQuadrature& quadrature,
                                          CellRule rule, Extent parts, int y,
                                          const IsWanted& is_wanted) {
  std::vector<TexelIntegrals> texels(
      static_cast<std::size_t>(quadrature.extent().width / parts.width));
  for (int j = y * parts.height; j < (y + 1) * parts.height; ++j) {
    visit_kernel_row(
        kernel, quadrature, rule, j, [&](int i) { return is_wanted(i / parts.width); },
        [&](int i, const Node& node, const KernelValue& value) {
          texels[static_cast<std::size_t>(i / parts.width)].add(value, node);
        });
  }
  return texels;
}

/// The texels of row y of a map of another mapping.
template <class IsWanted>
std::vector<TexelIntegrals> integrate_row(const Kernel& kernel, const Mapping& mapping, Extent map,
                                          int y, const IsWanted& is_wanted) {
  std::vector<TexelIntegrals> texels(static_cast<std::size_t>(map.width));
  for (int x = 0; x < map.width; ++x) {
    if (!is_wanted(x)) continue;
    visit_kernel(kernel, mapping, map, texel_cell(map, x, y),
                 [&](const Node& node, const KernelValue& value) {
                   texels[static_cast<std::size_t>(x)].add(value, node);
                 });
  }
  return texels;
}

/// The factors that turn the texel's integrals into moments.
struct Totals {
  double solid_angle_sum;  ///< G = ∫ L d(omega)
  double mean;             ///< A = mean of L over the square
};

Totals totals_of(const Grid<double>& radiance, const Mapping& mapping) {
  Totals totals{0.0, 0.0};
  for (int y = 0; y < radiance.extent().height; ++y) {
    const auto row = radiance.row(y);
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    totals.mean += sum / static_cast<double>(radiance.extent().count());
    if (mapping.kind == MappingKind::lat_long) {
      totals.solid_angle_sum += sum * texel_solid_angle(radiance.extent(), y);
      continue;
    }
    for (int x = 0; x < radiance.extent().width; ++x) {
      totals.solid_angle_sum +=
          radiance(x, y) * cell_solid_angle(mapping, texel_cell(radiance.extent(), x, y));
    }
  }
  return totals;
}

/// How large a texel is, in the square and on the sphere.
struct TexelArea {
  double solid_angle;  ///< of a texel, in steradian
  double area;         ///< of a texel, over the square
};

/// Adds one texel: E[X^m] = ∫ (L k)^m / p^(m-1) d(omega).
void accumulate(LightMoments& moments, double radiance, const Totals& totals, TexelArea texel_area,
                const TexelIntegrals& texel) {
  const double a = 2.0 * kPi * kPi * totals.mean;
  const double c =
      2.0 * kPi * kPi * totals.solid_angle_sum * texel_area.area / texel_area.solid_angle;
  const auto raise = [](EstimatorMoments& m, double x) { m.largest = std::max(m.largest, x); };
  raise(moments[SampledDensity::uniform], kSphere * radiance * texel.largest);
  raise(moments[SampledDensity::material], radiance * texel.largest_ratio);
  if (radiance > 0.0) {
    raise(moments[SampledDensity::texture_space], a * texel.largest_sine);
    raise(moments[SampledDensity::solid_angle], totals.solid_angle_sum * texel.largest);
    raise(moments[SampledDensity::sine_weighted], c * texel.largest_sine);
  }
  double uniform = radiance;
  double material = radiance;
  double environment_a = radiance;
  double environment_b = radiance;
  double environment_c = radiance;
  for (std::size_t m = 0; m < texel.plain.size(); ++m) {
    moments[SampledDensity::uniform].raw[m] += uniform * texel.plain[m];
    moments[SampledDensity::material].raw[m] += material * texel.material[m];
    moments[SampledDensity::texture_space].raw[m] += environment_a * texel.sine[m];
    moments[SampledDensity::solid_angle].raw[m] += environment_b * texel.plain[m];
    moments[SampledDensity::sine_weighted].raw[m] += environment_c * texel.sine[m];
    uniform *= kSphere * radiance;
    material *= radiance;
    environment_a *= a;
    environment_b *= totals.solid_angle_sum;
    environment_c *= c;
  }
}

}  // namespace

void LightMoments::merge(const LightMoments& other) {
  for (std::size_t i = 0; i < of_.size(); ++i) {
    for (std::size_t m = 0; m < of_[i].raw.size(); ++m) of_[i].raw[m] += other.of_[i].raw[m];
    of_[i].largest = std::max(of_[i].largest, other.of_[i].largest);
  }
}

double EstimatorMoments::variance() const { return std::max(0.0, raw[1] - raw[0] * raw[0]); }

double EstimatorMoments::fourth_central() const {
  const double m = raw[0];
  return std::max(0.0, raw[3] - 4.0 * m * raw[2] + 6.0 * m * m * raw[1] - 3.0 * m * m * m * m);
}

Kernel cosine_kernel(Direction normal) {
  return {[normal](Direction d) {
            return KernelValue{std::max(0.0, glm::dot(normal, d)), 0.0};
          },
          [normal](Direction d, double angle) {
            return std::abs(glm::dot(normal, d)) <= std::sin(std::min(angle, 0.5 * kPi));
          }};
}

std::vector<LightMoments> light_moments(const Kernel& kernel,
                                        std::span<const Grid<double>> radiance,
                                        const Mapping& mapping, CellRule rule) {
  const Extent extent = radiance.front().extent();
  assert(std::all_of(radiance.begin(), radiance.end(),
                     [&](const auto& grid) { return grid.extent() == extent; }));
  // Large texels are divided first, so that only those parts are split where an edge may run.
  const Extent parts = SphereQuadrature::cells_per_texel(extent);
  const SphereQuadrature quadrature({extent.width * parts.width, extent.height * parts.height});
  std::vector<Totals> totals;
  for (const auto& grid : radiance) totals.push_back(totals_of(grid, mapping));

  const auto height = static_cast<std::size_t>(extent.height);
  std::vector<std::vector<LightMoments>> rows(height, std::vector<LightMoments>(radiance.size()));
  parallel_for(height, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const auto is_bright = [&](int x) {
      return std::any_of(radiance.begin(), radiance.end(),
                         [&](const auto& grid) { return grid(x, y) != 0.0; });
    };
    const std::vector<TexelIntegrals> texels =
        is_plain(mapping) ? integrate_row(kernel, quadrature, rule, parts, y, is_bright)
                          : integrate_row(kernel, mapping, extent, y, is_bright);
    for (int x = 0; x < extent.width; ++x) {
      const TexelIntegrals& texel = texels[static_cast<std::size_t>(x)];
      if (texel.plain[0] == 0.0) continue;
      const TexelArea of_texel = {mapping.kind == MappingKind::lat_long
                                      ? texel_solid_angle(extent, y)
                                      : cell_solid_angle(mapping, texel_cell(extent, x, y)),
                                  1.0 / static_cast<double>(extent.count())};
      for (std::size_t map = 0; map < radiance.size(); ++map) {
        if (radiance[map](x, y) == 0.0) continue;  // whatever the powers of 1/pdf are
        accumulate(rows[row][map], radiance[map](x, y), totals[map], of_texel, texel);
      }
    }
  });

  std::vector<LightMoments> sums(radiance.size());
  for (const auto& row : rows) {
    for (std::size_t map = 0; map < radiance.size(); ++map) {
      sums[map].merge(row[map]);
    }
  }
  return sums;
}

}  // namespace lightproof::reference
