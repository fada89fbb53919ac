// Every kind of vector of this processor, one after the other.
#pragma once

#include <hwy/highway.h>

#include <cstdint>

namespace lightproof {

/// Calls body(name) once for every kind of vector that this processor has, with only that one; the
/// last is none at all.
template <class Body>
void for_each_kind_of_vector(const Body& body) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    body(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace lightproof
