// Judging, apart from measuring.
#pragma once

#include <cstddef>

#include "lightproof/core/enumeration.h"

namespace lightproof {

/// What a test, or a whole run, comes to.
enum class Outcome {
  accept,
  reject,
  inconclusive,
  /// Nothing was found, but what would have been is smaller than what the sampler's own rounding
  /// makes: no reason to fail, and no acceptance of its distribution to that size either.
  resolution_limited,
  /// The sampler cannot serve the test, or gave it too little: it decides nothing.
  not_run,
};

template <>
inline constexpr std::size_t kValuesOf<Outcome> = 5;

/// The name of an outcome where it is printed or written: "resolution-limited".
constexpr const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::accept:
      return "accept";
    case Outcome::reject:
      return "reject";
    case Outcome::inconclusive:
      return "inconclusive";
    case Outcome::resolution_limited:
      return "resolution-limited";
    case Outcome::not_run:
      return "not-run";
  }
  return "";
}

}  // namespace lightproof
