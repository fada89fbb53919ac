// The effects that tests of a run would find, as plain values: what they are computed from once the
// level of the judgement is known.
#pragma once

#include <cstdint>
#include <tuple>
#include <variant>

#include "lightproof/stats/moment_tests.h"

namespace lightproof {

/// w of Cohen, of a fit with so many degrees of freedom.
struct EffectOnCells {
  double dof = 0.0;
  double share = 1.0;  ///< of the run's samples that the fit counts

  static auto fields(auto& effect) { return std::tie(effect.dof, effect.share); }
};

/// The distance that Kuiper's test measures.
struct KuiperDistance {
  static auto fields(auto& /*effect*/) { return std::tie(); }
};

/// The distance that Anderson and Darling's test measures.
struct AndersonDarlingDistance {
  static auto fields(auto& /*effect*/) { return std::tie(); }
};

/// The relative excess of the likeliest of so many cells.
struct ExcessOfWorstCell {
  std::uint64_t cells = 0;
  double likeliest = 0.0;  ///< its probability

  static auto fields(auto& effect) { return std::tie(effect.cells, effect.likeliest); }
};

/// The relative error of a mean whose samples have these moments.
struct ErrorOfMean {
  ExactMoments moments;
  double exact = 0.0;  ///< what is estimated

  static auto fields(auto& effect) {
    auto& moments = effect.moments;
    return std::tie(moments.mean, moments.variance, moments.largest_deviation, effect.exact);
  }
};

using DetectableEffect = std::variant<EffectOnCells, KuiperDistance, AndersonDarlingDistance,
                                      ExcessOfWorstCell, ErrorOfMean>;

/// The least effect that a test of size `level` finds with `power` in a run of so many samples.
/// Infinite where none is large enough. Throws what the numerics throw where it cannot be computed.
double minimum_detectable(const DetectableEffect& effect, double level, double power,
                          double samples);

}  // namespace lightproof
