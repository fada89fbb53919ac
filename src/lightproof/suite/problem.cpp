#include "lightproof/suite/problem.h"

namespace lightproof {
namespace {

std::function<BoundSampler()> made_once(const std::function<BoundSampler()>& bind) {
  return [sampler = bind()] { return sampler; };
}

}  // namespace

Problem made_once(Problem problem) {
  const std::shared_ptr<const Expectation> expectation = problem.expectation();
  problem.expectation = [expectation] { return expectation; };
  if (problem.twin) problem.twin = made_once(problem.twin);
  for (Candidate& candidate : problem.candidates) {
    candidate.bind = made_once(candidate.bind);
    candidate.inspect =
        [inspection = candidate.inspect(candidate.bind(), *expectation, candidate.rounding)](
            const BoundSampler&, const Expectation&, const MassRounding&) { return inspection; };
  }
  return problem;
}

}  // namespace lightproof
