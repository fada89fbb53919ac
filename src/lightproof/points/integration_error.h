// The error of the mean over a point set, against the number of points.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lightproof/points/integrand.h"
#include "lightproof/points/registry.h"

namespace lightproof {

/// Errors are relative to the integral.
struct IntegrationError {
  std::string_view set;        ///< the point set's name
  std::string_view integrand;  ///< the integrand's name
  std::uint64_t points = 0;    ///< N
  int seeds = 0;               ///< independent seeds, each an estimate
  double rmse = 0.0;           ///< root mean square over the seeds
  double rmse_error = 0.0;     ///< its standard error, from the scatter of the squares
  double independent = 0.0;    ///< the exact error of N independent points, sigma / sqrt(N)
};

struct IntegrationOptions {
  std::vector<std::uint64_t> counts = {16, 64, 256, 1024, 4096};
  int seeds = 256;  ///< at least 2
  std::uint64_t seed = 1;
};

/// The errors of one set on one integrand, a row for each count. Depends on nothing but its
/// arguments.
std::vector<IntegrationError> integration_errors(const PointSetInfo& set,
                                                 const Integrand& integrand,
                                                 const IntegrationOptions& options = {});

}  // namespace lightproof
