// The tests of a result that rejected, by name.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/gate_result.h"

namespace lightproof::test {

/// full_name() of every test that rejected, in the order of the records.
inline std::vector<std::string> rejections(const GateResult& result) {
  std::vector<std::string> names;
  for (const TestRecord& test : result.tests) {
    if (test.outcome == Outcome::reject) names.push_back(full_name(test.test));
  }
  return names;
}

}  // namespace lightproof::test
