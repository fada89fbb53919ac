#include "lightproof/prefilter/irradiance_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "lightproof/core/error.h"
#include "lightproof/prefilter/two_sided_irradiance.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// The normals of the upper hemisphere, row after row from the zenith, in combs that fit the
/// source's columns.
class UpperNormals {
 public:
  UpperNormals(Extent normals, const FoldedLattice& lattice)
      : normals_(normals),
        teeth_(std::gcd(lattice.columns, normals.width)),
        combs_of_row_(normals.width / teeth_) {}

  /// The combs turned by so many radians of longitude.
  std::vector<NormalComb> combs(double turned) const {
    std::vector<NormalComb> combs;
    for (int row = 0; row < (normals_.height + 1) / 2; ++row) {
      const double theta = kPi * (row + 0.5) / normals_.height;
      for (int i = 0; i < combs_of_row_; ++i) {
        const double longitude = 2.0 * kPi * (i + 0.5) / normals_.width + turned;
        combs.push_back({{std::sin(theta), std::cos(theta)}, longitude, teeth_});
      }
    }
    return combs;
  }

  /// Where two_sided_irradiance puts the column's normal of the row.
  std::size_t index(int column, int row) const {
    const int comb = row * combs_of_row_ + column % combs_of_row_;
    return static_cast<std::size_t>(comb) * static_cast<std::size_t>(teeth_) +
           static_cast<std::size_t>(column / combs_of_row_);
  }

 private:
  Extent normals_;
  int teeth_;
  int combs_of_row_;
};

/// A normal on its own, or its opposite if that is in the upper hemisphere.
NormalComb comb_of(Direction normal) {
  const Direction upper = normal.z < 0.0 ? -normal : normal;
  return {tilt_of(upper), kPi - std::atan2(upper.y, upper.x), 1};
}

}  // namespace

IrradianceMap dark_irradiance_map(Extent normals) {
  if (normals.width < 1 || normals.height < 1) {
    throw InputError(fmt::format("an irradiance map of {} x {} normals: at least 1 x 1 needed",
                                 normals.width, normals.height));
  }
  return {Grid<glm::dvec3>(normals, glm::dvec3(0.0))};
}

IrradianceMap irradiance_map(const EnvironmentMap& source, Extent normals) {
  IrradianceMap map = dark_irradiance_map(normals);
  const auto [width, height] = normals;
  const FoldedLattice lattice(source.radiance.extent());
  const UpperNormals upper(normals, lattice);
  const auto above = two_sided_irradiance(source, lattice, upper.combs(0.0));
  // Opposite longitudes are columns only if the columns are even.
  const bool paired = width % 2 == 0;
  const auto opposite = paired ? above : two_sided_irradiance(source, lattice, upper.combs(kPi));
  for (int row = 0; row < (height + 1) / 2; ++row) {
    for (int x = 0; x < width; ++x) {
      const int turned = paired ? (x + width / 2) % width : x;
      map.irradiance(x, row) = opposite[upper.index(turned, row)].lower;
      map.irradiance(x, height - 1 - row) = above[upper.index(x, row)].upper;
    }
  }
  return map;
}

std::vector<Irradiance> irradiances(const EnvironmentMap& source,
                                    std::span<const Direction> normals) {
  const FoldedLattice lattice(source.radiance.extent());
  std::vector<NormalComb> combs(normals.size());
  std::ranges::transform(normals, combs.begin(), comb_of);
  const auto both = two_sided_irradiance(source, lattice, combs);
  std::vector<Irradiance> result;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    result.push_back({normals[i].z < 0.0 ? both[i].lower : both[i].upper});
  }
  return result;
}

Direction normal_of_texel(Extent normals, int x, int y) {
  return direction_from_square({(x + 0.5) / normals.width, (y + 0.5) / normals.height});
}

DiffuseMap diffuse_map(const IrradianceMap& map) {
  DiffuseMap diffuse{map.irradiance};
  for (glm::dvec3& texel : diffuse.radiance.values()) texel /= kPi;
  return diffuse;
}

Grid<Rgb> rounded(const Grid<glm::dvec3>& values) {
  Grid<Rgb> floats(values.extent());
  std::ranges::transform(values.values(), floats.values().begin(),
                         [](glm::dvec3 rgb) { return Rgb(rgb); });
  return floats;
}

IrradianceError error_of(const IrradianceMap& map, const IrradianceMap& exact) {
  const Extent normals = exact.irradiance.extent();
  assert(map.irradiance.extent() == normals);
  glm::dvec3 mean(0.0);
  glm::dvec3 largest(0.0);
  glm::dvec3 square(0.0);
  for (int y = 0; y < normals.height; ++y) {
    const double share = texel_solid_angle(normals, y) / kSphere;
    for (int x = 0; x < normals.width; ++x) {
      const glm::dvec3 difference = glm::abs(map.irradiance(x, y) - exact.irradiance(x, y));
      largest = glm::max(largest, difference);
      square += share * difference * difference;
      mean += share * exact.irradiance(x, y);
    }
  }
  IrradianceError error;
  for (int channel = 0; channel < 3; ++channel) {
    if (largest[channel] == 0.0) continue;
    error.largest = std::max(error.largest, largest[channel] / mean[channel]);
    error.root_mean_square =
        std::max(error.root_mean_square, std::sqrt(square[channel]) / mean[channel]);
  }
  return error;
}

}  // namespace lightproof
