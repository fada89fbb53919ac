#include "lightproof/recommend/prediction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lightproof/core/parallel.h"
#include "lightproof/estimators/cell_cdf.h"
#include "lightproof/estimators/diffuse_tables.h"
#include "lightproof/estimators/hierarchical_product.h"
#include "lightproof/estimators/outgoing_table.h"
#include "lightproof/estimators/product_table.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/estimators/specular_tables.h"
#include "lightproof/estimators/texel_directions.h"
#include "lightproof/estimators/two_level_product.h"
#include "lightproof/prefilter/specular_chain.h"
#include "lightproof/prefilter/spherical_harmonics.h"
#include "lightproof/recommend/light_nodes.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/sphere_batch.h"

namespace lightproof {
namespace {

using reference::CombinedSampling;
using reference::Heuristic;

/// How estimators are named that draw at points of a set.
constexpr std::array<std::string_view, 4> kPointSets = {" stratified", " hammersley", " R2",
                                                        " sobol"};

/// Of an estimator at one point: the variance of a sample, and the bias.
struct ErrorAt {
  ErrorLaw law;
  double variance;
  double bias;
  StrataVariances inside = {};
};

/// By the estimator's name.
using ErrorsAt = std::map<std::string, ErrorAt, std::less<>>;

/// A point's nodes, and what the material does there.
struct ScatteredLight {
  LightNodes nodes;
  std::vector<double> k;    ///< f_r (n·l)+
  std::vector<double> pdf;  ///< of the material's lobes
  double mean = 0.0;        ///< I = ∫ L k
  /// ∫ of the material's density, which is 1 but for the error of the nodes. With it in the place
  /// of 1, that error stays out of the variance where L k over the density is even.
  double lobes = 0.0;
};

ScatteredLight scattered(const MapSummary& summary, const Material& material,
                         const ShadingPoint& at, const LobeReach& lobe, Direction also) {
  ScatteredLight light;
  light.nodes = nodes_for(summary, lobe, at.frame.normal, also);
  light.k.resize(light.nodes.size());
  light.pdf.resize(light.nodes.size());
  scatterings(material, at, light.nodes.directions(), {light.k, light.pdf});
  for (std::size_t i = 0; i < light.k.size(); ++i) {
    light.mean += light.k[i] * light.nodes.light[i];
    light.lobes += light.pdf[i] * light.nodes.solid_angle[i];
  }
  return light;
}

/// The density of the map after compensation, over the luminance above a floor.
struct Compensated {
  double floor = 0.0;
  double scale = 0.0;

