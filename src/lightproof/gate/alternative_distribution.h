// Distributions that a sampler draws by mistake: what a rejected sampler is compared with, to
// name its defect, and what the mutants draw.
#pragma once

#include <span>
#include <string_view>

#include "lightproof/core/grid.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// What is declared: masses of texels, and the map that they come from, if they come from one.
struct DeclaredDistribution {
  const Grid<double>* masses;
  const EnvironmentMap* map = nullptr;
  TargetDensity target = {DensitySpace::solid_angle};
};

/// What a defect needs of a map's mapping to be one.
enum class MappingNeed {
  none,
  rows,  ///< texels of latitude and longitude: what is wrong is a sin(theta), or a pole's row
  unequal_areas,  ///< texels of different solid angles
};

/// Empty if a mapping has what a defect needs; else what it lacks.
std::string_view why_meaningless(MappingNeed need, const Mapping& mapping);

/// A distribution over texels that samplers draw by mistake, whatever the map.
struct AlternativeDistribution {
  std::string_view name;       ///< "no-sine"
  std::string_view diagnosis;  ///< "a missing sin(theta)"
  /// Masses of the texels that are drawn instead; they sum to 1. Inside a texel the position
  /// follows the declared density.
  Grid<double> (*masses)(const DeclaredDistribution& declared);
  bool reads_map = true;  ///< whether it has no meaning without a map
  /// Whether its masses are only an example of the defect, whose counts may be any of many: such a
  /// defect is known by other evidence.
  bool is_example = false;
  MappingNeed need = MappingNeed::none;  ///< on other maps it says nothing
  /// What it is on maps in whose pictures columns are no azimuths and rows no heights; empty if
  /// `diagnosis` is true of these too.
  std::string_view diagnosis_of_picture = {};

  /// What it is on a map of this mapping.
  std::string_view diagnosis_on(const Mapping& mapping) const;
};

/// All alternative distributions, in the order in which they are shown.
std::span<const AlternativeDistribution> alternative_distributions();

/// The alternative distribution of this name, which must exist.
const AlternativeDistribution& alternative_distribution(std::string_view name);

}  // namespace lightproof
