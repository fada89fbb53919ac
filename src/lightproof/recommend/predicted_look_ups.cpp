#include "lightproof/recommend/predicted_look_ups.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightproof/estimators/diffuse_tables.h"
#include "lightproof/estimators/specular_tables.h"
#include "lightproof/materials/material_batch.h"
#include "lightproof/prefilter/specular_chain.h"
#include "lightproof/prefilter/spherical_harmonics.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// A texel of a grid and its share of a bilinear look-up.
struct Tap {
  int x;
  int y;
  double share;
};

std::array<Tap, 4> bilinear_taps(Extent extent, Direction d) {
  const SquarePoint at = square_from_direction(d);
  const double column = std::floor(at.s * extent.width - 0.5);
  const double row = std::floor(at.t * extent.height - 0.5);
  const double across = at.s * extent.width - 0.5 - column;
  const double along = at.t * extent.height - 0.5 - row;
  const int x0 = (static_cast<int>(column) + extent.width) % extent.width;
  const int x1 = (x0 + 1) % extent.width;
  const int y0 = std::max(static_cast<int>(row), 0);
  const int y1 = std::min(static_cast<int>(row) + 1, extent.height - 1);
  return {{{x0, y0, (1.0 - across) * (1.0 - along)},
           {x1, y0, across * (1.0 - along)},
           {x0, y1, (1.0 - across) * along},
           {x1, y1, across * along}}};
}

Direction centre_of(Extent extent, const Tap& tap) {
  return direction_from_square({(tap.x + 0.5) / extent.width, (tap.y + 0.5) / extent.height});
}

/// A grid's bilinear interpolation at a direction, if value(centre of a texel, texel) is in its
/// texels.
template <class Value>
double interpolated(Extent extent, Direction d, const Value& value) {
  double sum = 0.0;
  for (const Tap& tap : bilinear_taps(extent, d)) {
    if (tap.share > 0.0) sum += tap.share * value(centre_of(extent, tap), tap);
  }
  return sum;
}

/// Irradiance over pi of any normal, over nodes that reach all that it sees.
double diffuse_radiance(const LightNodes& nodes, Direction normal) {
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double cosine = normal.x * nodes.x[i] + normal.y * nodes.y[i] + normal.z * nodes.z[i];
    sum += std::max(0.0, cosine) * nodes.light[i];
  }
  return sum / kPi;
}

double harmonic_radiance(const MapSummary& summary, Direction normal) {
  const std::vector<double> harmonics = harmonics_at(normal, 2);
  double sum = 0.0;
  for (int l = 0; l <= 2; ++l) {
    for (int m = -l; m <= l; ++m) {
      const std::size_t i = harmonic_index(l, m);
      sum += clamped_cosine_factor(l) / kPi * summary.harmonics[i] * harmonics[i];
    }
  }
  return std::max(0.0, sum);
}

/// A point that is seen along its normal.
ShadingPoint seen_along(Direction axis) { return {glm::dvec3(0.0), frame_around(axis), axis}; }

/// The light under a lobe around an axis, from the density with which a material draws there at
/// n = v: weigh(density, cosine).
template <class Weigh>
double light_under(const Material& lobe, Direction axis, const LightNodes& nodes,
                   const Weigh& weigh) {
  std::vector<double> k(nodes.size());
  std::vector<double> pdf(nodes.size());
  scatterings(lobe, seen_along(axis), nodes.directions(), {k, pdf});
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double cosine = axis.x * nodes.x[i] + axis.y * nodes.y[i] + axis.z * nodes.z[i];
    if (cosine > 0.0) sum += weigh(pdf[i], cosine) * nodes.light[i];
  }
  return sum;
}

