#include "lightproof/self_test/naming.h"

#include <algorithm>

#include "lightproof/gate/gate.h"
#include "lightproof/self_test/mutant.h"

namespace lightproof {
namespace {

std::vector<SamplerUnderTest> all_mutants() {
  std::vector<SamplerUnderTest> samplers_under_test;
  for (const Mutant& mutant : mutants()) {
    for (const DensitySpace density_space : {DensitySpace::texture, DensitySpace::solid_angle}) {
      samplers_under_test.push_back(sampler_under_test(mutant, density_space));
    }
  }
  return samplers_under_test;
}

void count(std::vector<NamingRecord>& records, const Rejection& rejection) {
  NamingRecord& record =
      *std::find_if(records.begin(), records.end(),
                    [&](const NamingRecord& other) { return other.mutant == rejection.sampler; });
  ++record.rejected;
  if (rejection.looks_like == record.expected) {
    ++record.right;
  } else if (rejection.looks_like == "unknown") {
    ++record.unknown;
  } else {
    ++record.wrong;
    const auto same =
        std::find(record.wrong_names.begin(), record.wrong_names.end(), rejection.looks_like);
    if (same == record.wrong_names.end()) record.wrong_names.push_back(rejection.looks_like);
  }
}

std::vector<TestCase> test_cases_for_all_seeds(
    const EnvironmentMap& map, std::span<const SamplerUnderTest> samplers_under_test) {
  std::vector<TestCase> test_cases = test_cases_of({&map, 1}, samplers_under_test);
  for (TestCase& test_case : test_cases) test_case = inspected_once(std::move(test_case));
  return test_cases;
}

}  // namespace

std::vector<NamingRecord> measure_naming(std::span<const MapRecord> maps,
                                         const NamingOptions& options, const Progress& progress,
                                         const Communicator& communicator) {
  std::vector<NamingRecord> records;
  for (const Mutant& mutant : mutants()) {
    records.push_back({.mutant = std::string(mutant.name),
                       .expected = std::string(mutant.diagnosis),
                       .runs = 2 * maps.size() * options.seeds});
  }
  const std::vector<SamplerUnderTest> samplers_under_test = all_mutants();
  const auto rounds = static_cast<double>(maps.size() * options.seeds);
  double done = 0.0;
  for (const MapRecord& map : maps) {
    const std::vector<TestCase> test_cases = test_cases_for_all_seeds(map.map, samplers_under_test);
    for (std::uint64_t i = 0; i < options.seeds; ++i, ++done) {
      const GateResult result =
          run_gate(test_cases, {.samples = options.samples, .seed = options.seed + i},
                   part_of(progress, done / rounds, (done + 1.0) / rounds), communicator);
      for (const Rejection& rejection : result.rejections) count(records, rejection);
    }
  }
  return records;
}

}  // namespace lightproof
