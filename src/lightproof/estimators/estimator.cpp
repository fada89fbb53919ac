#include "lightproof/estimators/estimator.h"

#include "lightproof/image/lat_long_texels.h"

namespace lightproof {

PreparedEstimator EstimatorInfo::prepare(const EnvironmentMap& map) const {
  require_lat_long(map, name);
  return make(map);
}

std::string_view to_string(EstimatorKind kind) {
  switch (kind) {
    case EstimatorKind::one_sample:
      return "one-sample";
    case EstimatorKind::multi_sample:
      return "multi-sample";
    case EstimatorKind::resampled:
      return "resampled";
    case EstimatorKind::point_set:
      return "point-set";
    case EstimatorKind::deterministic:
      return "deterministic";
    case EstimatorKind::precomputed:
      return "precomputed";
  }
  return "";
}

}  // namespace lightproof
