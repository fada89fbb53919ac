// What a sampler of an environment map claims to draw.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// How the luminance g of a texel becomes the density that is drawn. Two questions tell densities
/// apart, texel_measure() and position_measure(): nothing else may ask which one it is.
enum class DensitySpace {
  /// A: the texture-space density of the lecture, over (s,t) in proportion to luminance; uniform in
  /// t inside a texel.
  texture,
  /// B: the solid-angle density, over directions in proportion to luminance; uniform in cos(theta)
  /// inside a texel.
  solid_angle,
  /// C: the sine-weighted density, over (s,t) in proportion to luminance times the solid angle of
  /// the texel, which is to say times sin(theta) at the row's centre; uniform in t inside a texel.
  /// What pbrt-v3, Mitsuba and Cycles draw of a latitude-longitude map.
  sine_weighted,
};

/// What the size of a part of the map is measured in.
enum class MapMeasure {
  square,       ///< area over (s,t)
  solid_angle,  ///< steradian
};

/// What is known of a density.
struct DensityInfo {
  DensitySpace density_space;
  std::string_view label;  ///< "A"
  std::string_view name;   ///< "texture-space"
  std::string_view words;  ///< what it is in proportion to, and to whom it belongs
  MapMeasure texel_measure;
  MapMeasure position_measure;
};

/// All densities, in the order of DensitySpace, which is that in which they are shown.
inline constexpr std::array<DensityInfo, 3> kDensities = {{
    {DensitySpace::texture, "A", "texture-space",
     "texels in proportion to their luminance, positions uniform in (s,t): the lecture's",
     MapMeasure::square, MapMeasure::square},
    {DensitySpace::solid_angle, "B", "solid-angle",
     "texels in proportion to luminance times solid angle, positions uniform in solid angle",
     MapMeasure::solid_angle, MapMeasure::solid_angle},
    {DensitySpace::sine_weighted, "C", "sine-weighted",
     "texels in proportion to luminance times solid angle, positions uniform in (s,t): that of "
     "pbrt-v3, Mitsuba and Cycles",
     MapMeasure::solid_angle, MapMeasure::square},
}};

/// All densities.
inline constexpr std::array<DensitySpace, kDensities.size()> kDensitySpaces = {
    DensitySpace::texture, DensitySpace::solid_angle, DensitySpace::sine_weighted};

/// What is known of this density.
constexpr const DensityInfo& describe(DensitySpace density_space) {
  return kDensities[static_cast<std::size_t>(density_space)];
}

/// The measure in which the mass of a texel is in proportion to its luminance times its size.
constexpr MapMeasure texel_measure(DensitySpace density_space) {
  return describe(density_space).texel_measure;
}

/// The measure in which positions are uniform inside a texel.
constexpr MapMeasure position_measure(DensitySpace density_space) {
  return describe(density_space).position_measure;
}

/// texel_measure() on a map of this mapping: where equal areas are equal solid angles the two
/// measures are one, and all densities too.
constexpr MapMeasure texel_measure(DensitySpace density_space, const Mapping& mapping) {
  return is_equal_area(mapping) ? MapMeasure::square : texel_measure(density_space);
}

/// position_measure() on a map of this mapping.
constexpr MapMeasure position_measure(DensitySpace density_space, const Mapping& mapping) {
  return is_equal_area(mapping) ? MapMeasure::square : position_measure(density_space);
}

/// Whether texels have weights that positions inside them do not share. The density is then that of
/// the luminance times these weights; else it is, in the measure of positions, that of luminance.
constexpr bool weighs_texels(DensitySpace density_space) {
  return texel_measure(density_space) != position_measure(density_space);
}

/// The label of a density in tables: "A", "B" or "C".
constexpr std::string_view to_string(DensitySpace density_space) {
  return describe(density_space).label;
}

/// What the map is taken to be between the centres of its texels.
enum class Lookup {
  nearest,   ///< constant inside each texel
  bilinear,  ///< interpolated between the four nearest centres: s wraps around, t is clamped
};

/// The density that is declared, against which the reference holds every sampler. With a bilinear
/// look-up it is interpolated: in proportion to the interpolated luminance at every position, over
/// (s,t) under A and over directions under B; under C over (s,t) in proportion to what is
/// interpolated between the centres' luminances times sin(theta) there, as Mitsuba's Hierarchical2D
/// interpolates what its environment emitter weighs.
struct TargetDensity {
  DensitySpace density_space;
  /// Weights of the luminance; Rec. 709 gives way to the map's own weights, see on_map().
  LuminanceWeights weights = kRec709;
  Lookup lookup = Lookup::nearest;
  friend bool operator==(TargetDensity, TargetDensity) = default;
};

/// Empty if a density can be declared on maps of this mapping; else why it cannot. Positions
/// uniform in solid angle are drawn in rows of one height between parallels; a look-up that
/// interpolates between neighbours knows those of latitude and longitude.
constexpr std::string_view why_not_declared(TargetDensity target, const Mapping& mapping) {
  if (target.lookup == Lookup::bilinear && !is_plain(mapping)) {
    return "the bilinear look-up interpolates between neighbours in latitude and longitude";
  }
  const bool has_equal_rows = mapping.kind == MappingKind::lat_long;
  if (position_measure(target.density_space, mapping) == MapMeasure::solid_angle &&
      !has_equal_rows) {
    return "positions uniform in solid angle need rows of one height between two parallels; "
           "density C draws the same texels";
  }
  return "";
}

/// The density that is declared on this map: by the map's own luminance weights, unless weights
/// other than Rec. 709 were declared.
inline TargetDensity on_map(TargetDensity declared, LuminanceWeights of_map) {
  if (declared.weights == kRec709) declared.weights = of_map;
  return declared;
}
inline TargetDensity on_map(TargetDensity declared, const EnvironmentMap& map) {
  return on_map(declared, map.weights);
}

}  // namespace lightproof
