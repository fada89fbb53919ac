// What a run of the gate found: records of tests, and what was rejected.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/results/recognition.h"
#include "lightproof/results/test_record.h"

namespace lightproof {

/// A run that was rejected, for whoever has to mend it.
struct Rejection {
  std::string sampler;
  std::string density_space;
  std::string map;
  std::string looks_like;              ///< the name of the most likely defect
  std::string diagnosis;               ///< the most likely defect in words
  Grid<double> residual;               ///< (O - E) / sqrt(E) of the 32x16 bins
  std::vector<double> row_divergence;  ///< divergence of the rows, cumulative from t = 0
  /// How sure the name is, in words; empty where nothing is named.
  std::string confidence = {};

  static auto fields(auto& rejection) {
    return std::tie(rejection.sampler, rejection.density_space, rejection.map, rejection.looks_like,
                    rejection.diagnosis, rejection.residual, rejection.row_divergence,
                    rejection.confidence);
  }
};

/// A sampler that was not tested on a map, under one density.
struct LeftOut {
  std::string sampler;
  std::string density_space;
  std::string map;
  std::string reason;  ///< what of the map's mapping does not allow it, in words

  static auto fields(auto& left_out) {
    return std::tie(left_out.sampler, left_out.density_space, left_out.map, left_out.reason);
  }
  friend bool operator==(const LeftOut&, const LeftOut&) = default;
};

/// A sampler that came from a plug-in.
struct ThirdPartySampler {
  std::string name;
  std::string options;  ///< words of the command line that name it: "--plugin ./libmine.so"

  static auto fields(auto& sampler) { return std::tie(sampler.name, sampler.options); }
};

/// What one run of the gate found.
struct GateResult {
  double family_alpha = 0.0;  ///< probability that a run over correct samplers rejects anything
  std::uint64_t samples = 0;  ///< per run; tests below the screening level get four times
  std::uint64_t seed = 0;
  std::vector<TestRecord> tests;
  std::vector<Rejection> rejections = {};
  std::string input_options = {};  ///< options of the command line for reading the maps
  std::uint64_t family = 0;        ///< p-values, or instances if sequential, that share the error
  bool sequential = false;
  std::vector<LeftOut> left_out = {};  ///< what the maps' mappings did not allow
  double must_detect = kMustDetect;    ///< deviation of the bins that had to be detectable
  /// The command line that gives the same result again, where it is not `lightproof gate` on one
  /// sampler and map.
  std::string replay = {};
  /// Of rejected samples of another program: what would make them right, the likeliest first.
  std::vector<Recognition> recognitions = {};
  std::vector<ThirdPartySampler> third_party_samplers = {};

  static auto fields(auto& gate) {
    return std::tie(gate.family_alpha, gate.samples, gate.seed, gate.tests, gate.rejections,
                    gate.input_options, gate.family, gate.sequential, gate.left_out,
                    gate.must_detect, gate.replay, gate.recognitions, gate.third_party_samplers);
  }
};

}  // namespace lightproof
