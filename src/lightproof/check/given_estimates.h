// What the densities and weights that come with a dump say of themselves: 1/pdf adds up to the
// solid angle, L/pdf and the weights add up to the light, and no light is left out. No density need
// be declared for that.
//
// Texels are counted in blocks, and what is exact of a block is a sum over its texels. The first
// fifth of the samples shows which texels are drawn at all, and how small densities are there; the
// rest is tested. Means that are too large are found whatever the tails are. One that is too small
// may only have missed rare, large values: it is tested over the texels that the first fifth found,
// in which no value is taken to be more than four times the largest that was found in the block.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lightproof/dump/sample_dump.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/results/gate_result.h"
#include "lightproof/results/test_record.h"

namespace lightproof {

/// What is asked of the densities and weights of a dump.
struct EstimateClaim {
  std::string name;         ///< what the dump goes by in records
  std::string density;      ///< label of the declared density; empty if none is
  bool judges_pdf = false;  ///< whether 1/pdf, L/pdf and what is left out are judged
  double tolerance = 1e-4;  ///< of a weight that should be L/pdf, relative
};

/// How they are judged.
struct EstimateOptions {
  double alpha = 1e-6;  ///< probability that a right dump is rejected
  double must_detect = kMustDetect;
  std::uint64_t seed = 1;  ///< is written into records; nothing is drawn
};

/// What was found out.
struct EstimateFindings {
  std::vector<TestRecord> tests;
  std::vector<Rejection> rejections;  ///< one if any test rejects
};

/// Judges the densities of a dump (if that is asked for; it must have them) and its weights (if it
/// has them) on a map, whose luminance the light is; `colours` is the map of coloured weights. Both
/// have one mapping and size.
EstimateFindings judge_estimates(const SampleDump& dump, const EnvironmentMap& map,
                                 const EnvironmentMap& colours, const EstimateClaim& claim,
                                 const EstimateOptions& options);

}  // namespace lightproof
