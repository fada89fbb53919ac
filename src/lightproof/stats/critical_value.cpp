#include "lightproof/stats/critical_value.h"

#include <boost/math/tools/toms748_solve.hpp>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace lightproof {

double critical_value(const std::function<double(double)>& log10_tail, double log10_level) {
  assert(std::isfinite(log10_level));
  const auto excess = [&](double x) { return log10_tail(x) - log10_level; };
  if (!(excess(0.0) > 0.0)) return 0.0;
  constexpr double kFirst = 1.0;
  constexpr double kFactor = 2.0;
  constexpr bool kRises = false;
  const boost::math::tools::eps_tolerance<double> close(50);
  std::uintmax_t most_steps = 1000;
  return boost::math::tools::bracket_and_solve_root(excess, kFirst, kFactor, kRises, close,
                                                    most_steps)
      .second;
}

}  // namespace lightproof
