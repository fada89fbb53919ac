// The error of the split-sum approximation over roughness and view angle.
#pragma once

#include <string>
#include <tuple>

namespace lightproof {

/// One map, roughness, view and reflectance.
struct SplitSumRecord {
  std::string map;
  double roughness = 0.0;           ///< perceptual; alpha is its square
  double view_angle = 0.0;          ///< between normal and view, in radians
  double normal_reflectance = 0.0;  ///< F0
  /// Root mean square over all orientations of surface and view in the map, over the mean of the
  /// exact radiance.
  double rmse = 0.0;
  double left_out =
      0.0;  ///< what details finer than the harmonics would add in quadrature, at most

  static auto fields(auto& record) {
    return std::tie(record.map, record.roughness, record.view_angle, record.normal_reflectance,
                    record.rmse, record.left_out);
  }
};

}  // namespace lightproof