  double pdf(double luminance) const { return std::max(0.0, luminance - floor) * scale; }
};

Compensated compensated(const MapSummary& summary, double compensation) {
  const double left = compensation == 0.0   ? summary.light
                      : compensation == 0.5 ? summary.light_above_half
                                            : summary.light_above_mean;
  if (!(left >= 1e-6 * summary.light)) return {0.0, 1.0 / summary.light};
  return {compensation * summary.light / kSphere, 1.0 / left};
}

/// Integrals of two techniques together: of w f of the lobes, and of w^2 f^2 / p of both.
struct Combined {
  double of_lobes = 0.0;
  double squares = 0.0;
};

/// A cell's light of many luminances is taken for that of the one ∫ L^2 / ∫ L: this is exact where
/// either density is far above the other one.
Combined combine(const ScatteredLight& light, const Compensated& density, Heuristic heuristic) {
  Combined sums;
  const LightNodes& nodes = light.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double k = light.k[i];
    if (!(k > 0.0) || !(nodes.light[i] > 0.0)) continue;
    const double p = light.pdf[i];
    const double q = density.pdf(nodes.square[i] / nodes.light[i]);
    if (heuristic == Heuristic::balance) {
      const double weight = 1.0 / (p + q);
      sums.of_lobes += k * nodes.light[i] * p * weight;
      sums.squares += k * k * nodes.square[i] * weight;
    } else {
      const double weight = 1.0 / (p * p + q * q);
      sums.of_lobes += k * nodes.light[i] * p * p * weight;
      sums.squares += k * k * nodes.square[i] * (p * p * p + q * q * q) * weight * weight;
    }
  }
  return sums;
}

/// The variance of one sample by the one-sample estimator; of the multi-sample one, of a sample of
/// an even number.
double variance_of(const Combined& sums, const ScatteredLight& light, bool is_one_sample) {
  const double excess = light.lobes - 1.0;
  if (is_one_sample) {
    return std::max(0.0, 2.0 * sums.squares - light.mean * light.mean * (1.0 - 0.5 * excess));
  }
  const double of_map = light.mean - sums.of_lobes;
  return std::max(
      0.0, 2.0 * (sums.squares - sums.of_lobes * sums.of_lobes * (1.0 - excess) - of_map * of_map));
}

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

/// What a grid gives at a direction, if value(centre of a texel, texel) is in its texels.
template <class Value>
double looked_up(Extent extent, Direction d, const Value& value) {
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

/// What is the same at all points.
class Predictor {
 public:
  Predictor(const MapSummary& summary, const Material& material)
      : summary_(&summary),
        material_(material),
        product_nodes_(cell_size(nodes_of(summary)), 0.5, nodes_of(summary)),
        quadrant_centres_(quadrant_size(summary), 0.5, summary.quadtree_light.back().extent()) {
    if (const auto* ggx = std::get_if<Ggx>(&material)) set_chain(*ggx);
    set_strata();
  }

  /// The errors of all estimators at a point, and the exact radiance.
  double predict(const ShadingPoint& at, ErrorsAt& errors) const {
    const LobeReach lobe = lobe_of(material_, at);
    const bool has_table_of_lobes =
        std::holds_alternative<Ggx>(material_) || std::holds_alternative<ModifiedPhong>(material_);
    const ScatteredLight light = scattered(*summary_, material_, at, lobe,
                                           has_table_of_lobes ? lobe.place.axis : Direction(0.0));
    add_lobes(light, at, errors);
    add_tables(light, errors);
    add_combined(light, errors);
    add_products(light, at, errors);
    add_lights(light, at, errors);
    add_look_ups(light, at, lobe, errors);
    add_outgoing(light, at, errors);
    add_strata(at, errors);
    return light.mean;
  }

 private:
  static Extent nodes_of(const MapSummary& summary) {
    const Extent blocks = summary.product_light.extent();
    return {TwoLevelProduct::kNodes * blocks.width, TwoLevelProduct::kNodes * blocks.height};
  }
  static CellSize quadrant_size(const MapSummary& summary) {
    return {summary.quadrant_side / summary.extent.width,
            summary.quadrant_side / summary.extent.height};
  }

  /// A level of the split sum's chain.
  struct Level {
    Extent extent;
    double share;             ///< of the look-up
    std::optional<Ggx> lobe;  ///< none: the mirror
    double norm = 0.0;        ///< ∫ of the density with which normals are drawn times the cosine
  };

  void set_chain(const Ggx& ggx) {
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
        made.lobe = Ggx{roughness[index], 1.0, SmithMasking::height_correlated,
                        MicrofacetSampling::normals};
        // Along the normal, D(h) (n·h) / 4 (v·h) is 1 / (4 pi alpha^2) at its largest.
        const double alpha = ggx_alpha(roughness[index]);
        made.norm = solid_angle(GgxLobe{alpha}) / (4.0 * kPi * alpha * alpha);
      }
      chain_.push_back(made);
    }
  }

  /// From E[X^2]; `whole` is the integral of the density over the nodes.
  static void one_sample(std::string_view name, double square, double mean, ErrorsAt& errors,
                         double whole = 1.0) {
    const double variance = std::max(0.0, square - mean * mean * (2.0 - whole));
    errors.emplace(name, ErrorAt{ErrorLaw::independent, variance, 0.0});
  }

