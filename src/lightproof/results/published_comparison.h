// A published formula beside its correction, on an input whose exact result is known.
#pragma once

#include <string>
#include <tuple>

namespace lightproof {

struct PublishedComparison {
  std::string system;  ///< its number in the list of systems: "002-2"
  std::string what;    ///< formula and input, in one line
  double exact = 0.0;
  double published = 0.0;
  double corrected = 0.0;

  static auto fields(auto& all) {
    return std::tie(all.system, all.what, all.exact, all.published, all.corrected);
  }
};

}  // namespace lightproof
