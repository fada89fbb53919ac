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

/// Runs a computation, and returns why it failed if a numerics library ended it with an exception.
/// Interrupts, bad input and lack of memory are passed on: they end the run; and so is the failure
/// of a sampler that runs elsewhere, which is a verdict.
std::optional<std::string> failure_of(const std::function<void()>& computation);

/// Collects the records of one run, all of as many samples.
class Records {
 public:
  Records(const TestRun& run, std::uint64_t samples) : run_(&run), samples_(samples) {}

  /// Adds a record of nothing yet, to be filled in.
  Measured& add(TestId test);

  /// Adds what `run` adds; where that cannot be computed, this test as an inconclusive one.
  void attempt(TestId test, const std::function<void()>& run);

  /// Adds the goodness of fit of counts of all samples to probabilities.
  void add_fit(TestId test, std::span<const std::uint64_t> observed,
               std::span<const double> probability);

  /// Adds the goodness of fit of counts in a grid, whose cells are taken along its serpentine(), to
  /// probabilities; no copy of either is made.
  void add_fit(TestId test, const Grid<std::uint64_t>& observed, const Grid<double>& probability);

  /// Adds a fit, judged already, of `fit_samples` of the samples or of what is made of them.
  void add_partial_fit(TestId test, const GoodnessOfFit& fit, std::uint64_t fit_samples);

  /// Adds a test that this sampler, or these samples, cannot serve, and why.
  void add_not_run(TestId test, std::string why);

  /// Adds the fit of two sets of samples to each other; `share` is the other set's share of both.
  void add_two_samples(TestId test, const GoodnessOfFit& fit, double share);

  /// Adds a test of uniformity; `detectable` is the distance that it finds at a level, with a
  /// power, by so many samples.
  void add_uniformity(TestId test, const UniformityTest& uniformity, DetectableEffect detectable);

  /// Adds the test of the cell that is farthest from its expectation, of counts of all samples.
  void add_worst(TestId test, std::span<const std::uint64_t> observed,
                 std::span<const double> probability);

  /// Adds a test of an estimate whose exact value is `exact`; `moments` are those of one sample.
  void add_z(TestId test, const ZTest& z, const ExactMoments& moments, double exact);

  /// Adds an exact check.
  void add_check(const CheckResult& result);

  /// Adds the test that no sample is invalid in this way; `what` says it of a sample.
  void add_invalid(TestId test, std::string_view what, const InvalidSamples& invalid_samples);

  /// Sets, in the record that was added last, the effect that the step of the sampler's sums makes
  /// by itself.
  void set_resolution_floor(double effect);

  /// Sets the words that explain the record that was added last.
  void set_detail(std::string detail);

  std::vector<Measured> take() { return std::move(records_); }

 private:
  void add_fit(TestId test, const std::function<GoodnessOfFit()>& compute);

  const TestRun* run_;
  std::uint64_t samples_;
  std::vector<Measured> records_;
};

}  // namespace lightproof
