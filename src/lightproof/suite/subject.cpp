#include "lightproof/suite/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "lightproof/core/out_of_memory.h"
#include "lightproof/suite/alternative_law.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

/// With lack of memory laid to this part of a gate over the map.
template <class Work>
auto on(const EnvironmentMap& map, std::string_view part, const Work& work) {
  const auto purpose = [&] {
    return fmt::format("{} {} ({}x{})", part, map.name, map.radiance.extent().width,
                       map.radiance.extent().height);
  };
  return with_memory_for(purpose, work);
}

std::vector<Alternative> alternatives_on(const EnvironmentMap& map, TargetDensity target) {
  const auto declared = std::make_shared<const Grid<double>>(reference::texel_masses(map, target));
  std::vector<Alternative> alternatives;
  for (const AlternativeLaw& law : alternative_laws()) {
    if (law.is_example) continue;
    alternatives.push_back({law.name, law.diagnosis, [declared, &map, target, masses = law.masses] {
                              return masses({declared.get(), &map, target});
                            }});
  }
  return alternatives;
}

Candidate candidate_of(const Subject& subject, const EnvironmentMap& map) {
  return {.name = subject.name,
          .known_defects = subject.known_defects,
          .bind = [bind = subject.bind, name = subject.name,
                   &map] { return on(map, name + " on", [&] { return bind(map); }); },
          .resolution = subject.resolution,
          .rounding = subject.rounding != nullptr ? subject.rounding(map.radiance.extent())
                                                  : MassRounding{},
          .inverts_rows = subject.inverts_rows,
          .has_twin = subject.inverts_shared_cdf};
}

std::function<BoundSampler()> linear_scan_of(const EnvironmentMap& map, TargetDensity target) {
  return [&map, target] {
    return on(map, "linear_scan on", [&] { return bound(LinearScan(map, target)); });
  };
}

/// The target densities of the subjects on a map, each once.
std::vector<TargetDensity> targets_of(std::span<const Subject> subjects,
                                      const EnvironmentMap& map) {
  std::vector<TargetDensity> targets;
  for (const Subject& subject : subjects) {
    const TargetDensity target = on_map(subject.target, map);
    if (std::find(targets.begin(), targets.end(), target) == targets.end()) {
      targets.push_back(target);
    }
  }
  return targets;
}

/// What all subjects of one target density on a map are held against.
Problem problem_of(const EnvironmentMap& map, TargetDensity target) {
  return {map.name,
          to_string(target.weighting),
          map.source,
          [&map, target] {
            return on(map, "the exact law of", [&] {
              return std::make_shared<const Expectation>(expectation_of(map, target));
            });
          },
          [&map, target] {
            return on(map, "other laws of", [&] { return alternatives_on(map, target); });
          },
          {}};
}

}  // namespace

Subject subject_of(const SamplerInfo& sampler, Weighting weighting) {
  return {std::string(sampler.name),
          sampler.target(weighting),
          sampler.known_defects,
          sampler.inverts_shared_cdf,
          [make = sampler.make, weighting](const EnvironmentMap& map) {
            return std::visit([](auto made) { return bound(std::move(made)); },
                              make(map, weighting));
          },
          sampler.resolution,
          sampler.inverts_rows,
          sampler.rounding};
}

std::vector<Subject> all_subjects() {
  std::vector<Subject> subjects;
  for (const SamplerInfo& sampler : samplers()) {
    for (const Weighting weighting : {Weighting::A, Weighting::B}) {
      subjects.push_back(subject_of(sampler, weighting));
    }
  }
  return subjects;
}

std::vector<Problem> problems_of(std::span<const EnvironmentMap> maps,
                                 std::span<const Subject> subjects) {
  std::vector<Problem> problems;
  for (const EnvironmentMap& map : maps) {
    for (const TargetDensity target : targets_of(subjects, map)) {
      Problem problem = problem_of(map, target);
      for (const Subject& subject : subjects) {
        if (!(on_map(subject.target, map) == target)) continue;
        problem.candidates.push_back(candidate_of(subject, map));
        if (subject.inverts_shared_cdf) problem.twin = linear_scan_of(map, target);
      }
      problems.push_back(std::move(problem));
    }
  }
  return problems;
}

}  // namespace lightproof
