// A picture of a scene by one estimator, beside its reference.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "lightproof/core/grid.h"
#include "lightproof/image/environment_map.h"

namespace lightproof {

/// One picture of a receiver, by one estimator in the time that all have.
struct RenderRecord {
  std::string map;
  std::string receiver;
  std::string material;
  std::string estimator;
  bool is_representative = true;  ///< whether it is shown at once; others are shown on demand
  std::uint64_t samples = 0;
  Grid<Rgb> picture;     ///< the estimator's picture, row 0 at the top
  Grid<Rgb> reference;   ///< the picture that all estimators of a map are held against
  Grid<double> error;    ///< signed, over the reference's mean luminance at the receiver
  double rmse = 0.0;     ///< root mean square of `error` at the pixels that show the receiver
  double seconds = 0.0;  ///< elapsed, to render, without set-up
  std::uint64_t reference_samples = 0;  ///< per pixel of the reference; 0 if it is not sampled
  /// Processor time of one shading point with so many samples; 0 if it was not measured.
  double point_seconds = 0.0;

  static auto fields(auto& record) {
    return std::tie(record.map, record.receiver, record.material, record.estimator,
                    record.is_representative, record.samples, record.picture, record.reference,
                    record.error, record.rmse, record.seconds, record.reference_samples,
                    record.point_seconds);
  }
};

}  // namespace lightproof
