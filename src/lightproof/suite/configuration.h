// One sampler against one law: everything that is tested of it.
#pragma once

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

/// The tests of drawn samples; their p-values are not judged yet.
std::vector<TestRecord> test_draws(const Configuration& configuration,
                                   const Expectation& expectation, const OwnDensity& own,
                                   const Draws& draws);

/// The checks that need no statistics.
std::vector<TestRecord> test_exactly(const Configuration& configuration,
                                     const Expectation& expectation, const BoundSampler& sampler,
                                     const OwnDensity& own, const Draws& draws);

}  // namespace lightproof
