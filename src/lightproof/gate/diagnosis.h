// What a rejected sampler looks like. A defect is named only if the samples do not reject it: a
// wrong name is worse than none. Where none fits, the diagnosis says what is off, and by how much.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lightproof/gate/draws.h"
#include "lightproof/gate/exact_checks.h"
#include "lightproof/gate/test_case.h"
#include "lightproof/results/gate_result.h"

namespace lightproof {

/// A kind of defect that is no other distribution over the texels.
struct Signature {
  std::string_view name;
  std::string_view diagnosis;
};

/// All kinds of defects that are no other distribution over the texels.
std::span<const Signature> signatures();

/// What was seen of a run, some of whose judged records are rejected.
struct Evidence {
  std::span<const TestRecord> records;
  const Draws* draws;
  const Inspection* inspection;
};

/// The rejections of several samplers of one test case, in their order. `expectation` is the
/// test case's. What the test case's alternatives would give is computed once for all of them.
std::vector<Rejection> diagnose(const TestCase& test_case, const Expectation& expectation,
                                std::span<const Evidence> rejected);

}  // namespace lightproof
