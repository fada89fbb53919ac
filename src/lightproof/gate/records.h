// Records of the tests of one run: what each found, and the effect that it would find.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/gate/detectable_effect.h"
#include "lightproof/gate/draws.h"
#include "lightproof/gate/exact_checks.h"
#include "lightproof/gate/test_run.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {

/// Runs a computation; says why if a numerics library ends it with an exception. Interrupts, bad
/// input and lack of memory are passed on: they end the run.
std::optional<std::string> failure_of(const std::function<void()>& computation);

/// Collects the records of one run, all of as many samples.
class Records {
 public:
  Records(const TestRun& run, std::uint64_t samples) : run_(&run), samples_(samples) {}

  Measured& add(TestId test);

  /// Adds what `run` adds; where that cannot be computed, an inconclusive test of this name.
  void attempt(TestId test, const std::function<void()>& run);

  /// Counts of all samples against probabilities.
  void add_fit(TestId test, std::span<const std::uint64_t> observed,
               std::span<const double> probability);

  /// A statistic of `fit_samples` of the samples or of what is made of them, judged already.
  void add_partial_fit(TestId test, const GoodnessOfFit& fit, std::uint64_t fit_samples);

  /// A test that this sampler, or these samples, cannot serve, and why.
  void add_not_run(TestId test, std::string why);

  /// `share`: of the other sample, of both.
  void add_two_samples(TestId test, const GoodnessOfFit& fit, double share);

  void add_uniformity(TestId test, const UniformityTest& uniformity, DetectableEffect detectable);

  void add_worst(TestId test, std::span<const std::uint64_t> observed,
                 std::span<const double> probability);

  /// `moments`: of one sample of what is estimated; `exact`: the value of the estimate.
  void add_z(TestId test, const ZTest& z, const ExactMoments& moments, double exact);

  void add_check(const CheckResult& result);

  void add_invalid(TestId test, std::string_view what, const InvalidSamples& invalid_samples);

  /// The step of the sampler's sums makes an effect of this size by itself.
  void set_resolution_floor(double effect);

  /// Says why, in words, of the record that was added last.
  void set_detail(std::string detail);

  std::vector<Measured> take() { return std::move(records_); }

 private:
  const TestRun* run_;
  std::uint64_t samples_;
  std::vector<Measured> records_;
};

}  // namespace lightproof
