#include "lightproof/mutants/naming.h"

#include <algorithm>

#include "lightproof/mutants/mutant.h"
#include "lightproof/suite/gate.h"

namespace lightproof {
namespace {

std::vector<Subject> all_mutants() {
  std::vector<Subject> subjects;
  for (const Mutant& mutant : mutants()) {
    for (const Weighting weighting : {Weighting::A, Weighting::B}) {
      subjects.push_back(subject_of(mutant, weighting));
    }
  }
  return subjects;
}

void count(std::vector<NamingRecord>& records, const Rejection& rejection) {
  NamingRecord& record = *std::find_if(
      records.begin(), records.end(),
      [&](const NamingRecord& candidate) { return candidate.mutant == rejection.sampler; });
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

std::vector<Problem> problems_for_all_seeds(const EnvironmentMap& map,
                                            std::span<const Subject> subjects) {
  std::vector<Problem> problems = problems_of({&map, 1}, subjects);
  for (Problem& problem : problems) problem = inspected_once(std::move(problem));
  return problems;
}

}  // namespace

std::vector<NamingRecord> measure_naming(std::span<const MapRecord> maps,
                                         const NamingOptions& options, const Progress& progress) {
  std::vector<NamingRecord> records;
  for (const Mutant& mutant : mutants()) {
    records.push_back({.mutant = std::string(mutant.name),
                       .expected = std::string(mutant.diagnosis),
                       .runs = 2 * maps.size() * options.seeds});
  }
  const std::vector<Subject> subjects = all_mutants();
  const auto rounds = static_cast<double>(maps.size() * options.seeds);
  double done = 0.0;
  for (const MapRecord& map : maps) {
    const std::vector<Problem> problems = problems_for_all_seeds(map.map, subjects);
    for (std::uint64_t i = 0; i < options.seeds; ++i, ++done) {
      const GateResult result =
          run_gate(problems, {.samples = options.samples, .seed = options.seed + i},
                   part_of(progress, done / rounds, (done + 1.0) / rounds));
      for (const Rejection& rejection : result.rejections) count(records, rejection);
    }
  }
  return records;
}

}  // namespace lightproof
