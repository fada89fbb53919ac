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

/// An estimator that is ready for a map, a scene and a material, which must outlive it. Many
/// threads may call it.
struct BoundEstimator {
  /// The radiance that a point reflects to where it is seen from: ∫ L f_r (n·l)+ V d(omega), in the
  /// unit of the map. `each` may be empty; an estimate that is no mean of independent ones never
  /// calls it.
  std::function<Rgb(const ShadingPoint& at, const RandomStream& stream, Budget budget,
                    const EachEstimate& each)>
      integrate;
};

/// What an estimator keeps of a map, which must outlive it: tables, or a map computed beforehand.
/// The time that it takes to make is the estimator's set-up time.
struct PreparedEstimator {
  std::function<BoundEstimator(const Scene& scene, const Material& material)> bind;
  std::size_t bytes = 0;  ///< memory that it takes beside the map itself
};

/// How an estimate comes about.
enum class EstimatorKind {
  one_sample,     ///< each sample from the one density; independent
  multi_sample,   ///< each estimate from samples of several densities, weighted; independent
  point_set,      ///< samples that depend on each other: stratified, low-discrepancy
  deterministic,  ///< no random numbers
  precomputed,    ///< a look-up in what was computed beforehand
};

/// The name of a kind: "one-sample", "multi-sample", "point-set", "deterministic", "precomputed".
std::string_view to_string(EstimatorKind kind);

/// A row of the registry of estimators.
struct EstimatorInfo {
  std::string_view name;         ///< "environment B"
  std::string_view description;  ///< how its directions come about
  std::string_view source;       ///< paper, book or lecture, with the equation
  EstimatorKind kind = EstimatorKind::one_sample;
  bool is_biased = false;
  /// The density whose exact moments are those of its single estimates; none if they are not known.
  std::optional<reference::SampledDensity> density = {};
  PreparedEstimator (*prepare)(const EnvironmentMap& map) = nullptr;
};

}  // namespace lightproof
