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

std::string_view to_string(EstimatorFamily family) {
  switch (family) {
    case EstimatorFamily::uniform:
      return "uniform";
    case EstimatorFamily::lobes:
      return "lobes";
    case EstimatorFamily::environment:
      return "environment";
    case EstimatorFamily::product:
      return "product";
    case EstimatorFamily::mis:
      return "MIS";
    case EstimatorFamily::ris:
      return "RIS";
    case EstimatorFamily::points:
      return "point sets";
    case EstimatorFamily::lights:
      return "lights";
    case EstimatorFamily::quadrature:
      return "quadrature";
    case EstimatorFamily::precomputed:
      return "precomputed";
  }
  return "";
}

}  // namespace lightproof