  void add_lobes(const ScatteredLight& light, const ShadingPoint& at, ErrorsAt& errors) const {
    const LightNodes& nodes = light.nodes;
    const Direction n = at.frame.normal;
    double plain = 0.0;
    double by_cosine = 0.0;
    double by_material = 0.0;
    double cosines = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double cosine = n.x * nodes.x[i] + n.y * nodes.y[i] + n.z * nodes.z[i];
      if (cosine > 0.0) cosines += cosine * nodes.solid_angle[i];
      const double k = light.k[i];
      if (!(k > 0.0)) continue;
      const double square = nodes.square[i] * k * k;
      plain += square;
      by_cosine += square / cosine;
      if (light.pdf[i] > 0.0) by_material += square / light.pdf[i];
    }
    one_sample("uniform", kSphere * plain, light.mean, errors);
    one_sample("hemisphere", 0.5 * kSphere * plain, light.mean, errors);
    one_sample("cosine", kPi * by_cosine, light.mean, errors, cosines / kPi);
    one_sample("brdf", by_material, light.mean, errors, light.lobes);
    const auto* ggx = std::get_if<Ggx>(&material_);
    if (ggx == nullptr) return;
    add_normals("ggx normals", *ggx, MicrofacetSampling::normals, light, at, errors);
    add_normals("ggx visible normals", *ggx, MicrofacetSampling::visible_normals, light, at,
                errors);
    add_normals("ggx bounded caps", *ggx, MicrofacetSampling::bounded_caps, light, at, errors);
    errors.emplace("ggx spherical caps", errors.find("ggx visible normals")->second);
  }

  /// GGX with its normals drawn in one way.
  static void add_normals(std::string_view name, Ggx ggx, MicrofacetSampling sampling,
                          const ScatteredLight& light, const ShadingPoint& at, ErrorsAt& errors) {
    if (ggx.sampling == sampling) {
      errors.emplace(name, errors.find("brdf")->second);
      return;
    }
    ggx.sampling = sampling;
    const LightNodes& nodes = light.nodes;
    std::vector<double> k(nodes.size());
    std::vector<double> pdf(nodes.size());
    scatterings(ggx, at, nodes.directions(), {k, pdf});
    double square = 0.0;
    double whole = 0.0;
    for (std::size_t i = 0; i < k.size(); ++i) {
      whole += pdf[i] * nodes.solid_angle[i];
      if (pdf[i] > 0.0) square += nodes.square[i] * k[i] * k[i] / pdf[i];
    }
    one_sample(name, square, light.mean, errors, whole);
  }

  void add_tables(const ScatteredLight& light, ErrorsAt& errors) const {
    const LightNodes& nodes = light.nodes;
    double exact = 0.0;
    std::array<double, kTableDensities> second = {};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double square = light.k[i] * light.k[i];
      exact += square * nodes.light[i];
      for (std::size_t j = 0; j < kTableDensities; ++j) second[j] += square * nodes.second[j][i];
    }
    exact *= summary_->light;
    one_sample("environment A", second[0], light.mean, errors);
    one_sample("environment B", exact, light.mean, errors);
    one_sample("environment C", second[1], light.mean, errors);
    one_sample("environment B alias", exact, light.mean, errors);
    for (std::size_t i = 0; i < kReductions.size(); ++i) {
      one_sample("environment B alias 1/" + std::to_string(kReductions[i]), second[2 + i],
                 light.mean, errors);
    }
    // Rounding knows nothing of k.
    one_sample("environment B half", exact * (1.0 + summary_->half_float_variance), light.mean,
               errors);
    one_sample("environment B 8-bit", exact * (1.0 + summary_->byte_variance), light.mean, errors);
  }

  void add_combined(const ScatteredLight& light, ErrorsAt& errors) const {
    std::map<std::pair<Heuristic, double>, Combined> known;
    const auto variance = [&](const CombinedSampling& sampling) {
      const auto key = std::pair(sampling.heuristic, sampling.compensation);
      auto found = known.find(key);
      if (found == known.end()) {
        const Combined sums =
            combine(light, compensated(*summary_, sampling.compensation), sampling.heuristic);
        found = known.emplace(key, sums).first;
      }
      return variance_of(found->second, light, sampling.is_one_sample);
    };
    for (const EstimatorInfo& info : estimators()) {
      if (!info.combined) continue;
      errors.emplace(info.name, ErrorAt{ErrorLaw::independent, variance(*info.combined), 0.0});
    }
    // What is chosen is weighed by the mean of its candidates, in luminance that of their own
    // estimates.
    const double candidate = variance({.is_one_sample = true});
    for (const int candidates : {4, 16, 64}) {
      errors.emplace("ris " + std::to_string(candidates),
                     ErrorAt{ErrorLaw::independent, candidate / candidates, 0.0});
    }
  }

  void add_products(const ScatteredLight& light, const ShadingPoint& at, ErrorsAt& errors) const {
    const LightNodes& nodes = light.nodes;
    const double least = kProductTableShare * light.mean / summary_->light;
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double k = light.k[i];
      if (k > 0.0) sum += nodes.light[i] * k * k / (k + least);
    }
    one_sample("product table", (light.mean + least * summary_->light) * sum, light.mean, errors);

    const auto square_by = [&](const std::vector<double>& scale,
                               const std::vector<std::uint16_t>& block) {
      double square = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        square += nodes.light[i] * light.k[i] * light.k[i] * scale[block[i]];
      }
      return square;
    };
    one_sample("product two-level", square_by(two_level_scales(at), nodes.product), light.mean,
               errors);
    one_sample("product hierarchical", square_by(quadrant_scales(at), nodes.quadrant), light.mean,
               errors);
  }

  /// For each block the luminance over the density.
  std::vector<double> two_level_scales(const ShadingPoint& at) const {
    const Grid<double>& light = summary_->product_light;
    constexpr int kNodes = TwoLevelProduct::kNodes;
    Grid<double> weights(light.extent());
    std::vector<double> k(static_cast<std::size_t>(product_nodes_.columns()));
    for (int row = 0; row < product_nodes_.rows(); ++row) {
      product_nodes_.reflected(material_, at, row, k);
      for (int x = 0; x < product_nodes_.columns(); ++x) {
        weights(x / kNodes, row / kNodes) += k[static_cast<std::size_t>(x)] / (kNodes * kNodes);
      }
    }
    const auto values = weights.values();
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * light.values()[i];
    const double least = sum > 0.0 ? TwoLevelProduct::kDefensiveShare * sum / summary_->light : 1.0;
    double whole = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      whole += (values[i] + least) * light.values()[i];
    }
    std::vector<double> scales(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) scales[i] = whole / (values[i] + least);
    return scales;
  }

  /// The same for the squares of the quadtree.
  std::vector<double> quadrant_scales(const ShadingPoint& at) const {
    const std::vector<Grid<double>>& light = summary_->quadtree_light;
    const std::vector<Grid<double>>& area = summary_->quadtree_area;
    std::vector<Grid<double>> k(light.size());
    Grid<double>& finest = k.back() = Grid<double>(light.back().extent());
    double sum = 0.0;
    for (int y = 0; y < finest.extent().height; ++y) {
      quadrant_centres_.reflected(material_, at, y, finest.row(y));
      for (int x = 0; x < finest.extent().width; ++x) sum += finest(x, y) * light.back()(x, y);
    }
    const double least =
        sum > 0.0 ? HierarchicalProduct::kDefensiveShare * sum / summary_->light : 1.0;
    for (std::size_t i = 0; i < finest.values().size(); ++i) {
      finest.values()[i] = (finest.values()[i] + least) * area.back().values()[i];
    }
    for (std::size_t level = k.size() - 1; level > 0; --level) {
      k[level - 1] = Grid<double>(light[level - 1].extent());
      for (int y = 0; y < k[level].extent().height; ++y) {
        for (int x = 0; x < k[level].extent().width; ++x)
          k[level - 1](x / 2, y / 2) += k[level](x, y);
      }
    }
    // Downwards: a square's probability is its parent's times its share of the quarters' products.
    Grid<double> mass({1, 1}, 1.0);
    for (std::size_t level = 1; level < k.size(); ++level) {
      const Extent extent = light[level].extent();
      const auto product = [&](int x, int y) {
        return k[level](x, y) * light[level](x, y) / area[level](x, y);
      };
      Grid<double> sums(light[level - 1].extent());
      Grid<double> finer(extent);
      for (int y = 0; y < extent.height; ++y) {
        for (int x = 0; x < extent.width; ++x) sums(x / 2, y / 2) += product(x, y);
      }
      for (int y = 0; y < extent.height; ++y) {
        for (int x = 0; x < extent.width; ++x) {
          const double all = sums(x / 2, y / 2);
          if (all > 0.0) finer(x, y) = mass(x / 2, y / 2) * product(x, y) / all;
        }
      }
      mass = std::move(finer);
    }
    std::vector<double> scales(mass.values().size());
    for (std::size_t i = 0; i < scales.size(); ++i) {
      if (mass.values()[i] > 0.0) scales[i] = light.back().values()[i] / mass.values()[i];
    }
    return scales;
  }

  /// Where a monotone table of the map has the points of strata: rows by t, columns by s.
  void set_strata() {
    const std::vector<SquarePoint> points = strata_points();
    const Grid<float>& map = summary_->finest;
    const auto [width, height] = map.extent();
    std::vector<double> rows;
    double sum = 0.0;
    for (int y = 0; y < height; ++y) {
      double row = 0.0;
      for (const float luminance : map.row(y)) row += static_cast<double>(luminance);
      rows.push_back(sum += row * texel_solid_angle(map.extent(), y));
    }
    std::vector<double> columns(static_cast<std::size_t>(width));
    for (std::size_t i = 0; i < points.size(); ++i) {
      strata_s_[i] = points[i].s;
      strata_t_[i] = points[i].t;
      const FoundCell row = find_cell(rows, 0.0, points[i].t);
      if (i % kStrataSide == 0) {
        double before = 0.0;
        for (int x = 0; x < width; ++x) {
          columns[static_cast<std::size_t>(x)] = before +=
              static_cast<double>(map(x, static_cast<int>(row.index)));
        }
      }
      const FoundCell column = find_cell(columns, 0.0, points[i].s);
      const Direction d =
          direction_from_square({(static_cast<double>(column.index) + column.rest) / width,
                                 (static_cast<double>(row.index) + row.rest) / height});
      map_x_[i] = d.x;
      map_y_[i] = d.y;
      map_z_[i] = d.z;
    }
  }

  /// Point sets that are no worse than strata, by the map's table and by the material's lobes.
  void add_strata(const ShadingPoint& at, ErrorsAt& errors) const {
    std::vector<double> values(kStrataPoints);
    reflected_cosines(material_, at, {map_x_, map_y_, map_z_}, values);
    for (double& value : values) value *= summary_->light;
    add_sets("environment B", variances_inside(values), errors);

    std::vector<double> x(kStrataPoints);
    std::vector<double> y(kStrataPoints);
    std::vector<double> z(kStrataPoints);
    std::vector<double> pdf(kStrataPoints);
    sample_material(material_, at, strata_s_, strata_t_, {x, y, z, pdf, values});
    std::vector<double> s(kStrataPoints);
    std::vector<double> t(kStrataPoints);
    approximate_positions(x, y, z, {s, t});
    const Extent extent = summary_->finest.extent();
    for (std::size_t i = 0; i < kStrataPoints; ++i) {
      const auto luminance = static_cast<double>(
          summary_->finest(cell_of(s[i], extent.width), cell_of(t[i], extent.height)));
      values[i] = pdf[i] > 0.0 ? values[i] * luminance / pdf[i] : 0.0;
    }
    add_sets("brdf", variances_inside(values), errors);
  }

  static void add_sets(const std::string& base, const StrataVariances& inside, ErrorsAt& errors) {
    ErrorAt error = errors.find(base)->second;
    error.law = ErrorLaw::at_most;
    error.inside = inside;
    for (const std::string_view set : kPointSets) {
      errors.emplace(base + std::string(set), error);
    }
  }

  static void biased(std::string_view name, double estimate, const ScatteredLight& light,
                     ErrorsAt& errors) {
    errors.emplace(name, ErrorAt{ErrorLaw::constant, 0.0, estimate - light.mean});
  }

  void add_lights(const ScatteredLight& light, const ShadingPoint& at, ErrorsAt& errors) const {
    for (std::size_t cut = 0; cut < summary_->lights.size(); ++cut) {
      const auto& lights = summary_->lights[cut];
      double sum = 0.0;
      for (const DirectedLight& each : lights) {
        const double k = std::visit(
            [&](const auto& surface) {
              return surface.evaluate(at, each.direction).reflected_cosine;
            },
            material_);
        sum += k * luminance_of(Rgb(each.flux), summary_->weights);
      }
      biased("median cut " + std::to_string(1 << MapSummary::kCuts[cut]), sum, light, errors);
    }
  }

  void add_look_ups(const ScatteredLight& light, const ShadingPoint& at, const LobeReach& lobe,
                    ErrorsAt& errors) const {
    const Direction normal = at.frame.normal;
    const auto diffuse = [&] {
      return looked_up(kTabulatedNormals, normal, [&](Direction centre, const Tap& /*tap*/) {
        return diffuse_radiance(light.nodes, centre);
      });
    };
    const std::array<double, 1> cosine = {glm::dot(at.view, normal)};
    if (const auto* lambert = std::get_if<Lambert>(&material_)) {
      biased("sh-9", lambert->albedo * harmonic_radiance(*summary_, normal), light, errors);
      biased("tabulated irradiance", lambert->albedo * diffuse(), light, errors);
    } else if (const auto* ggx = std::get_if<Ggx>(&material_)) {
      double sum = 0.0;
      for (const Level& level : chain_)
        sum += level.share * chain_value(level, light, lobe.place.axis);
      biased("split-sum", sum * reflected_of_white_sky(*ggx, cosine).front(), light, errors);
    } else if (const auto* phong = std::get_if<ModifiedPhong>(&material_)) {
      const PhongLobe wanted = prefilter_lobe(*phong);
      const double glossy = looked_up(
          prefilter_extent(wanted), lobe.place.axis, [&](Direction centre, const Tap& /*tap*/) {
            return light_under(ModifiedPhong{0.0, 1.0, wanted.exponent}, centre, light.nodes,
                               [](double pdf, double /*cosine*/) { return pdf; });
          });
      biased("prefiltered phong",
             phong->diffuse * diffuse() +
                 phong->specular * reflected_of_white_sky(*phong, cosine).front() * glossy,
             light, errors);
    }
  }

  double chain_value(const Level& level, const ScatteredLight& light, Direction axis) const {
    return looked_up(level.extent, axis, [&](Direction centre, const Tap& tap) {
      if (!level.lobe) return mean_over(*summary_, level.extent, tap);
      return light_under(*level.lobe, centre, light.nodes,
                         [&](double pdf, double cosine) { return pdf * cosine / level.norm; });
    });
  }

  void add_outgoing(const ScatteredLight& light, const ShadingPoint& at, ErrorsAt& errors) const {
    const ShadingPoint entry = outgoing_table_point(at);
    const ScatteredLight there =
        scattered(*summary_, material_, entry, lobe_of(material_, entry), Direction(0.0));
    const Combined sums = combine(there, compensated(*summary_, 0.0), Heuristic::balance);
    const double variance = variance_of(sums, there, true) / kOutgoingTableSamples;
    errors.emplace("outgoing table",
                   ErrorAt{ErrorLaw::constant, variance, there.mean - light.mean});
  }

  const MapSummary* summary_;
  Material material_;
  TexelDirections product_nodes_;
  TexelDirections quadrant_centres_;
  std::vector<Level> chain_;
  std::vector<double> strata_s_ = std::vector<double>(kStrataPoints);
  std::vector<double> strata_t_ = std::vector<double>(kStrataPoints);
  std::vector<double> map_x_ = std::vector<double>(kStrataPoints);
  std::vector<double> map_y_ = std::vector<double>(kStrataPoints);
  std::vector<double> map_z_ = std::vector<double>(kStrataPoints);
};

