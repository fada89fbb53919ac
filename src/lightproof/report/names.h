// Names of the files beside the report, and words that several sections share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightproof/results/render_record.h"

namespace lightproof {

/// What a ratio of wall time to processor time says of the machine: "quiet", or "busy, 1.4" with
/// the ratio.
std::string machine_words(double wall_per_cpu);

/// A text as part of a file's name: with everything but ASCII letters, digits, '.', '_' and '-'
/// replaced by '_', and without leading dots: safe in any folder and in a URL. Never empty.
std::string file_name_part(std::string_view text);

/// The stems of the renders' file names, "MAP-RECEIVER-MATERIAL-ESTIMATOR", all different:
/// a repeated one gets "-2", "-3", …
std::vector<std::string> render_stems(const std::vector<RenderRecord>& renders);

/// The renders of one receiver on one map with one material; they share the reference.
struct RenderScene {
  std::string stem;                  ///< "MAP-RECEIVER-MATERIAL", unique
  std::vector<std::size_t> members;  ///< positions in the list of renders; never empty
};

/// The records of a scene, in their order.
std::vector<const RenderRecord*> members_of(const RenderScene& scene,
                                            const std::vector<RenderRecord>& renders);

/// The scenes of renders, in the order of their first appearance.
std::vector<RenderScene> render_scenes(const std::vector<RenderRecord>& renders);

}  // namespace lightproof
