// A published formula beside its correction, on an input whose exact result is known.
#pragma once

#include <string_view>

namespace lightproof {

struct PublishedComparison {
  std::string_view system;  ///< its number in the list of systems: "002-2"
  std::string_view what;    ///< formula and input, in one line
  double exact;
  double published;
  double corrected;
};

}  // namespace lightproof
