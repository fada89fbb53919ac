// The exact sides of many test cases, shared by all stages of a run.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "lightproof/gate/expectation.h"
#include "lightproof/gate/test_case.h"

namespace lightproof {

/// Exact sides of test cases, each computed when it is first asked for. They are kept while all of
/// them together have few enough texels; beyond that they last as long as whoever asked.
class Expectations {
 public:
  explicit Expectations(std::span<const TestCase> test_cases)
      : test_cases_(test_cases), kept_(test_cases.size()) {}

  /// To be called for one test case by one thread at a time.
  std::shared_ptr<const Expectation> of(std::size_t test_case);

 private:
  /// About 12 bytes are kept of a texel, and the map: 24 MB.
  static constexpr std::size_t kMostTexels = std::size_t{1} << 20U;

  std::span<const TestCase> test_cases_;
  std::vector<std::shared_ptr<const Expectation>> kept_;
  std::atomic<std::size_t> texels_ = 0;
};

}  // namespace lightproof
