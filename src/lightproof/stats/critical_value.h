// The critical value of a test whose tail is known: Boost's bracketing and TOMS 748 (Alefeld, Potra
// and Shi 1995), which needs some ten values of the tail where bisection takes fifty.
#pragma once

#include <functional>

namespace lightproof {

/// The statistic, from 0 up, at which an upper tail falls to a level. `log10_tail` is log10 P(X >=
/// x) as a function of x, and never rises; where it jumps over the level, the result is where it
/// jumps. 0 if the tail is no higher than the level there. The result errs by less than 2^-49 of
/// itself, and towards the side on which the tail is not above the level. The level is positive.
double critical_value(const std::function<double(double)>& log10_tail, double log10_level);

}  // namespace lightproof
