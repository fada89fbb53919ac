// What strata leave of the variance of estimators, by values of these at points of the square.
#pragma once

#include <vector>

#include "lightproof/materials/material.h"
#include "lightproof/recommend/map_summary.h"
#include "lightproof/recommend/strata.h"

namespace lightproof {

/// The strata of one map, whose summary must outlive it, and one material.
class PredictedStrata {
 public:
  PredictedStrata(const MapSummary& summary, const Material& material);

  /// The variances of "environment B", drawn by a monotone table.
  StrataVariances of_map(const ShadingPoint& at) const;
  /// The variances of "brdf".
  StrataVariances of_lobes(const ShadingPoint& at) const;

 private:
  const MapSummary* summary_;
  Material material_;
  std::vector<double> s_;  ///< the points
  std::vector<double> t_;
  std::vector<double> map_x_;  ///< the directions to which a monotone table of the map takes them
  std::vector<double> map_y_;
  std::vector<double> map_z_;
};

}  // namespace lightproof
