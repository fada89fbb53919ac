#include "reference/texel_masses.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lightproof/core/error.h"
#include "lightproof/core/measure.h"
#include "reference/bilinear_distribution.h"
#include "reference/mapped_texels.h"

namespace lightproof::reference {
namespace {

/// The share of cell `index` of `count` that lies below `edge`, measured along `height`.
template <class Height>
double share_below(double edge, int index, int count, const Height& height) {
  const double low = height(static_cast<double>(index) / count);
  const double high = height((index + 1.0) / count);
  const double at =
      height(std::clamp(edge, static_cast<double>(index) / count, (index + 1.0) / count));
  return (at - low) / (high - low);
}

/// overlap[b][i]: the share of cell i of `cells` that falls into bin b of `bins`.
template <class Height>
Grid<double> overlaps(int cells, int bins, const Height& height) {
  Grid<double> overlap({cells, bins});
  for (int b = 0; b < bins; ++b) {
    for (int i = 0; i < cells; ++i) {
      const double upper = share_below((b + 1.0) / bins, i, cells, height);
      const double lower = share_below(static_cast<double>(b) / bins, i, cells, height);
      overlap(i, b) = upper - lower;
    }
  }
  return overlap;
}

}  // namespace

Grid<double> texel_masses(const EnvironmentMap& map, TargetDensity target) {
  const Extent extent = map.radiance.extent();
  if (target.lookup == Lookup::bilinear) return bilinear_masses(map, target, extent);
  Grid<double> masses(extent);
  double total = 0.0;
  const bool is_square = texel_measure(target.density_space, map.mapping) == MapMeasure::square;
  for (int y = 0; y < extent.height; ++y) {
    const double low = static_cast<double>(y) / extent.height;
    const double high = (y + 1.0) / extent.height;
    const double row = is_square ? high - low : cos_theta(high) - cos_theta(low);
    for (int x = 0; x < extent.width; ++x) {
      const bool has_row = is_square || map.mapping.kind == MappingKind::lat_long;
      const double area = has_row ? row : cell_solid_angle(map.mapping, texel_cell(extent, x, y));
      masses(x, y) = luminance_of(map.radiance(x, y), target.weights) * area;
      total += masses(x, y);
    }
  }
  if (!(total > 0.0)) throw InputError(map.name + ": the map is black");
  for (double& mass : masses.values()) mass /= total;
  return masses;
}

Grid<double> bin_masses(const Grid<double>& texel_masses, DensitySpace density_space, Extent bins) {
  const Extent extent = texel_masses.extent();
  const Grid<double> across = overlaps(extent.width, bins.width, [](double s) { return s; });
  const Grid<double> along = overlaps(extent.height, bins.height, [&](double t) {
    return position_measure(density_space) == MapMeasure::square ? t : cos_theta(t);
  });
  Grid<double> folded({bins.width, extent.height});
  for (int b = 0; b < bins.width; ++b) {
    // The columns that a bin overlaps, rounded outwards.
    const auto begin = static_cast<int>(std::int64_t{b} * extent.width / bins.width);
    const auto end =
        static_cast<int>((std::int64_t{b + 1} * extent.width + bins.width - 1) / bins.width);
    for (int y = 0; y < extent.height; ++y) {
      for (int x = begin; x < end; ++x) folded(b, y) += across(x, b) * texel_masses(x, y);
    }
  }
  Grid<double> masses(bins);
  for (int b = 0; b < bins.height; ++b) {
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < bins.width; ++x) masses(x, b) += along(y, b) * folded(x, y);
    }
  }
  return masses;
}

Grid<double> turned_bin_masses(const Grid<double>& texel_masses, double shift, Extent bins) {
  const Extent extent = texel_masses.extent();
  Grid<double> turned({bins.width, extent.height});
  for (int x = 0; x < extent.width; ++x) {
    const double left = static_cast<double>(x) / extent.width + shift;
    const double right = (x + 1.0) / extent.width + shift;
    for (int b = 0; b < bins.width; ++b) {
      double overlap = 0.0;
      for (const double turn : {-1.0, 0.0, 1.0}) {
        const double low = static_cast<double>(b) / bins.width + turn;
        const double high = (b + 1.0) / bins.width + turn;
        overlap += std::max(0.0, std::min(right, high) - std::max(left, low));
      }
      for (int y = 0; y < extent.height; ++y) {
        turned(b, y) += overlap * extent.width * texel_masses(x, y);
      }
    }
  }
  return bin_masses(turned, DensitySpace::solid_angle, bins);
}

Grid<double> bin_masses(const EnvironmentMap& map, TargetDensity target, Extent bins) {
  if (target.lookup == Lookup::bilinear) return bilinear_masses(map, target, bins);
  if (!is_plain(map.mapping)) {
    const Grid<double> masses = texel_masses(map, target);
    if (position_measure(target.density_space, map.mapping) == MapMeasure::solid_angle) {
      return turned_bin_masses(masses, map.mapping.shift, bins);
    }
    return binned_masses(masses, map.mapping, bins).masses;
  }
  return bin_masses(texel_masses(map, target), target.density_space, bins);
}

std::vector<double> row_marginal(const Grid<double>& masses) {
  std::vector<double> sums(static_cast<std::size_t>(masses.extent().height));
  for (int y = 0; y < masses.extent().height; ++y) {
    for (const double mass : masses.row(y)) sums[static_cast<std::size_t>(y)] += mass;
  }
  return sums;
}

std::vector<double> column_marginal(const Grid<double>& masses) {
  std::vector<double> sums(static_cast<std::size_t>(masses.extent().width));
  for (int y = 0; y < masses.extent().height; ++y) {
    for (int x = 0; x < masses.extent().width; ++x) {
      sums[static_cast<std::size_t>(x)] += masses(x, y);
    }
  }
  return sums;
}

}  // namespace lightproof::reference
