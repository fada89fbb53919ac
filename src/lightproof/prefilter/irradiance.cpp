#include "lightproof/prefilter/irradiance.h"

#include <cmath>
#include <vector>

#include "lightproof/core/measure.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/prefilter/cosine_band.h"

namespace lightproof {
namespace {

/// The edges of the columns. Azimuths run with s.
std::vector<Meridian> column_edges(Direction normal, NormalTilt tilt, int width) {
  const double own = kPi - std::atan2(normal.y, normal.x);  // 2 pi s
  std::vector<Meridian> edges;
  edges.reserve(static_cast<std::size_t>(width) + 1);
  for (int x = 0; x <= width; ++x) edges.emplace_back(tilt, 2.0 * kPi * x / width - own);
  return edges;
}

glm::dvec3 weighted_sum(std::span<const Rgb> row, std::span<const Meridian> edges,
                        const CosineBand& band) {
  glm::dvec3 sum(0.0);
  double before = band(edges[0]);
  for (std::size_t x = 0; x < row.size(); ++x) {
    const double after = band(edges[x + 1]);
    sum += (after - before) * glm::dvec3(row[x]);
    before = after;
  }
  return sum;
}

}  // namespace

Irradiance irradiance(const EnvironmentMap& map, Direction normal) {
  require_lat_long(map, "irradiance");
  const auto [width, height] = map.radiance.extent();
  const NormalTilt tilt = tilt_of(normal);
  const std::vector<Meridian> edges = column_edges(normal, tilt, width);
  Irradiance sum{glm::dvec3(0.0)};
  Parallel inner(tilt, 0.0);
  for (int k = 0; k < height; ++k) {
    const Parallel outer(tilt, kPi * (k + 1) / height);
    const int y = normal.z < 0.0 ? k : height - 1 - k;
    sum.rgb += weighted_sum(map.radiance.row(y), edges, CosineBand(tilt, inner, outer));
    inner = outer;
  }
  return sum;
}

}  // namespace lightproof
