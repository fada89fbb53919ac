// Which other convention would make rejected samples right, as a plain value.
#pragma once

#include <string>
#include <tuple>

namespace lightproof {

/// A change of what was said of samples after which they fit the map.
struct Recognition {
  std::string words;  ///< "if z is negated (t is flipped)": completes "the samples match the map …"
  std::string options;   ///< options of the command line that say so
  double log10_p = 0.0;  ///< of the fit of the 32 x 16 bins, if that is what was drawn

  static auto fields(auto& recognition) {
    return std::tie(recognition.words, recognition.options, recognition.log10_p);
  }
};

}  // namespace lightproof
