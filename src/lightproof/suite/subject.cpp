#include "lightproof/suite/subject.h"

#include <vector>

namespace lightproof {

Subject subject_of(const SamplerInfo& sampler, Weighting weighting) {
  return {std::string(sampler.name), sampler.target(weighting), sampler.known_defects,
          sampler.inverts_shared_cdf, [&sampler, weighting](const EnvironmentMap& map) {
            return std::visit([](auto made) { return bound(std::move(made)); },
                              sampler.make(map, weighting));
          }};
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

}  // namespace lightproof
