#include "lightproof/gate/test_case.h"

#include <mutex>
#include <utility>

namespace lightproof {
namespace {

using Inspect = decltype(SamplerInstance::inspect);

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

TestCase inspected_once(TestCase test_case) {
  for (SamplerInstance& instance : test_case.instances) {
    instance.inspect = [kept = std::make_shared<KeptInspection>(std::move(instance.inspect))](
                           const BoundSampler& sampler, const Expectation& expectation,
                           const MassRounding& rounding) {
      return kept->of(sampler, expectation, rounding);
    };
  }
  return test_case;
}

TestCase made_once(TestCase test_case) {
  const std::shared_ptr<const Expectation> expectation = test_case.expectation();
  test_case.expectation = [expectation] { return expectation; };
  if (test_case.reference_implementation)
    test_case.reference_implementation = made_once(test_case.reference_implementation);
  for (SamplerInstance& instance : test_case.instances) {
    instance.bind = made_once(instance.bind);
    instance.inspect =
        [inspection = instance.inspect(instance.bind(), *expectation, instance.rounding)](
            const BoundSampler&, const Expectation&, const MassRounding&) { return inspection; };
  }
  return test_case;
}

}  // namespace lightproof
