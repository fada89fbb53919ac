#include "lightproof/core/memo.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

constexpr auto kSquare = [](const auto& arguments) { return arguments[0] * arguments[0]; };

TEST(Memo, ComputesAValueOnceForEachArgument) {
  Memo<2> product;
  int computed = 0;
  const auto compute = [&](const auto& arguments) {
    ++computed;
    return arguments[0] * arguments[1];
  };
  EXPECT_EQ(product({3.0, 5.0}, compute), 15.0);
  EXPECT_EQ(product({3.0, 5.0}, compute), 15.0);
  EXPECT_EQ(product({5.0, 3.0}, compute), 15.0);
  EXPECT_EQ(computed, 2);
}

TEST(Memo, TakesNotANumberForNoOtherArgument) {
  Memo<1> square;
  EXPECT_EQ(square({3.0}, kSquare), 9.0);
  EXPECT_TRUE(std::isnan(square({std::nan("")}, kSquare)));
  EXPECT_EQ(square({3.0}, kSquare), 9.0);
}

TEST(Memo, ForgetsAllOnceItIsFull) {
  Memo<1> square(2);
  int computed = 0;
  const auto compute = [&](const auto& arguments) {
    ++computed;
    return kSquare(arguments);
  };
  for (const double x : {1.0, 2.0, 3.0}) EXPECT_EQ(square({x}, compute), x * x);
  EXPECT_EQ(square({3.0}, compute), 9.0);
  EXPECT_EQ(computed, 3);
  EXPECT_EQ(square({1.0}, compute), 1.0);
  EXPECT_EQ(computed, 4);
}

TEST(Memo, GivesManyThreadsTheSameValues) {
  Memo<1> square(16);
  std::atomic<int> wrong = 0;
  parallel_for(10000, [&](std::size_t i) {
    const double x = static_cast<double>(i % 40);
    if (square({x}, kSquare) != x * x) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace lightproof
