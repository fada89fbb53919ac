// One error probability for a whole run of tests.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightproof {

/// Which of the tests Holm's step-down procedure (1979) rejects at the family-wise error `alpha`,
/// in the order of the decimal logarithms of their p-values as they are given. Valid under any
/// dependence. `family` tests share the error, if they are more than these: the others count as not
/// rejected. So a part of a family rejects nothing that the whole accepts, whatever the part.
std::vector<bool> holm_rejections(std::span<const double> log10_p, double alpha,
                                  std::size_t family = 0);

/// The level at which Holm judges the smallest of `tests` p-values: alpha / tests.
double strictest_level(double alpha, std::size_t tests);

}  // namespace lightproof
