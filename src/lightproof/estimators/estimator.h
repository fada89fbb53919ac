// What an estimator of reflected light is, whatever is inside: samples of one density or of
// several, points that are not random, a map that was computed beforehand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "lightproof/core/random.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/materials/material.h"
#include "lightproof/render/scene.h"
#include "lightproof/results/estimator_family.h"
#include "reference/combined_moments.h"
#include "reference/estimator_moments.h"

namespace lightproof {

/// The points of a stream that one call may use: `samples` of them from `first` on. To an estimator
/// whose points are its own, `samples` says how many it may use.
struct Budget {
  std::uint64_t first = 0;
  std::uint64_t samples = 1;  ///< how many, at least 1
};

/// A callback that is shown the independent estimates of one distribution whose mean an estimate
/// is, in order, some at a time.
using EachEstimate = std::function<void(std::span<const Rgb> estimates)>;

/// An estimator that is ready for a map, a scene and a material. Map and scene must outlive it.
/// Many threads may call it.
struct BoundEstimator {
  /// The radiance that a point reflects to where it is seen from: ∫ L f_r (n·l)+ V d(omega), in the
  /// unit of the map. `each` may be empty; an estimate that is no mean of independent ones never
  /// calls it.
  std::function<Rgb(const ShadingPoint& at, const RandomStream& stream, Budget budget,
                    const EachEstimate& each)>
      integrate;
  /// Memory that it takes for the material, beside what was prepared for the map.
  std::size_t bytes = 0;
};

/// What an estimator keeps of a map, which must outlive it: tables, or a map computed beforehand.
/// The estimator's set-up time is that of making this and of binding it; what is set up anew for
/// every shading point is part of integrate()'s.
struct PreparedEstimator {
  /// Throws InputError if the estimator does not serve the material.
  std::function<BoundEstimator(const Scene& scene, const Material& material)> bind;
  std::size_t bytes = 0;  ///< memory that it takes beside the map itself
};

/// How an estimate comes about.
enum class EstimatorKind {
  one_sample,     ///< each sample from the one density; independent
  multi_sample,   ///< each estimate from samples of several densities, weighted; independent
  resampled,      ///< each sample chosen of several candidates; independent
  point_set,      ///< samples that depend on each other: stratified, low-discrepancy
  deterministic,  ///< no random numbers
  precomputed,    ///< a look-up in what was computed beforehand
};

/// The name of a kind: "one-sample", "multi-sample", "resampled", "point-set", "deterministic",
/// "precomputed".
std::string_view to_string(EstimatorKind kind);

/// Serves every material.
constexpr bool serves_all(const Material& /*material*/) { return true; }

/// A row of the registry of estimators.
struct EstimatorInfo {
  std::string_view name;         ///< "environment B"
  std::string_view description;  ///< how its directions come about
  std::string_view source;       ///< paper, book or lecture, with the equation
  EstimatorFamily family = EstimatorFamily::uniform;
  EstimatorKind kind = EstimatorKind::one_sample;
  bool is_biased = false;
  /// Whether a bias goes to zero with more samples, so that there is no floor.
  bool bias_vanishes = false;
  /// The density whose exact moments are those of its single estimates; none if they are not known.
  std::optional<reference::SampledDensity> density = {};
  /// How it combines the densities of material and map, if its exact mean and variance follow from
  /// that.
  std::optional<reference::CombinedSampling> combined = {};
  /// The density per steradian with which it draws a direction, if it is a mean over independent
  /// samples of one density that is none of `density`'s. The direction is above the surface.
  double (*pdf)(const Material& material, const ShadingPoint& at, Direction direction) = nullptr;
  /// The density per steradian with which it draws a direction, at a position in the square of
  /// latitude and longitude, if that depends on the map alone and is none of `density`'s. The
  /// function that is returned refers to nothing outside of it.
  std::function<PerSteradian(SquarePoint)> (*map_pdf)(const EnvironmentMap& map) = nullptr;
  /// The row that draws the same at independent points; empty for one whose points are.
  std::string_view at_independent_points = {};
  /// Samples of the budget that make one of the independent estimates that are shown; budgets that
  /// are no multiple of it show none.
  std::uint64_t samples_per_estimate = 1;
  /// By how much its table of the map is smaller than the map, along either side.
  int table_reduction = 1;
  /// How it draws GGX's microfacets, whatever the material says; none if it does not do so.
  std::optional<MicrofacetSampling> microfacets = {};
  /// How many lights stand for the map; 0 if it has none.
  std::size_t lights = 0;
  /// Directions that are drawn for each sample of the budget.
  std::uint64_t candidates = 1;
  /// Whether every shading point needs a set-up that takes as long as one of the map.
  bool tabulates_each_point = false;
  /// Whether it takes nothing to be in the way of light: it is wrong where something is.
  bool ignores_occlusion = false;
  /// Whether the budget is without meaning to it: one estimate costs what it costs.
  bool ignores_budget = false;
  /// Why its error on a map is not predicted; empty of those of which it is.
  std::string_view unpredicted = {};
  /// Whether studies measure how it converges, if its moments are known.
  bool is_studied = false;
  /// Whether it is shown where not all estimators are, as in pictures.
  bool is_representative = false;
  /// Whether it can be used for a material. Binding to one that it cannot serve throws InputError.
  bool (*serves)(const Material& material) = serves_all;
  /// Makes what prepare() gives, of a map in texels of latitude and longitude.
  PreparedEstimator (*make)(const EnvironmentMap& map) = nullptr;

  /// What it keeps of a map, whose texels must be those of latitude and longitude. Throws
  /// InputError if they are not, or if it draws from the map and the map is black.
  PreparedEstimator prepare(const EnvironmentMap& map) const;
};

}  // namespace lightproof
