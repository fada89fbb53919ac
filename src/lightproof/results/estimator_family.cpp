#include "lightproof/results/estimator_family.h"

namespace lightproof {

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
