#include "lightproof/core/failure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/out_of_memory.h"
#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// What is said of the exception that `work` ends with.
template <class Work>
Failure failure_in(const Work& work) {
  try {
    work();
  } catch (...) {
    return failure_of(std::current_exception());
  }
  return {kProgramFailed, "nothing was thrown"};
}

/// More than any address space has.
constexpr Extent kTooLarge = {1 << 30, 1 << 24};

TEST(Failure, OfBadInputIsItsMessage) {
  const Failure failure = failure_in([] { throw InputError("env.exr: is empty"); });
  EXPECT_EQ(failure.code, kInputFailed);
  EXPECT_EQ(failure.message, "env.exr: is empty");
}

TEST(Failure, OfTheProgramAsksForAReport) {
  for (const auto& work : {+[] { throw std::logic_error("vector::at"); }, +[] { throw 5; }}) {
    const Failure failure = failure_in(work);
    EXPECT_EQ(failure.code, kProgramFailed);
    EXPECT_THAT(failure.message, AllOf(HasSubstr("internal error"), HasSubstr("report"),
                                       HasSubstr("version"), HasSubstr("command line")));
  }
  EXPECT_THAT(failure_in([] { throw std::logic_error("vector::at"); }).message,
              HasSubstr("vector::at"));
}

TEST(Failure, OfMemorySaysHowMuchCouldNotBeHad) {
  const Failure table = failure_in([] { Grid<float>::without_values(kTooLarge); });
  EXPECT_EQ(table.code, kMemoryFailed);
  EXPECT_THAT(table.message,
              AllOf(HasSubstr("not enough memory"), HasSubstr("7.21e+07 GB")));  // 4 * 2^54
  const Failure unknown = failure_in([] { throw std::bad_alloc(); });
  EXPECT_EQ(unknown.code, kMemoryFailed);
  EXPECT_THAT(unknown.message, AllOf(HasSubstr("not enough memory"), Not(HasSubstr("B more"))));
}

TEST(Failure, OfMemoryNamesWhatItWasFor) {
  const auto on_a_thread = [] {
    parallel_for(4, [](std::size_t i) {
      if (i == 2) Grid<float>::without_values(kTooLarge);
    });
  };
  const auto purpose = [] { return std::string("the table of sky"); };
  const Failure failure = failure_in([&] { with_memory_for(purpose, on_a_thread); });
  EXPECT_EQ(failure.code, kMemoryFailed);
  EXPECT_THAT(failure.message, HasSubstr("for the table of sky: 7.21e+07 GB"));
  EXPECT_EQ(with_memory_for(purpose, [] { return 7; }), 7);
  // Known from further inside is better known.
  const Failure inner = failure_in([&] {
    with_memory_for([] { return std::string("everything"); },
                    [&] { with_memory_for(purpose, on_a_thread); });
  });
  EXPECT_EQ(inner.message, failure.message);
}

}  // namespace
}  // namespace lightproof
