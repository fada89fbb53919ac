// The files of skeletons, as they lie in the source tree. Private to the module.
#pragma once

#include <string_view>
#include <vector>

namespace lightproof {

struct SkeletonSource {
  std::string_view path;  ///< "c/sampler.c", or "lightproof_plugin.h"
  std::string_view text;  ///< with `@NAME@` in place of the sampler's name
};

const std::vector<SkeletonSource>& skeleton_sources();

}  // namespace lightproof
