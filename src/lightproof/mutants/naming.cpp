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

void count(NamingRecord& record, const Rejection& rejection) {
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
  const std::size_t rounds = maps.size() * options.seeds;
  std::size_t done = 0;
  for (const MapRecord& map : maps) {
    std::vector<Problem> problems;
    for (Problem& problem : problems_of({&map.map, 1}, subjects)) {
      problems.push_back(inspected_once(std::move(problem)));
    }
    for (std::uint64_t i = 0; i < options.seeds; ++i, ++done) {
      const auto parts = static_cast<double>(rounds);
      const GateResult result =
          run_gate(problems, {.samples = options.samples, .seed = options.seed + i},
                   part_of(progress, static_cast<double>(done) / parts,
                           static_cast<double>(done + 1) / parts));
      for (const Rejection& rejection : result.rejections) {
        const auto record = std::find_if(
            records.begin(), records.end(),
            [&](const NamingRecord& candidate) { return candidate.mutant == rejection.sampler; });
        count(*record, rejection);
      }
    }
  }
  return records;
}

}  // namespace lightproof
