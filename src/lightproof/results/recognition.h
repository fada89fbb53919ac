// Which other convention would make rejected samples right, as a plain value.
#pragma once

#include <string>
#include <tuple>

namespace lightproof {

/// A change of what was said of samples after which they fit the map.
struct Recognition {
  std::string words;  ///< "if z is negated (t is flipped)": completes "the samples match the map …"
  /// Options of the command line that say so; empty if none do.
  std::string options;
  /// Of the fit of the 32 x 16 bins, of a shift by half a texel that of the texels, if that is what
  /// was drawn; 0 of what is said of densities, which are no matter of chance.
  double log10_p = 0.0;

  static auto fields(auto& recognition) {
    return std::tie(recognition.words, recognition.options, recognition.log10_p);
  }
};

}  // namespace lightproof
