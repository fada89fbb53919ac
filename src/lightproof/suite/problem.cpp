#include "lightproof/suite/problem.h"

#include <mutex>
#include <utility>

namespace lightproof {
namespace {

using Inspect = decltype(Candidate::inspect);

std::function<BoundSampler()> made_once(const std::function<BoundSampler()>& bind) {
  return [sampler = bind()] { return sampler; };
}

/// What the first call found, whatever its arguments.
class KeptInspection {
 public:
  explicit KeptInspection(Inspect inspect) : inspect_(std::move(inspect)) {}

  const Inspection& of(const BoundSampler& sampler, const Expectation& expectation,
                       const MassRounding& rounding) {
    std::call_once(once_, [&] { kept_ = inspect_(sampler, expectation, rounding); });
    return kept_;
  }

 private:
  Inspect inspect_;
  std::once_flag once_;
  Inspection kept_;
};

}  // namespace

Problem inspected_once(Problem problem) {
  for (Candidate& candidate : problem.candidates) {
    candidate.inspect = [kept = std::make_shared<KeptInspection>(std::move(candidate.inspect))](
                            const BoundSampler& sampler, const Expectation& expectation,
                            const MassRounding& rounding) {
      return kept->of(sampler, expectation, rounding);
    };
  }
  return problem;
}

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
