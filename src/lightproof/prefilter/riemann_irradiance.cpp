#include "lightproof/prefilter/riemann_irradiance.h"

#include <fmt/format.h>

#include "lightproof/core/error.h"

namespace lightproof {

void check(RiemannRule rule) {
  const bool midpoint = rule.nodes == RiemannNodes::midpoint;
  const int least = midpoint ? 1 : 2;
  if (rule.azimuths >= 1 && rule.polar >= least) return;
  throw InputError(
      fmt::format("a Riemann sum of {} azimuths and {} polar angles: at least 1 and {} needed with "
                  "nodes at the "
                  "{} of their steps",
                  rule.azimuths, rule.polar, least, midpoint ? "middle" : "end"));
}

double riemann_sum_of_white(RiemannRule rule) {
  check(rule);
  const double x = 0.5 * kPi / rule.polar;
  return rule.nodes == RiemannNodes::midpoint ? x / std::sin(x) : x / std::tan(x);
}

}  // namespace lightproof
