// How long work tells whoever watches how far it is. Silence is an empty function.
#pragma once

#include <functional>
#include <string_view>

namespace lightproof {

/// Called with the name of the step and the fraction done of the whole, in [0, 1]; may be called
/// from any thread.
using Progress = std::function<void(std::string_view step, double fraction)>;

/// A progress that reports every step of `whole` as `step`, whatever the steps inside are called.
/// The text of `step` must outlive it.
inline Progress named(const Progress& whole, std::string_view step) {
  if (!whole) return {};
  return [whole, step](std::string_view /*inner*/, double fraction) { whole(step, fraction); };
}

/// A progress that reports its whole as the part [from, to] of another one.
inline Progress part_of(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](std::string_view step, double fraction) {
    whole(step, from + (to - from) * fraction);
  };
}

}  // namespace lightproof
