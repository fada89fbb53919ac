// One error probability for a whole run of tests.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightproof {

/// Which of the tests Holm's step-down procedure (1979) rejects at family-wise error `alpha`,
/// given the base-10 logarithms of their p-values. Valid under any dependence. Same order as the
/// input.
std::vector<bool> holm_rejections(std::span<const double> log10_p, double alpha);

/// The level at which Holm judges the smallest of `tests` p-values: alpha / tests.
double strictest_level(double alpha, std::size_t tests);

}  // namespace lightproof
