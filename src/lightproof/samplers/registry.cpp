#include "lightproof/samplers/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/core/out_of_memory.h"

namespace lightproof {
namespace {

/// "sun-sky (512x256)".
std::string text_of(const EnvironmentMap& map) {
  return fmt::format("{} ({}x{})", map.name, map.radiance.extent().width,
                     map.radiance.extent().height);
}

void refuse_undeclared(const EnvironmentMap& map, TargetDensity target) {
  const std::string_view reason = why_not_declared(target, map.mapping);
  if (reason.empty()) return;
  throw InputError(fmt::format("{}: density {} on texels of mapping {}: {}", map.name,
                               to_string(target.density_space), describe(map.mapping), reason));
}

template <class Sampler, const LuminanceWeights& kWeights, Lookup kLookup = Lookup::nearest>
AnySampler make(const EnvironmentMap& map, DensitySpace density_space) {
  return with_memory_for([&] { return "the table of a sampler of " + text_of(map); },
                         [&]() -> AnySampler {
                           const TargetDensity target = {density_space, kWeights, kLookup};
                           refuse_undeclared(map, target);
                           return Sampler(map, on_map(target, map));
                         });
}

AnySampler make_published_as_listed(const EnvironmentMap& map, DensitySpace density_space) {
  return LinearScanPublished::as_listed(
      map, on_map({density_space, kPublishedLuminance, Lookup::nearest}, map));
}

double linear_steps(Extent map) { return map.width + map.height; }
double binary_steps(Extent map) { return std::log2(map.width) + std::log2(map.height); }
double quadtree_steps(Extent map) { return std::log2(std::max(map.width, map.height)); }
double constant_steps(Extent /*map*/) { return 1.0; }

MassRounding summed_in_31_bits(Extent map) { return rounding_of_sums(map, 0x1p-31); }
/// Runs as above; inside of them 16 bits, likewise.
MassRounding of_runs(Extent map) {
  MassRounding rounding = summed_in_31_bits(map);
  rounding.relative += kRunTexels * 0x1p-16;
  rounding.of_run = 2.0 * 0x1p-16;
  return rounding;
}
/// One unit of 2^-32 of the average and at most that for what is left over; masses kept as floats.
MassRounding of_alias(Extent /*map*/) { return {.relative = 0x1p-23, .of_average = 0x1p-31}; }
MassRounding of_alias_runs(Extent map) {
  MassRounding rounding = of_runs(map);
  rounding.of_sums = 0.0;
  // A run's unit is 2^-32 of an average run, which is as many texels.
  rounding.of_average = kRunTexels * 0x1p-31;
  rounding.relative += 0x1p-23;
  return rounding;
}
/// Units of the threshold's bits, and a palette of 65536 masses over at most 64 binary orders of
/// magnitude, 1024 of them kept for the brightest texels: at least 9 digits.
MassRounding of_palette(Extent map) {
  const double unit = PackedAliasLayout(map.count()).unit;
  return {.relative = 0x1p-8 + unit, .of_average = 2.0 * unit};
}
/// Every level adds and divides floats.
MassRounding of_levels(Extent map) {
  return {.relative = 0x1p-22 * (2.0 + std::log2(std::max(map.width, map.height)))};
}

constexpr auto kSamplers = std::to_array<SamplerInfo>({
    {.name = "linear_scan_published",
     .source = "lecture \"Image-based Lighting\", GLSL listing",
     .growth = "S + T",
     .steps = linear_steps,
     .weights = kPublishedLuminance,
     .resolution = 0x1p-24,
     .rounding = rounding_of_float_sums,
     .monotone = true,
     .known_defects = true,
     .inverts_shared_cdf = false,
     .make = make<LinearScanPublished, kPublishedLuminance>,
     .make_as_listed = make_published_as_listed},
    {.name = "linear_scan",
     .source = "the lecture's scan, corrected, over stored sums",
     .growth = "S + T",
     .steps = linear_steps,
     .weights = kRec709,
     .resolution = 0x1p-31,
     .rounding = summed_in_31_bits,
     .monotone = true,
     .inverts_rows = true,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<LinearScan, kRec709>},
    {.name = "binary_search",
     .source = "bisection of the same sums (Knuth, TAOCP 3, 6.2.1)",
     .growth = "log2 S + log2 T",
     .steps = binary_steps,
     .weights = kRec709,
     .resolution = 0x1p-31,
     .rounding = summed_in_31_bits,
     .monotone = true,
     .inverts_rows = true,
     .known_defects = false,
     .inverts_shared_cdf = true,
     .make = make<BinarySearch, kRec709>},
    {.name = "eytzinger",
     .source = "descent of the same sums in breadth-first order (Khuong and Morin 2017)",
     .growth = "log2 S + log2 T",
     .steps = binary_steps,
     .weights = kRec709,
     .resolution = 0x1p-31,
     .rounding = summed_in_31_bits,
     .monotone = true,
     .inverts_rows = true,
     .known_defects = false,
     .inverts_shared_cdf = true,
     .make = make<Eytzinger, kRec709>},
    {.name = "guide_table",
     .source = "guide table (Chen and Asau 1974), then bisection of the same sums",
     .growth = "1",
     .steps = constant_steps,
     .weights = kRec709,
     .resolution = 0x1p-31,
     .rounding = summed_in_31_bits,
     .monotone = true,
     .inverts_rows = true,
     .known_defects = false,
     .inverts_shared_cdf = true,
     .make = make<GuideTable, kRec709>},
    {.name = "guide_lines",
     .source = "guide table to a run of 32 texels, then its 16-bit sums",
     .growth = "1",
     .steps = constant_steps,
     .weights = kRec709,
     .resolution = 0.0,
     .rounding = of_runs,
     .monotone = true,
     .inverts_rows = true,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<GuideLines, kRec709>},
    {.name = "alias",
     .source = "alias method (Walker 1974), 16 bytes a texel",
     .growth = "1",
     .steps = constant_steps,
     .weights = kRec709,
     .resolution = 0.0,
     .rounding = of_alias,
     .monotone = false,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<Alias, kRec709>},
    {.name = "packed_alias",
     .source = "alias method, 8 bytes a texel with a palette of probabilities",
     .growth = "1",
     .steps = constant_steps,
     .weights = kRec709,
     .resolution = 0.0,
     .rounding = of_palette,
     .monotone = false,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<PackedAlias, kRec709>},
    {.name = "alias_lines",
     .source = "alias method over runs of 32 texels, then their 16-bit sums",
     .growth = "1",
     .steps = constant_steps,
     .weights = kRec709,
     .resolution = 0.0,
     .rounding = of_alias_runs,
     .monotone = false,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<AliasLines, kRec709>},
    {.name = "hierarchical",
     .source = "quarter by quarter, by their sums (Clarberg et al. 2005)",
     .growth = "log2 max(S, T)",
     .steps = quadtree_steps,
     .weights = kRec709,
     .resolution = 0.0,
     .rounding = of_levels,
     .monotone = true,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<Hierarchical, kRec709>},
    {.name = "bilinear",
     .source = "the bilinear look-up itself: guide table to a patch between four centres, inverted",
     .growth = "1",
     .steps = constant_steps,
     .weights = kRec709,
     .lookup = Lookup::bilinear,
     .resolution = 0x1p-31,
     .rounding = summed_in_31_bits,
     .monotone = true,
     .inverts_rows = true,
     .known_defects = false,
     .inverts_shared_cdf = false,
     .make = make<Bilinear, kRec709, Lookup::bilinear>},
});

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
