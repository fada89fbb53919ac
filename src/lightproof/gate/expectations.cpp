#include "lightproof/gate/expectations.h"

namespace lightproof {

std::shared_ptr<const Expectation> Expectations::of(std::size_t test_case) {
  if (kept_[test_case]) return kept_[test_case];
  std::shared_ptr<const Expectation> made = test_cases_[test_case].expectation();
  const std::size_t texels = made->masses.values().size();
  if (texels_.fetch_add(texels) + texels <= kMostTexels) {
    kept_[test_case] = made;
  } else {
    texels_.fetch_sub(texels);
  }
  return made;
}

}  // namespace lightproof