/// The estimator that draws from the same density at random points; empty if it is none of points.
std::string_view without_points(std::string_view name) {
  for (const std::string_view set : kPointSets) {
    if (name.ends_with(set)) return name.substr(0, name.size() - set.size());
  }
  return {};
}

std::string reason_for(std::string_view name) {
  if (name == "light sets") return "sets that are drawn beforehand are not known before they are";
  if (name == "riemann") return "its error depends on where its steps fall";
  if (name == "filtered importance sampling") {
    return "its blur depends on the number of samples and on their densities";
  }
  return "there is no formula for it";
}

}  // namespace

double PredictedError::variance_of(std::uint64_t samples) const {
  if (!(inside.front() > 0.0)) return variance;
  const double missed = std::max(0.0, variance - inside.front());
  return std::min(variance, missed + inside[strata_grid_of(samples)]);
}

double PredictedError::at(std::uint64_t samples) const {
  const double count = law == ErrorLaw::constant ? 1.0 : static_cast<double>(samples);
  return std::sqrt(bias * bias + variance_of(samples) / count);
}

const EstimatorPrediction* Prediction::find(std::string_view estimator) const {
  const auto found = std::ranges::find(estimators, estimator, &EstimatorPrediction::estimator);
  return found == estimators.end() ? nullptr : &*found;
}

