// The error that estimators will have at some shading points of a map, without running any.
//
// Nothing is in the way of light in all of this: where something is, predictions do not hold.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/materials/material.h"
#include "lightproof/recommend/map_summary.h"
#include "lightproof/recommend/strata.h"

namespace lightproof {

/// How an error follows from the number of samples.
enum class ErrorModel {
  independent,  ///< the variance over the number of samples
  at_most,      ///< no more than that, as a rule: samples that are more even than random ones
  constant,     ///< the same of any number: one look-up, or lights that were made beforehand
};

/// The error of an estimator, as the root of a mean square over shading points, bias included,
/// divided by the mean of the exact radiance over these.
struct PredictedError {
  ErrorModel model = ErrorModel::independent;
  /// Of one sample, or of one estimate if the model is constant, relative to the square of the
  /// mean. That of the outgoing table is what its filling by random points would leave, a bound:
  /// its points are more even.
  double variance = 0.0;
  double bias = 0.0;  ///< root mean square over the points
  /// Of point sets that keep strata of the square apart, the variance inside these, as it is known
  /// from few points: what these did not find of the variance of one sample is not reduced. All 0
  /// of others.
  StrataVariances inside = {};

  /// What each of so many samples adds to the variance of their mean, times their number.
  double variance_of(std::uint64_t samples) const;
  /// The error of an estimate by so many samples, at least 1.
  double at(std::uint64_t samples) const;
};

/// An estimator and its error, or why there is no prediction of it.
struct EstimatorPrediction {
  std::string_view estimator;
  std::optional<PredictedError> error;
  std::string reason;  ///< why not; empty if there is one
};

/// What is predicted of all estimators that serve a material, in the order of the registry.
struct Prediction {
  double mean = 0.0;  ///< of the exact radiance's luminance over the points
  std::vector<EstimatorPrediction> estimators;

  /// What is predicted of this estimator; a null pointer if the material does not serve it.
  const EstimatorPrediction* find(std::string_view estimator) const;
};

/// Predicts the errors at these points, of which there is at least one. Multi-sample estimators are
/// taken to have an even number of samples. Of points that reflect no light, and of a black map,
/// nothing is predicted.
Prediction predict(const MapSummary& summary, const Material& material,
                   std::span<const ShadingPoint> points);

}  // namespace lightproof
