#include "lightproof/core/random_batch.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/core/kinds_of_vectors.h"
#include "tests/core/whole_vectors.h"

namespace lightproof {
namespace {

// Both words of the counter change within the batch.
constexpr std::uint64_t kFirst = (std::uint64_t{1} << 32U) - 100;

RandomStream stream() { return {"random batch", 7, (std::uint64_t{5} << 32U) + 3}; }

TEST(RandomBatch, IsTheStreamsPointsBitForBit) {
  for_each_kind_of_vector([&](const char* vectors) {
    for (const std::size_t size : {0U, 1U, 8U, 13U, 255U, 256U, 257U, 300U}) {
      std::vector<SquarePoint> points(size);
      fill_points(stream(), kFirst, points);
      std::vector<double> s(size);
      std::vector<double> t(size);
      fill_points(stream(), kFirst, s, t);
      for (std::size_t i = 0; i < size; ++i) {
        const SquarePoint expected = stream().point(kFirst + i);
        EXPECT_EQ(points[i], expected) << vectors << ", point " << i;
        EXPECT_EQ(s[i], expected.s) << vectors << ", point " << i;
        EXPECT_EQ(t[i], expected.t) << vectors << ", point " << i;
      }
    }
  });
}

TEST(RandomBatch, IsDrawnByVectors) {
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    for (const std::size_t size : {0U, 8U, 31U, 1003U}) {
      std::vector<double> s(size);
      std::vector<double> t(size);
      expect_whole_vectors(vectors, fill_points(stream(), kFirst, s, t), size);
      std::vector<SquarePoint> points(size);
      expect_whole_vectors(vectors, fill_points(stream(), kFirst, points), size);
    }
  });
}

}  // namespace
}  // namespace lightproof
