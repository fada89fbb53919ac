// What estimators take on this machine, whatever the map: measured once and kept, so that times can
// be told without running anything on the user's map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/progress.h"
#include "lightproof/materials/material.h"
#include "lightproof/render/receiver.h"

namespace lightproof {

/// What an estimator takes on maps of one extent.
struct MethodCost {
  std::string estimator;
  double set_up_seconds = 0.0;         ///< processor time of all threads, once for a map
  double bytes = 0.0;                  ///< beside the map itself
  std::vector<std::uint64_t> samples;  ///< ascending
  std::vector<double> seconds;  ///< of an estimate at a shading point by so many; processor time

  static auto fields(auto& cost) {
    return std::tie(cost.estimator, cost.set_up_seconds, cost.bytes, cost.samples, cost.seconds);
  }
  /// The time of an estimate by any number of samples, by straight lines on log-log paper; beyond
  /// the last one in proportion to the number.
  double seconds_of(std::uint64_t samples) const;
};

/// The costs of all estimators that serve a material, on two extents of maps.
struct MethodCosts {
  std::vector<MethodCost> small;
  std::vector<MethodCost> large;

  static auto fields(auto& costs) { return std::tie(costs.small, costs.large); }
  /// What an estimator takes on maps of an extent, by power laws in the number of texels; none if
  /// the estimator does not serve the material.
  std::optional<MethodCost> of(std::string_view estimator, Extent extent) const;
};

/// Measures costs for a material and a receiver, some seconds of work.
MethodCosts measure_method_costs(const Material& material, const ReceiverInfo& receiver,
                                 const Progress& progress = {});

/// Names the materials that share their costs: those of one kind, "ggx"; of Phong's, for which a
/// map is prefiltered, those with exponents of one order of magnitude and maps of one size. Narrow
/// lobes take several times as long.
std::string material_of_costs(const Material& material);

/// What measure_method_costs() returns, kept for this machine and material_of_costs().
KeptMeasurement<MethodCosts> kept_method_costs(const Material& material,
                                               const ReceiverInfo& receiver,
                                               const MeasurementCache& cache,
                                               const Progress& progress = {});

}  // namespace lightproof
