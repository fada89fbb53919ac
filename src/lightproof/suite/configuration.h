// One sampler against one law: everything that is tested of it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lightproof/suite/checks.h"
#include "lightproof/suite/draws.h"
#include "lightproof/suite/expectation.h"
#include "lightproof/suite/problem.h"
#include "lightproof/suite/results.h"

namespace lightproof {

/// A candidate and its problem, and the names and numbers that its records carry.
struct Configuration {
  const Problem* problem;
  const Candidate* candidate;
  std::uint64_t seed;

  /// "binary_search/B/city".
  std::string name() const;
  /// A stream of its own for every purpose.
  RandomStream stream(std::string_view purpose) const;
};

/// A record of nothing yet.
TestRecord record_of(const Configuration& configuration, std::string_view oracle,
                     std::string_view test, std::uint64_t samples);

/// Makes an accepting test of the bins (or of all counts, if sequential) inconclusive if it could
/// not have seen a deviation of this size.
void require_power(TestRecord& record, double must_detect);

/// What a test found, and what it would find.
struct Measured {
  TestRecord record;
  /// The effect that is found with `power` by a test of size `level`; empty for exact checks.
  std::function<double(double level, double power, double samples)> detectable = {};
};

/// Draws so many samples for a purpose that names their stream; and, of a sampler that can be asked
/// for them, positions in the rows of the poles, where few samples lie.
Draws draw_samples_of(const Configuration& configuration, const Expectation& expectation,
                      const BoundSampler& sampler, std::string_view purpose, std::uint64_t samples);

/// The tests of drawn samples; their p-values are not judged yet.
std::vector<Measured> test_draws(const Configuration& configuration, const Expectation& expectation,
                                 const Inspection& inspection, const Draws& draws,
                                 const UniformEstimates& uniform);

/// The sampler that others of the same law claim to equal, and the bins of what it drew.
struct Twin {
  BoundSampler sampler;
  std::uint64_t samples;
  Grid<std::uint64_t> bins;
};

/// It draws a quarter of so many samples.
Twin draw_twin(BoundSampler sampler, const Expectation& expectation, const RandomStream& stream,
               std::uint64_t samples);

/// Both drew numbers of their own: are they of one law? None for a candidate without a twin.
std::vector<Measured> test_against_twin(const Configuration& configuration, const Draws& draws,
                                        const std::optional<Twin>& twin);

/// Of all samples drawn: does each lie where it may?
std::vector<Measured> test_strays(const Configuration& configuration, const Draws& draws);

/// The checks that need no statistics; `twin` is null if the problem has none.
std::vector<Measured> test_exactly(const Configuration& configuration,
                                   const Expectation& expectation, const BoundSampler& sampler,
                                   const Inspection& inspection, const Draws& draws,
                                   const BoundSampler* twin);

}  // namespace lightproof