/// The mean of the map over a texel of another grid.
double mean_over(const MapSummary& summary, Extent grid, const Tap& texel) {
  const Extent finest = summary.finest.extent();
  const auto overlap = [](int cell, int cells, int texel_index, int texels) {
    const double from =
        std::max(static_cast<double>(cell) / cells, static_cast<double>(texel_index) / texels);
    const double to = std::min(static_cast<double>(cell + 1) / cells,
                               static_cast<double>(texel_index + 1) / texels);
    return std::max(0.0, to - from);
  };
  double light = 0.0;
  double area = 0.0;
  for (int y = texel.y * finest.height / grid.height;
       y < finest.height && y * grid.height < (texel.y + 1) * finest.height; ++y) {
    const double along =
        overlap(y, finest.height, texel.y, grid.height) * sin_theta((y + 0.5) / finest.height);
    for (int x = texel.x * finest.width / grid.width;
         x < finest.width && x * grid.width < (texel.x + 1) * finest.width; ++x) {
      const double part = along * overlap(x, finest.width, texel.x, grid.width);
      light += part * static_cast<double>(summary.finest(x, y));
      area += part;
    }
  }
  return light / area;
}

}  // namespace

PredictedLookUps::PredictedLookUps(const MapSummary& summary, const Material& material)
    : summary_(&summary), material_(material) {
  if (const auto* ggx = std::get_if<Ggx>(&material)) set_chain(*ggx);
}

void PredictedLookUps::set_chain(const Ggx& ggx) {
  const double level = level_of_roughness(ggx.roughness, kSplitSumLevels);
  const int finer = std::min(static_cast<int>(level), kSplitSumLevels - 2);
  const auto extents = level_extents(kSplitSumFinest, kSplitSumLevels);
  const auto roughness = level_roughness(kSplitSumLevels);
  for (const int i : {finer, finer + 1}) {
    const double share = i == finer ? finer + 1 - level : level - finer;
    if (!(share > 0.0)) continue;
    const auto index = static_cast<std::size_t>(i);
    Level made = {extents[index], share, {}, 0.0};
    if (roughness[index] > 0.0) {
      made.lobe =
          Ggx{roughness[index], 1.0, SmithMasking::height_correlated, MicrofacetSampling::normals};
      // Along the normal, D(h) (n·h) / 4 (v·h) is 1 / (4 pi alpha^2) at its largest.
      const double alpha = ggx_alpha(roughness[index]);
      made.norm = solid_angle(GgxLobe{alpha}) / (4.0 * kPi * alpha * alpha);
    }
    chain_.push_back(made);
  }
}

std::vector<LookedUpLight> PredictedLookUps::at(const ScatteredLight& light, const ShadingPoint& at,
                                                Direction axis) const {
  const Direction normal = at.frame.normal;
  const auto diffuse = [&] {
    return interpolated(kTabulatedNormals, normal, [&](Direction centre, const Tap& /*tap*/) {
      return diffuse_radiance(light.nodes, centre);
    });
  };
  std::vector<LookedUpLight> found;
  const std::array<double, 1> cosine = {glm::dot(at.view, normal)};
  if (const auto* lambert = std::get_if<Lambert>(&material_)) {
    found.push_back({"sh-9", lambert->albedo * harmonic_radiance(*summary_, normal)});
    found.push_back({"tabulated irradiance", lambert->albedo * diffuse()});
  } else if (const auto* ggx = std::get_if<Ggx>(&material_)) {
    double sum = 0.0;
    for (const Level& level : chain_) sum += level.share * of_level(level, light, axis);
    found.push_back({"split-sum", sum * reflected_of_white_sky(*ggx, cosine).front()});
  } else if (const auto* phong = std::get_if<ModifiedPhong>(&material_)) {
    const PhongLobe wanted = prefilter_lobe(*phong);
    const double glossy =
        interpolated(prefilter_extent(wanted), axis, [&](Direction centre, const Tap& /*tap*/) {
          return light_under(ModifiedPhong{0.0, 1.0, wanted.exponent}, centre, light.nodes,
                             [](double pdf, double /*cosine*/) { return pdf; });
        });
    found.push_back(
        {"prefiltered phong",
         phong->diffuse * diffuse() +
             phong->specular * reflected_of_white_sky(*phong, cosine).front() * glossy});
  }
  return found;
}

double PredictedLookUps::of_level(const Level& level, const ScatteredLight& light,
                                  Direction axis) const {
  return interpolated(level.extent, axis, [&](Direction centre, const Tap& tap) {
    if (!level.lobe) return mean_over(*summary_, level.extent, tap);
    return light_under(*level.lobe, centre, light.nodes,
                       [&](double pdf, double cosine) { return pdf * cosine / level.norm; });
  });
}

}  // namespace lightproof
