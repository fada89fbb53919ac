#include "lightproof/recommend/prediction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "lightproof/core/parallel.h"
#include "lightproof/estimators/outgoing_table.h"
#include "lightproof/estimators/product_table.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/recommend/predicted_look_ups.h"
#include "lightproof/recommend/predicted_products.h"
#include "lightproof/recommend/predicted_strata.h"
#include "lightproof/recommend/scattered_light.h"

namespace lightproof {
namespace {

using reference::CombinedSampling;
using reference::Heuristic;
using reference::SampledDensity;

/// Of an estimator at one point: the variance of a sample, and the bias.
struct ErrorAt {
  ErrorModel model;
  double variance;
  double bias;
  StrataVariances inside = {};
};

/// By the estimator's name.
using ErrorsAt = std::map<std::string_view, ErrorAt>;

/// The density of the map after compensation, over the luminance above a floor.
struct Compensated {
  double floor = 0.0;
  double scale = 0.0;

  double pdf(double luminance) const { return std::max(0.0, luminance - floor) * scale; }
};

Compensated compensated(const MapSummary& summary, double compensation) {
  const double left = summary.light_above(compensation);
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

/// What is the same at all points.
class Predictor {
 public:
  Predictor(const MapSummary& summary, const Material& material)
      : summary_(&summary),
        material_(material),
        products_(summary, material),
        look_ups_(summary, material),
        strata_(summary, material) {
    densities_.emplace(0.0, compensated(summary, 0.0));
    for (const EstimatorInfo& info : estimators()) {
      if (!info.combined) continue;
      const double compensation = info.combined->compensation;
      densities_.try_emplace(compensation, compensated(summary, compensation));
    }
  }

  /// The errors of all estimators at a point, and the exact radiance.
  double predict(const ShadingPoint& at, ErrorsAt& errors) const {
    const LobeReach lobe = lobe_of(material_, at);
    const bool has_table_of_lobes =
        std::holds_alternative<Ggx>(material_) || std::holds_alternative<ModifiedPhong>(material_);
    const ScatteredLight light = scattered(*summary_, material_, at, lobe,
                                           has_table_of_lobes ? lobe.extent.axis : Direction(0.0));
    add_lobes(light, at, errors);
    add_tables(light, errors);
    add_combined(light, errors);
    add_products(light, at, errors);
    add_lights(light, at, errors);
    for (const auto& [estimator, luminance] : look_ups_.at(light, at, lobe.extent.axis)) {
      biased(estimator, luminance, light, errors);
    }
    add_outgoing(light, at, errors);
    add_sets("environment B", strata_.of_map(at), errors);
    add_sets("brdf", strata_.of_lobes(at), errors);
    return light.mean;
  }

 private:
  /// From E[X^2]; `whole` is the integral of the density over the nodes.
  static ErrorAt of_one_sample(double square, double mean, double whole = 1.0) {
    return {ErrorModel::independent, std::max(0.0, square - mean * mean * (2.0 - whole)), 0.0};
  }
  static void one_sample(std::string_view name, double square, double mean, ErrorsAt& errors,
                         double whole = 1.0) {
    errors.emplace(name, of_one_sample(square, mean, whole));
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
    // Caps and projected hemispheres have one density.
    const auto density_of = [](MicrofacetSampling of) {
      return of == MicrofacetSampling::spherical_caps ? MicrofacetSampling::visible_normals : of;
    };
    std::map<MicrofacetSampling, ErrorAt> known = {{density_of(ggx->sampling), errors.at("brdf")}};
    for (const EstimatorInfo& info : estimators()) {
      if (!info.microfacets) continue;
      const MicrofacetSampling sampling = density_of(*info.microfacets);
      if (!known.contains(sampling)) known.emplace(sampling, of_normals(*ggx, sampling, light, at));
      errors.emplace(info.name, known.at(sampling));
    }
  }

  /// GGX with its normals drawn in one way.
  static ErrorAt of_normals(Ggx ggx, MicrofacetSampling sampling, const ScatteredLight& light,
                            const ShadingPoint& at) {
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
    return of_one_sample(square, light.mean, whole);
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
    for (const EstimatorInfo& info : estimators()) {
      if (info.density == SampledDensity::texture_space) {
        one_sample(info.name, second[0], light.mean, errors);
      } else if (info.density == SampledDensity::solid_angle) {
        one_sample(info.name, exact, light.mean, errors);
      } else if (info.density == SampledDensity::sine_weighted) {
        one_sample(info.name, second[1], light.mean, errors);
      } else if (info.table_reduction > 1) {
        const auto reduction = std::ranges::find(kReductions, info.table_reduction);
        const auto i = static_cast<std::size_t>(reduction - kReductions.begin());
        one_sample(info.name, second.at(2 + i), light.mean, errors);
      }
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
            combine(light, densities_.at(sampling.compensation), sampling.heuristic);
        found = known.emplace(key, sums).first;
      }
      return variance_of(found->second, light, sampling.is_one_sample);
    };
    for (const EstimatorInfo& info : estimators()) {
      if (!info.combined) continue;
      errors.emplace(info.name, ErrorAt{ErrorModel::independent, variance(*info.combined), 0.0});
    }
    // What is chosen is weighed by the mean of its candidates, in luminance that of their own
    // estimates.
    const double candidate = variance({.is_one_sample = true});
    for (const EstimatorInfo& info : estimators()) {
      if (info.family != EstimatorFamily::ris) continue;
      errors.emplace(info.name, ErrorAt{ErrorModel::independent,
                                        candidate / static_cast<double>(info.candidates), 0.0});
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
    one_sample("product two-level", square_by(products_.two_level_scales(at), nodes.product),
               light.mean, errors);
    one_sample("product hierarchical", square_by(products_.quadrant_scales(at), nodes.quadrant),
               light.mean, errors);
  }

  /// Point sets that are no worse than strata.
  static void add_sets(std::string_view base, const StrataVariances& inside, ErrorsAt& errors) {
    ErrorAt error = errors.at(base);
    error.model = ErrorModel::at_most;
    error.inside = inside;
    for (const EstimatorInfo& info : estimators()) {
      if (info.at_independent_points == base) errors.emplace(info.name, error);
    }
  }

  static void biased(std::string_view name, double estimate, const ScatteredLight& light,
                     ErrorsAt& errors) {
    errors.emplace(name, ErrorAt{ErrorModel::constant, 0.0, estimate - light.mean});
  }

  void add_lights(const ScatteredLight& light, const ShadingPoint& at, ErrorsAt& errors) const {
    for (const EstimatorInfo& info : estimators()) {
      if (info.lights == 0) continue;
      const auto cut = std::ranges::find_if(
          MapSummary::kCuts, [&](int cuts) { return std::size_t{1} << cuts == info.lights; });
      const auto& lights =
          summary_->lights.at(static_cast<std::size_t>(cut - MapSummary::kCuts.begin()));
      double sum = 0.0;
      for (const DirectedLight& each : lights) {
        const double k = std::visit(
            [&](const auto& surface) {
              return surface.evaluate(at, each.direction).reflected_cosine;
            },
            material_);
        sum += k * luminance_of(Rgb(each.flux), summary_->weights);
      }
      biased(info.name, sum, light, errors);
    }
  }

  void add_outgoing(const ScatteredLight& light, const ShadingPoint& at, ErrorsAt& errors) const {
    const ShadingPoint entry = outgoing_table_point(at);
    const ScatteredLight there =
        scattered(*summary_, material_, entry, lobe_of(material_, entry), Direction(0.0));
    const Combined sums = combine(there, densities_.at(0.0), Heuristic::balance);
    const double variance = variance_of(sums, there, true) / kOutgoingTableSamples;
    errors.emplace("outgoing table",
                   ErrorAt{ErrorModel::constant, variance, there.mean - light.mean});
  }

  const MapSummary* summary_;
  Material material_;
  PredictedProducts products_;
  PredictedLookUps look_ups_;
  PredictedStrata strata_;
  std::map<double, Compensated> densities_;  ///< by what is taken off
};

/// A prediction under a name that is no row's would be one that nobody finds.
void require_rows(const ErrorsAt& errors) {
  for (const auto& [name, error] : errors) {
    if (std::ranges::find(estimators(), name, &EstimatorInfo::name) == estimators().end()) {
      throw std::logic_error("a prediction of no estimator: " + std::string(name));
    }
  }
}

}  // namespace

double PredictedError::variance_of(std::uint64_t samples) const {
  if (!(inside.front() > 0.0)) return variance;
  const double missed = std::max(0.0, variance - inside.front());
  return std::min(variance, missed + inside[strata_grid_of(samples)]);
}

double PredictedError::at(std::uint64_t samples) const {
  const double count = model == ErrorModel::constant ? 1.0 : static_cast<double>(samples);
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
    require_rows(errors.front());
  }
  const auto count = static_cast<double>(points.size());
  for (const double mean : means) prediction.mean += mean / count;
  for (const EstimatorInfo& info : estimators()) {
    if (!info.serves(material)) continue;
    EstimatorPrediction row = {info.name, {}, {}};
    const std::string_view base = info.at_independent_points;
    const bool has_own = base.empty() || (!errors.empty() && errors.front().contains(info.name));
    const std::string_view known = has_own ? info.name : base;
    if (!(prediction.mean > 0.0)) {
      row.reason = "no light is reflected";
    } else if (!errors.front().contains(known)) {
      row.reason = info.unpredicted;
    } else {
      PredictedError sum;
      for (const ErrorsAt& at : errors) {
        const ErrorAt& error = at.find(known)->second;
        sum.model = base.empty() ? error.model : ErrorModel::at_most;
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
