// Every environment-map sampler, once. Tests, benchmarks, command line and report iterate over
// this table; a new sampler is a file pair, a variant name and a row.
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "lightproof/samplers/alias.h"
#include "lightproof/samplers/alias_lines.h"
#include "lightproof/samplers/bilinear.h"
#include "lightproof/samplers/binary_search.h"
#include "lightproof/samplers/eytzinger.h"
#include "lightproof/samplers/guide_lines.h"
#include "lightproof/samplers/guide_table.h"
#include "lightproof/samplers/hierarchical.h"
#include "lightproof/samplers/linear_scan.h"
#include "lightproof/samplers/linear_scan_published.h"
#include "lightproof/samplers/mass_rounding.h"
#include "lightproof/samplers/packed_alias.h"

namespace lightproof {

/// One of all environment-map samplers. Visit it once per batch, outside the loop.
using AnySampler =
    std::variant<LinearScanPublished, LinearScan, BinarySearch, Eytzinger, GuideTable, GuideLines,
                 Alias, PackedAlias, AliasLines, Hierarchical, Bilinear>;

/// What is known of a sampler.
struct SamplerInfo {
  std::string_view name;
  std::string_view source;   ///< paper or lecture
  std::string_view growth;   ///< steps of one sample on a map of S x T texels, up to a constant
  double (*steps)(Extent);   ///< number of steps of one sample on a map of this extent
  LuminanceWeights weights;  ///< the luminance that the sampler declares; Rec. 709: the map's own
  Lookup lookup = Lookup::nearest;  ///< the look-up whose density it declares
  /// Step of the sums of rows and columns that the sampler searches, and of the random numbers that
  /// it reads; 0 if it searches no such sums.
  double resolution;
  MassRounding (*rounding)(Extent map);  ///< what it declares of the probabilities of texels
  bool monotone;              ///< rows in u.t and columns of a row in u.s: it keeps stratification
  bool inverts_rows = false;  ///< u.t alone, all its 53 bits, gives the row and the share of it
  bool known_defects;         ///< kept as published, to show what the gate finds
  bool inverts_shared_cdf;    ///< must return the texel of LinearScan for every point
  /// Builds the sampler of a map, which must outlive it. Throws InputError if the map is black, or
  /// if the luminance of a texel is negative or no finite number.
  AnySampler (*make)(const EnvironmentMap& map, DensitySpace density_space);
  /// Builds a published sampler as it is listed, without any check of the map, which may hold
  /// what is no radiance. Null for all others.
  AnySampler (*make_as_listed)(const EnvironmentMap& map, DensitySpace density_space) = nullptr;

  /// The target density that the sampler declares; on a map it is on_map() of this.
  TargetDensity target(DensitySpace density_space) const {
    return {density_space, weights, lookup};
  }
};

/// All samplers, in the order in which they are shown.
std::span<const SamplerInfo> samplers();

/// What is known of the sampler of this name. Throws InputError listing the names if there is none.
const SamplerInfo& sampler_by_name(std::string_view name);

}  // namespace lightproof
