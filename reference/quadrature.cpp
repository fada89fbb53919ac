#include "reference/quadrature.h"

#include <cmath>

#include "lightproof/warp/lat_long.h"

namespace lightproof::reference {
namespace {

/// Places of the two Gauss-Legendre nodes in [0,1].
constexpr std::array<double, 2> kNodes = {0.21132486540518712, 0.78867513459481288};

/// Solid angle between two t per unit of azimuth.
double band(double t_low, double t_high) {
  return 2.0 * sin_theta(0.5 * (t_low + t_high)) * std::sin(0.5 * kPi * (t_high - t_low));
}

/// How often a texel is divided so that the sphere has at least so many cells.
Extent cells_per_texel(Extent map, Extent least) {
  return {(least.width + map.width - 1) / map.width, (least.height + map.height - 1) / map.height};
}

}  // namespace

SphereQuadrature::SphereQuadrature(Extent extent)
    : extent_(extent),
      radius_(0.5 * std::hypot(2.0 * kPi / extent.width, kPi / extent.height)),
      coarse_(make_level(cells_per_texel(extent, kLeastCells))),
      fine_(make_level(cells_per_texel(extent, kLeastEdgeCells))) {}

Direction SphereQuadrature::centre(int x, int y) const {
  return direction_from_square({(x + 0.5) / extent_.width, (y + 0.5) / extent_.height});
}

SphereQuadrature::Level SphereQuadrature::make_level(Extent cells) const {
  Level level{{2 * cells.width, 2 * cells.height}, {}, {}};
  const int rows = extent_.height * cells.height;
  const int columns = extent_.width * cells.width;
  for (int j = 0; j < rows; ++j) {
    std::array<double, 2> sines{};
    for (std::size_t k = 0; k < 2; ++k) sines[k] = sin_theta((j + kNodes[k]) / rows);
    // The rule's own sum is rescaled to the exact solid angle of the cell.
    const double exact =
        band(static_cast<double>(j) / rows, (j + 1.0) / rows) * 2.0 * kPi / columns;
    for (std::size_t k = 0; k < 2; ++k) {
      level.rows.push_back({sines[k], cos_theta((j + kNodes[k]) / rows),
                            exact * sines[k] / (2.0 * (sines[0] + sines[1]))});
    }
  }
  for (int i = 0; i < columns; ++i) {
    for (const double node : kNodes) {
      const double phi = kPi - 2.0 * kPi * (i + node) / columns;
      level.columns.push_back({std::cos(phi), std::sin(phi)});
    }
  }
  return level;
}

}  // namespace lightproof::reference
