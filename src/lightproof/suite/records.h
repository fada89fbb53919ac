// Records of the tests of one configuration: what each found, and the effect that it would find.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/stats/uniformity.h"
#include "lightproof/suite/checks.h"
#include "lightproof/suite/configuration.h"
#include "lightproof/suite/draws.h"

namespace lightproof {

/// Runs a computation; says why if a numerics library ends it with an exception. Interrupts, bad
/// input and lack of memory are passed on: they end the run.
std::optional<std::string> failure_of(const std::function<void()>& computation);

/// Collects the records of one configuration, all of as many samples.
class Records {
 public:
  Records(const Configuration& configuration, std::uint64_t samples)
      : configuration_(&configuration), samples_(samples) {}

  Measured& add(std::string_view oracle, std::string_view test);

  /// Adds what `run` adds; where that cannot be computed, an inconclusive test of this name.
  void attempt(std::string_view oracle, std::string_view test, const std::function<void()>& run);

  /// Counts of all samples against probabilities.
  void add_fit(std::string_view oracle, std::string_view test,
               std::span<const std::uint64_t> observed, std::span<const double> probability);

  /// A statistic of `fit_samples` of the samples or of what is made of them, judged already.
  void add_partial_fit(std::string_view test, const GoodnessOfFit& fit, std::uint64_t fit_samples);

  /// A test that this sampler, or these samples, cannot serve, and why.
  void add_not_run(std::string_view test, std::string why);

  /// `share`: of the other sample, of both.
  void add_two_samples(std::string_view test, const GoodnessOfFit& fit, double share);

  /// `detectable`: distance that is found at a level, with a power, by so many samples.
  void add_uniformity(std::string_view test, const UniformityTest& uniformity,
                      double (*detectable)(double level, double power, double samples));

  void add_worst(std::string_view test, std::span<const std::uint64_t> observed,
                 std::span<const double> probability);

  /// `law`: of one sample of what is estimated, `exact` in the end.
  void add_z(std::string_view oracle, std::string_view test, const ZTest& z, const ExactLaw& law,
             double exact);

  void add_check(const CheckResult& result);

  void add_strays(std::string_view test, std::string_view what, const Strays& strays);

  /// The step of the sampler's sums makes an effect of this size by itself.
  void set_resolution_floor(double effect);

  /// Of the record that was added last.
  void set_detail(std::string detail);

  std::vector<Measured> take() { return std::move(records_); }

 private:
  const Configuration* configuration_;
  std::uint64_t samples_;
  std::vector<Measured> records_;
};

}  // namespace lightproof
