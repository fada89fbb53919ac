// Measures time and error of estimators, for the chart of speed against accuracy.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/accuracy/lit_receiver.h"
#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/accuracy_chart.h"

namespace lightproof {

/// How thoroughly a chart is measured.
struct AccuracyQuality {
  std::string_view name;
  std::uint64_t most_samples;  ///< the largest N; measured are N = 1, 4, 16, … up to it
  int rounds;                  ///< of all estimators, one after the other; at least 3
  int shading_points;  ///< at least so many, the visible pixels of the smallest such picture
};

/// All qualities: draft, default, paper.
std::span<const AccuracyQuality> accuracy_qualities();

/// The quality of this name. Throws InputError, which lists the names, if there is none.
const AccuracyQuality& accuracy_quality_by_name(std::string_view name);

/// What is measured.
struct AccuracyOptions {
  AccuracyQuality quality = accuracy_qualities()[0];
  std::uint64_t seed = 1;
  /// What the errors are for; another purpose has other random numbers. Empty: a chart.
  std::string_view purpose = {};
  /// Which estimators are charted; empty: all that serve the material.
  EstimatorFilter select = {};
  /// The numbers of samples at which an estimator is measured, ascending; empty: those of the
  /// quality.
  std::function<std::vector<std::uint64_t>(const EstimatorInfo&)> samples = {};
  /// Samples that a round spends at one point on each of the smaller numbers of samples, and the
  /// most estimates that it makes of them.
  std::uint64_t samples_of_a_round = 256;
  std::uint64_t most_estimates_of_a_round = 16;
};

/// Why an estimator is not run on maps of this size: it would take minutes; empty if it is.
std::string reason_to_leave_out(const EstimatorInfo& info, Extent map);

/// A receiver and a material that are lit by the map.
struct AccuracyScene {
  const ReceiverInfo* receiver;
  NamedMaterial material;
};

/// Charts of all estimators on a map, one a scene. All are prepared for the map first, each timed
/// alone; then the rounds follow each other, so that what slows the machine for a while slows all.
/// An estimate's time is that of its thread while all threads work. Errors depend on the seed
/// alone; neither the number of threads nor that of processes, which share the rounds, changes a
/// bit of them. What cannot serve a material, or would take minutes, is left out with its reason.
/// Throws InputError if no light reaches a receiver.
std::vector<AccuracyChart> measure_accuracy(const EnvironmentMap& map,
                                            std::span<const AccuracyScene> scenes,
                                            const AccuracyOptions& options,
                                            const Progress& progress = {},
                                            const Communicator& communicator = {});

/// The chart of a receiver that is lit already.
AccuracyChart measure_accuracy(const LitReceiver& lit, const AccuracyOptions& options,
                               const Progress& progress = {},
                               const Communicator& communicator = {});

}  // namespace lightproof
