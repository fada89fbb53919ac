#include "lightproof/precompute/level_check.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_integrals.h"

namespace lightproof {
namespace {

/// The quantile of a two-sided interval of 95 %.
constexpr double kNormalQuantile = 1.959963984540054;

reference::Lobe reference_lobe(const Lobe& lobe) {
  struct Convert {
    reference::Lobe operator()(const PhongLobe& phong) const {
      return reference::phong_lobe(phong.exponent);
    }
    reference::Lobe operator()(const GgxLobe& ggx) const {
      return ggx.weight == GgxWeight::cosine ? reference::ggx_lobe(ggx.alpha)
                                             : reference::ggx_masked_lobe(ggx.alpha, ggx.f0);
    }
    reference::Lobe operator()(const HalfVectorLobe& half_vector) const {
      return reference::half_vector_lobe(half_vector.shininess);
    }
  };
  return std::visit(Convert{}, lobe);
}

/// Texels of a map up to which exact values are computed several at a time: 32 MB each.
constexpr std::size_t kMostTexelsTogether = std::size_t{1} << 22U;

/// How much of [low, high) each of `cells` equal parts of [0, 1) covers, from the first on that it
/// touches.
struct Overlaps {
  int first;
  std::vector<double> lengths;
};

Overlaps overlaps(double low, double high, int cells) {
  Overlaps found{std::clamp(static_cast<int>(low * cells), 0, cells - 1), {}};
  for (int cell = found.first; cell < cells; ++cell) {
    const double from = std::max(low, static_cast<double>(cell) / cells);
    const double to = std::min(high, static_cast<double>(cell + 1) / cells);
    if (to <= from) break;
    found.lengths.push_back(to - from);
  }
  return found;
}

/// The mean of the map over a texel of a latitude-longitude picture, row 0 at the top.
glm::dvec3 mean_over(const Grid<Rgb>& map, Extent extent, LevelTexel texel) {
  const auto [width, height] = map.extent();
  const int y = extent.height - 1 - texel.row;
  const double column = texel.column;
  const Overlaps across = overlaps(column / extent.width, (column + 1.0) / extent.width, width);
  const double low = static_cast<double>(y) / extent.height;
  const double high = static_cast<double>(y + 1) / extent.height;
  const Overlaps along = overlaps(low, high, height);
  glm::dvec3 sum(0.0);
  double whole = 0.0;
  for (std::size_t j = 0; j < along.lengths.size(); ++j) {
    const int row = along.first + static_cast<int>(j);
    const double from = std::max(low, static_cast<double>(row) / height);
    const double area = std::abs(cos_theta(from + along.lengths[j]) - cos_theta(from));
    for (std::size_t i = 0; i < across.lengths.size(); ++i) {
      const double weight = area * across.lengths[i];
      sum += weight * glm::dvec3(map(across.first + static_cast<int>(i), row));
      whole += weight;
    }
  }
  return sum / whole;
}

glm::dvec3 exact_value(const EnvironmentMap& map, Projection projection, const LevelPlan& plan,
                       LevelTexel texel) {
  const Direction centre = direction_of(projection, plan.extent, texel);
  if (plan.lobe) return reference::prefiltered(map.radiance, reference_lobe(*plan.lobe), centre);
  if (!is_cube(projection)) return mean_over(map.radiance, plan.extent, texel);
  const SquarePoint at = square_from_direction(centre);
  const auto [width, height] = map.radiance.extent();
  return map.radiance(std::min(static_cast<int>(at.s * width), width - 1),
                      std::min(static_cast<int>(at.t * height), height - 1));
}

glm::dvec3 mean_radiance(const Grid<Rgb>& map) {
  const Extent extent = map.extent();
  std::vector<glm::dvec3> rows(static_cast<std::size_t>(extent.height), glm::dvec3(0.0));
  parallel_for(rows.size(), [&](std::size_t y) {
    for (const Rgb& texel : map.row(static_cast<int>(y))) rows[y] += glm::dvec3(texel);
  });
  glm::dvec3 sum(0.0);
  for (int y = 0; y < extent.height; ++y) {
    sum += texel_solid_angle(extent, y) * rows[static_cast<std::size_t>(y)];
  }
  return sum / (4.0 * kPi);
}

/// The error of a level, the root of the mean of squares.
LevelError error_of(const Moments& squares) {
  const double mean = squares.mean();
  const double margin = squares.count() > 1 ? kNormalQuantile * squares.standard_error() : mean;
  return {std::sqrt(mean), std::sqrt(std::max(0.0, mean - margin)), std::sqrt(mean + margin),
          static_cast<std::size_t>(squares.count())};
}

Direction uniform_direction(SquarePoint u) {
  const double z = 1.0 - 2.0 * u.t;
  const double sine = std::sqrt(std::max(0.0, 1.0 - z * z));
  const double phi = 2.0 * kPi * u.s;
  return {sine * std::cos(phi), sine * std::sin(phi), z};
}

}  // namespace

std::string error_measure() {
  return "Root mean square of the difference between texels and quadrature over the map at their "
         "centres, relative to the map's mean radiance; the largest of red, green and blue; from "
         "texels drawn at random, with the limits of its 95 % confidence interval.";
}

LevelError check_level(const EnvironmentMap& map, Projection projection, const LevelPlan& plan,
                       const MapLevel& level, const RandomStream& stream, std::size_t texels) {
  require_lat_long(map, "a map for real-time rendering");
  std::vector<glm::dvec3> differences(texels);
  const auto compare = [&](std::size_t i) {
    const LevelTexel texel = texel_at(projection, plan.extent, uniform_direction(stream.point(i)));
    const Rgb& value = level.faces[static_cast<std::size_t>(texel.face)](texel.column, texel.row);
    differences[i] = glm::dvec3(value) - exact_value(map, projection, plan, texel);
  };
  // An exact value takes a number for each of the map's texels, and is computed in parallel itself.
  if (map.radiance.extent().count() <= kMostTexelsTogether) {
    parallel_for(texels, compare);
  } else {
    for (std::size_t i = 0; i < texels; ++i) compare(i);
  }
  const glm::dvec3 mean = mean_radiance(map.radiance);
  LevelError worst{0.0, 0.0, 0.0, texels};
  for (int channel = 0; channel < 3; ++channel) {
    if (mean[channel] <= 0.0) continue;
    Moments squares;
    for (const glm::dvec3& difference : differences) {
      const double relative = difference[channel] / mean[channel];
      squares.add(relative * relative);
    }
    if (const LevelError error = error_of(squares); error.error >= worst.error) worst = error;
  }
  return worst;
}

LevelError check_brdf_map(const BrdfMap& map, Masking masking, const RandomStream& stream,
                          std::size_t texels) {
  const Extent extent = map.values.extent();
  std::vector<double> squares(texels);
  parallel_for(texels, [&](std::size_t i) {
    const SquarePoint u = stream.point(i);
    const int x = std::min(static_cast<int>(u.s * extent.width), extent.width - 1);
    const int y = std::min(static_cast<int>(u.t * extent.height), extent.height - 1);
    const ScaleBias exact =
        integrate_brdf((x + 0.5) / extent.width, (y + 0.5) / extent.height, masking);
    const glm::dvec2 difference =
        glm::dvec2(map.values(x, y)) - glm::dvec2(exact.scale, exact.bias);
    squares[i] = glm::dot(difference, difference);
  });
  Moments moments;
  for (const double square : squares) moments.add(square);
  return error_of(moments);
}

}  // namespace lightproof