Prediction predict(const MapSummary& summary, const Material& material,
                   std::span<const ShadingPoint> points) {
  Prediction prediction;
  std::vector<ErrorsAt> errors(points.size());
  std::vector<double> means(points.size());
  if (summary.has_light()) {
    const Predictor predictor(summary, material);
    parallel_for(points.size(),
                 [&](std::size_t i) { means[i] = predictor.predict(points[i], errors[i]); });
  }
  const auto count = static_cast<double>(points.size());
  for (const double mean : means) prediction.mean += mean / count;
  for (const EstimatorInfo& info : estimators()) {
    if (!info.serves(material)) continue;
    EstimatorPrediction row = {info.name, {}, {}};
    const std::string_view base = without_points(info.name);
    const bool has_own = base.empty() || (!errors.empty() && errors.front().contains(info.name));
    const std::string_view known = has_own ? info.name : base;
    if (!(prediction.mean > 0.0)) {
      row.reason = "no light is reflected";
    } else if (!errors.front().contains(known)) {
      row.reason = reason_for(info.name);
    } else {
      PredictedError sum;
      for (const ErrorsAt& at : errors) {
        const ErrorAt& error = at.find(known)->second;
        sum.law = base.empty() ? error.law : ErrorLaw::at_most;
        sum.variance += error.variance;
        sum.bias += error.bias * error.bias;
        for (std::size_t i = 0; i < kStrataGrids; ++i) sum.inside[i] += error.inside[i];
      }
      for (double& inside : sum.inside) inside /= count * prediction.mean * prediction.mean;
      sum.variance /= count * prediction.mean * prediction.mean;
      sum.bias = std::sqrt(sum.bias / count) / prediction.mean;
      row.error = sum;
    }
    prediction.estimators.push_back(std::move(row));
  }
  return prediction;
}

}  // namespace lightproof
