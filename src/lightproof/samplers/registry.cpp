#include "lightproof/samplers/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

template <class Sampler, const LuminanceWeights& kGrey, Lookup kLookup = Lookup::nearest>
AnySampler make(const EnvironmentMap& map, Weighting weighting) {
  return Sampler(map, on_map({weighting, kGrey, kLookup}, map));
}

double scanned(Extent map) { return map.width + map.height; }
double halved(Extent map) { return std::log2(map.width) + std::log2(map.height); }
double quartered(Extent map) { return std::log2(std::max(map.width, map.height)); }
double looked_up(Extent /*map*/) { return 1.0; }

constexpr std::array<SamplerInfo, 11> kSamplers = {{
    {.name = "linear_scan_published",
     .source = "lecture \"Image-based Lighting\", GLSL listing",
     .growth = "S + T",
     .steps = scanned,
     .grey = kPublishedLuminance,
     .resolution = 0x1p-24,
     .monotone = true,
     .known_defects = true,
     .inverts_shared_cdf = false,
     .make = make<LinearScanPublished, kPublishedLuminance>},
    {.name = "linear_scan",
     .source = "the lecture's scan, corrected, over stored sums",
     .growth = "S + T",
     .steps = scanned,
     .grey = kRec709,
     .resolution = 0x1p-31,
     .monotone = true,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<LinearScan, kRec709>},
    {.name = "binary_search",
     .source = "bisection of the same sums (Knuth, TAOCP 3, 6.2.1)",
     .growth = "log2 S + log2 T",
     .steps = halved,
     .grey = kRec709,
     .resolution = 0x1p-31,
     .monotone = true,
     .known_defects = false,
     .inverts_shared_cdf = true,
     .make = make<BinarySearch, kRec709>},
    {.name = "eytzinger",
     .source = "descent of the same sums in breadth-first order (Khuong and Morin 2017)",
     .growth = "log2 S + log2 T",
     .steps = halved,
     .grey = kRec709,
     .resolution = 0x1p-31,
     .monotone = true,
     .known_defects = false,
     .inverts_shared_cdf = true,
     .make = make<Eytzinger, kRec709>},
    {.name = "guide_table",
     .source = "guide table (Chen and Asau 1974), then bisection of the same sums",
     .growth = "1",
     .steps = looked_up,
     .grey = kRec709,
     .resolution = 0x1p-31,
     .monotone = true,
     .known_defects = false,
     .inverts_shared_cdf = true,
     .make = make<GuideTable, kRec709>},
    {.name = "guide_lines",
     .source = "guide table to a run of 32 texels, then its 16-bit sums",
     .growth = "1",
     .steps = looked_up,
     .grey = kRec709,
     .resolution = 0.0,
     .monotone = true,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<GuideLines, kRec709>},
    {.name = "alias",
     .source = "alias method (Walker 1974), 16 bytes a texel",
     .growth = "1",
     .steps = looked_up,
     .grey = kRec709,
     .resolution = 0.0,
     .monotone = false,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<Alias, kRec709>},
    {.name = "packed_alias",
     .source = "alias method, 8 bytes a texel with a palette of probabilities",
     .growth = "1",
     .steps = looked_up,
     .grey = kRec709,
     .resolution = 0.0,
     .monotone = false,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<PackedAlias, kRec709>},
    {.name = "alias_lines",
     .source = "alias method over runs of 32 texels, then their 16-bit sums",
     .growth = "1",
     .steps = looked_up,
     .grey = kRec709,
     .resolution = 0.0,
     .monotone = false,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<AliasLines, kRec709>},
    {.name = "hierarchical",
     .source = "quarter by quarter, by their sums (Clarberg et al. 2005)",
     .growth = "log2 max(S, T)",
     .steps = quartered,
     .grey = kRec709,
     .resolution = 0.0,
     .monotone = true,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<Hierarchical, kRec709>},
    {.name = "bilinear",
     .source = "the bilinear look-up itself: guide table to a patch between four centres, inverted",
     .growth = "1",
     .steps = looked_up,
     .grey = kRec709,
     .lookup = Lookup::bilinear,
     .resolution = 0x1p-31,
     .monotone = true,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<Bilinear, kRec709, Lookup::bilinear>},
}};

}  // namespace

std::span<const SamplerInfo> samplers() { return kSamplers; }

const SamplerInfo& sampler_by_name(std::string_view name) {
  std::string known;
  for (const SamplerInfo& info : kSamplers) {
    if (info.name == name) return info;
    known += fmt::format(" {}", info.name);
  }
  throw InputError(fmt::format("no sampler is called '{}'; there are:{}", name, known));
}

}  // namespace lightproof
