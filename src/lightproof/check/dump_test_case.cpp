#include "lightproof/check/dump_test_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "lightproof/check/dump_sampler.h"
#include "lightproof/core/error.h"
#include "lightproof/gate/sampler_under_test.h"

namespace lightproof {

TestCase dump_test_case(std::shared_ptr<const SampleDump> dump, const EnvironmentMap& map,
                        const DumpClaim& claim) {
  SamplerUnderTest named;
  named.name = claim.name;
  named.target = claim.target;
  named.resolution = 0.0;
  if (const std::string_view reason = why_left_out(named, map); !reason.empty()) {
    throw InputError(fmt::format(
        "{}: no density {} on its {} texels: {}, and --resample brings it to those of latitude and "
        "longitude",
        map.name, to_string(claim.target.density_space), info(map.mapping.kind).name, reason));
  }
  TestCase test_case = test_cases_of({&map, 1}, {&named, 1}).front();
  // The exact side is made once: the dump's samples find their texels by it.
  const std::shared_ptr<const Expectation> expectation = test_case.expectation();
  test_case.expectation = [expectation] { return expectation; };
  SamplerInstance& instance = test_case.instances.front();
  instance.bind = [dump, expectation] { return bound_dump(dump, expectation); };
  instance.inspect = [dump, tolerance = claim.pdf_tolerance](const BoundSampler& sampler,
                                                             const Expectation& exact,
                                                             const MassRounding& rounding) {
    Inspection inspection = inspect(sampler, exact, rounding);
    inspection.compares_samples = sampler.has_weights;
    if (inspection.compares_samples) {
      inspection.density = compare_dumped_density(*dump, exact, tolerance);
    }
    return inspection;
  };
  return test_case;
}

GateOptions spending(GateOptions options, std::uint64_t samples) {
  options.samples = std::max<std::uint64_t>(1, samples / 5);
  return options;
}

}  // namespace lightproof
