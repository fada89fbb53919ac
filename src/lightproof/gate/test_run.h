// One sampler against one distribution: everything that is tested of it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "lightproof/core/out_of_memory.h"
#include "lightproof/gate/detectable_effect.h"
#include "lightproof/gate/draws.h"
#include "lightproof/gate/exact_checks.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/gate/sampler_failure.h"
#include "lightproof/gate/test_case.h"
#include "lightproof/results/test_record.h"

namespace lightproof {

/// An instance and its test case, and the names and numbers that its records carry.
struct TestRun {
  const TestCase* test_case;
  const SamplerInstance* instance;
  std::uint64_t seed;

  /// The name of the run: "binary_search/B/city".
  std::string name() const;
  /// The key of the run's cell of work in one stage: "screening/city/B/binary_search/1".
  std::string key(std::string_view stage) const;
  /// The run's own stream of random numbers for a purpose.
  RandomStream stream(std::string_view purpose) const;
};

/// "the gate over alias on sun-sky (density B)"; "the gate over sun-sky …" without a sampler.
std::string purpose_of_gate(const TestCase& test_case, std::string_view sampler);

/// The result of `work`, with lack of memory laid to the gate over a sampler, if one is named, and
/// its test case.
template <class Work>
auto with_memory_for_gate(const TestCase& test_case, std::string_view sampler, const Work& work) {
  return with_memory_for([&] { return purpose_of_gate(test_case, sampler); }, work);
}

/// The record of a test of so many samples, in which nothing is said yet of what it found.
TestRecord record_of(const TestRun& run, TestId test, std::uint64_t samples);

/// Makes an accepting test of the bins (or of all counts, if sequential) inconclusive if it could
/// not have seen a deviation of this size.
void require_power(TestRecord& record, double must_detect);

/// How many samples a test gets in each stage of the gate.
struct StageSamples {
  std::uint64_t screening = 0;
  std::uint64_t confirmation = 0;  ///< should it come to that; 0: the source has none left

  static auto fields(auto& stages) { return std::tie(stages.screening, stages.confirmation); }
};

/// What a test found, and what it would find.
struct Measured {
  TestRecord record;
  std::optional<DetectableEffect> detectable = {};  ///< none of exact checks
  StageSamples stages = {};

  static auto fields(auto& test) { return std::tie(test.record, test.detectable, test.stages); }
};

/// Draws so many samples for a purpose that names their stream, or, of a source that has an order
/// of its own, those from number `first` on; and, of a sampler that can be asked for them,
/// positions in the rows of the poles, where few samples lie.
Draws draw_samples_of(const TestRun& run, const Expectation& expectation,
                      const BoundSampler& sampler, std::string_view purpose, std::uint64_t samples,
                      std::uint64_t first = 0);

/// The tests of drawn samples; their p-values are not judged yet.
std::vector<Measured> test_draws(const TestRun& run, const Expectation& expectation,
                                 const Inspection& inspection, const Draws& draws,
                                 const UniformEstimates& uniform);

/// A reference implementation, which other samplers claim to equal, and the bins of what it drew.
struct ReferenceDraws {
  BoundSampler sampler;
  std::uint64_t samples;
  Grid<std::uint64_t> bins;
};

/// Draws a quarter of so many samples from a reference implementation.
ReferenceDraws draw_reference(BoundSampler sampler, const Expectation& expectation,
                              const RandomStream& stream, std::uint64_t samples);

/// Tests whether what an instance drew and what its reference implementation drew, by random
/// numbers of their own, are of one distribution. Nothing for an instance without a reference
/// implementation.
std::vector<Measured> test_against_reference(
    const TestRun& run, const Draws& draws,
    const std::optional<ReferenceDraws>& reference_implementation);

/// Tests whether any of the samples drawn is out of the domain, and whether any is of zero density.
std::vector<Measured> test_validity(const TestRun& run, const Draws& draws);

/// All that is known of a run whose sampler failed to answer: that it did, and to what.
std::vector<Measured> test_unanswered(const TestRun& run, const SamplerFailure& failure,
                                      std::uint64_t samples);

/// The checks that need no statistics; `reference_implementation` is null if the test case has
/// none.
std::vector<Measured> test_exactly(const TestRun& run, const Expectation& expectation,
                                   const BoundSampler& sampler, const Inspection& inspection,
                                   const Draws& draws,
                                   const BoundSampler* reference_implementation);

}  // namespace lightproof
