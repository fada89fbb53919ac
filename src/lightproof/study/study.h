// The main job: everything Lightproof can say about a set of maps.
#pragma once

#include <optional>
#include <vector>

#include "lightproof/accuracy/measurement.h"
#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/unfinished_work.h"
#include "lightproof/gate/gate.h"
#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/results/study_result.h"
#include "lightproof/study/convergence.h"
#include "lightproof/study/renders.h"
#include "lightproof/study/throughput.h"

namespace lightproof {

/// What a study measures.
struct StudyOptions {
  GateOptions gate;
  std::vector<SamplerUnderTest> samplers = all_samplers_under_test();  ///< that the gate tests
  ConvergenceOptions convergence;
  RenderOptions renders;
  /// What is charted of speed against accuracy on every map; no scene: nothing.
  AccuracyOptions accuracy;
  std::vector<AccuracyScene> accuracy_scenes;
  /// The error for which a method is recommended in each of these scenes; none: nothing is.
  std::optional<double> recommended_error = 0.05;
  /// Where throughput is measured; none: it is left out.
  std::optional<ThroughputSource> throughput;
  /// Where is kept what no map changes: the gate's first stage of warps and materials, and what
  /// estimators take.
  MeasurementCache cache = {};
};

/// A map, resampled to latitude and longitude if it is not there, its figures, and some hundred
/// points that binary_search draws from it.
MapRecord describe_map(EnvironmentMap map, std::uint64_t seed);

/// Puts what is recommended on the map in each scene into the study, and where no method reaches
/// the error that. `options` has an error.
void recommend_methods(const EnvironmentMap& map, const StudyOptions& options,
                       const Progress& progress, StudyResult& result);

/// Puts what was measured into the study, and how it grows.
void set_throughput(StudyResult& study, Throughput measured);

/// Runs the gate, measures convergence, speed against accuracy, renders, the error of the split sum
/// and, if it is asked for, throughput. The gate judges samplers in the maps' own texels; all else
/// takes maps that are resampled to latitude and longitude, and results say which. What ends is
/// kept in `unfinished`, map by map and stage by stage, the tests of the gate and the lines of
/// convergence one by one; what it holds is not measured again.
StudyResult run_study(std::vector<EnvironmentMap> maps, const StudyOptions& options,
                      const Progress& progress = {}, const UnfinishedWork& unfinished = {});

}  // namespace lightproof
