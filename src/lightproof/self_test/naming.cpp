#include "lightproof/self_test/naming.h"

#include <algorithm>

#include "lightproof/gate/gate.h"
#include "lightproof/self_test/mutant.h"

namespace lightproof {
namespace {

std::vector<SamplerUnderTest> all_mutants() {
  std::vector<SamplerUnderTest> samplers_under_test;
  for (const Mutant& mutant : mutants()) {
    for (const DensityInfo& density : kDensities) {
      samplers_under_test.push_back(sampler_under_test(mutant, density.density_space));
    }
  }
  return samplers_under_test;
}

void add_wrong_name(NamingRecord& record, const std::string& name) {
  auto& names = record.wrong_names;
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
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
    add_wrong_name(record, rejection.looks_like);
  }
}

std::vector<TestCase> test_cases_for_all_seeds(
    const EnvironmentMap& map, std::span<const SamplerUnderTest> samplers_under_test) {
  std::vector<TestCase> test_cases = test_cases_of({&map, 1}, samplers_under_test);
  for (TestCase& test_case : test_cases) test_case = inspected_once(std::move(test_case));
  return test_cases;
}

/// The records of every mutant, before any run.
std::vector<NamingRecord> no_runs() {
  std::vector<NamingRecord> records;
  for (const Mutant& mutant : mutants()) {
    records.push_back(
        {.mutant = std::string(mutant.name), .expected = std::string(mutant.diagnosis)});
  }
  return records;
}

std::vector<NamingRecord> measure_naming_on(const EnvironmentMap& map, const NamingOptions& options,
                                            const Progress& progress,
                                            const Communicator& communicator) {
  std::vector<NamingRecord> records = no_runs();
  for (NamingRecord& record : records) record.runs = kDensities.size() * options.seeds;
  const std::vector<SamplerUnderTest> samplers_under_test = all_mutants();
  const std::vector<TestCase> test_cases = test_cases_for_all_seeds(map, samplers_under_test);
  const auto seeds = static_cast<double>(options.seeds);
  for (std::uint64_t i = 0; i < options.seeds; ++i) {
    const auto done = static_cast<double>(i);
    const GateResult result =
        run_gate(test_cases, {.samples = options.samples, .seed = options.seed + i},
                 part_of(progress, done / seeds, (done + 1.0) / seeds), communicator);
    for (const Rejection& rejection : result.rejections) count(records, rejection);
  }
  return records;
}

void merge(NamingRecord& record, const NamingRecord& other) {
  record.runs += other.runs;
  record.rejected += other.rejected;
  record.right += other.right;
  record.unknown += other.unknown;
  record.wrong += other.wrong;
  for (const std::string& name : other.wrong_names) add_wrong_name(record, name);
}

}  // namespace

std::vector<NamingRecord> measure_naming(std::span<const MapRecord> maps,
                                         const NamingOptions& options, const Progress& progress,
                                         const Communicator& communicator) {
  std::vector<NamingRecord> records = no_runs();
  const auto parts = static_cast<double>(maps.size());
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto done = static_cast<double>(i);
    merge_naming(records, measure_naming_on(maps[i].map, options,
                                            part_of(progress, done / parts, (done + 1.0) / parts),
                                            communicator));
  }
  return records;
}

void merge_naming(std::vector<NamingRecord>& records, const std::vector<NamingRecord>& others) {
  if (records.empty()) {
    records = others;
    return;
  }
  for (std::size_t i = 0; i < others.size(); ++i) merge(records[i], others[i]);
}

}  // namespace lightproof
