// Turns the p-values of all runs together into outcomes, and says what would have been found.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "lightproof/gate/gate.h"
#include "lightproof/gate/test_run.h"

namespace lightproof {

/// The p-values of the screening stage that lead to the confirmation stage: those in [from, to).
struct ConfirmationRange {
  double from;
  double to;

  bool operator()(const Measured& test) const;
};

/// Judges the tests of a family: see run_gate().
class Judge {
 public:
  /// Judges by these options; `family` p-values share the error probability.
  Judge(const GateOptions& options, std::size_t family);

  /// The p-values that lead to the confirmation stage.
  ConfirmationRange confirmation() const { return {immediate_level_, screening_level_}; }

  /// Sets the outcome and the minimum detectable effect of every test that has a p-value. Those of
  /// the confirmation stage are judged together, by Holm's procedure.
  void operator()(std::span<Measured* const> tests) const;

 private:
  std::optional<double> minimum_detectable_effect(const Measured& test) const;

  double screening_level_;
  double immediate_level_;
  double second_alpha_;
  double second_level_;  ///< the level of Holm's strictest test
  std::size_t family_;
  double must_detect_;
};

}  // namespace lightproof
