// Judging, apart from measuring.
#pragma once

namespace lightproof {

enum class Outcome { accept, reject, inconclusive };

constexpr const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::accept:
      return "accept";
    case Outcome::reject:
      return "reject";
    case Outcome::inconclusive:
      return "inconclusive";
  }
  return "";
}

}  // namespace lightproof
