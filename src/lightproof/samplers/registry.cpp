#include "lightproof/samplers/registry.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

template <class Sampler, const LuminanceWeights& kGrey>
AnySampler make(const EnvironmentMap& map, Weighting weighting) {
  return Sampler(map, TargetDensity{weighting, kGrey});
}

double scanned(Extent map) { return map.width + map.height; }
double halved(Extent map) { return std::log2(map.width) + std::log2(map.height); }

constexpr std::array<SamplerInfo, 3> kSamplers = {{
    {"linear_scan_published", "lecture \"Image-based Lighting\", GLSL listing", "S + T", scanned,
     kPublishedLuminance, 0x1p-24, true, false, make<LinearScanPublished, kPublishedLuminance>},
    {"linear_scan", "the lecture's scan, corrected, over stored sums", "S + T", scanned, kRec709,
     0x1p-31, false, false, make<LinearScan, kRec709>},
    {"binary_search", "bisection of the same sums (Knuth, TAOCP 3, 6.2.1)", "log2 S + log2 T",
     halved, kRec709, 0x1p-31, false, true, make<BinarySearch, kRec709>},
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
