#include "lightproof/estimators/estimator.h"

namespace lightproof {

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
