// Which samplers the gate tests.
#pragma once

#include <string>
#include <vector>

#include "lightproof/gate/direction_sampler.h"
#include "lightproof/gate/sampler_under_test.h"

namespace lightproof::cli {

struct SamplerChoice {
  /// Names of samplers or mutants, or of the groups "directions" and "all_directions"; empty: all
  /// that are correct, microfacets at a selection of roughnesses.
  std::vector<std::string> names;
  std::string density_space;                   ///< "A", "B", "C" or all (empty)
  bool with_published = false;                 ///< whether those with known defects are included
  bool has_maps = false;                       ///< some were named
  std::vector<SamplerUnderTest> plugins = {};  ///< tested in place of all, beside those named
};

/// What is tested: samplers of maps, which need some, and samplers of directions, which need none.
struct ChosenSamplers {
  std::vector<SamplerUnderTest> of_maps;
  std::vector<DirectionSamplerInfo> of_directions;
  std::vector<std::string> notes;  ///< what was chosen and ignored, one sentence each
};

/// Throws InputError if a name is unknown, if two samplers have one, if a plug-in does not declare
/// the density that was asked for, or if nothing that was named can make use of the maps or of the
/// density that were.
ChosenSamplers choose_samplers(const SamplerChoice& choice);

}  // namespace lightproof::cli
