// A value for every run of a gate.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lightproof/gate/test_case.h"
#include "lightproof/gate/test_run.h"

namespace lightproof {

/// Where a run stands among test cases and their instances.
struct RunIndex {
  std::size_t test_case;
  std::size_t instance;

  TestRun in(std::span<const TestCase> test_cases, std::uint64_t seed) const {
    const TestCase& of = test_cases[test_case];
    return {&of, &of.instances[instance], seed};
  }
};

/// A value for every run, by test case and instance.
template <class Value>
class ByRun {
 public:
  explicit ByRun(std::span<const TestCase> test_cases) {
    for (const TestCase& test_case : test_cases) values_.emplace_back(test_case.instances.size());
  }

  Value& operator[](RunIndex at) { return values_[at.test_case][at.instance]; }
  const Value& operator[](RunIndex at) const { return values_[at.test_case][at.instance]; }

  /// visit(index, value) of all of them, in order.
  template <class Visit>
  void for_each(const Visit& visit) {
    for (std::size_t i = 0; i < values_.size(); ++i) for_each_of(i, visit);
  }

  /// visit(index, value) of one test case's, in order.
  template <class Visit>
  void for_each_of(std::size_t test_case, const Visit& visit) {
    std::vector<Value>& values = values_[test_case];
    for (std::size_t k = 0; k < values.size(); ++k) visit(RunIndex{test_case, k}, values[k]);
  }

 private:
  std::vector<std::vector<Value>> values_;
};

}  // namespace lightproof
