#include "lightproof/prefilter/fourier_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lightproof/core/measure.h"
#include "lightproof/core/random.h"

namespace lightproof {
namespace {

using Complex = std::complex<double>;

std::vector<Complex> noise(std::size_t size) {
  const RandomStream stream("FourierTransform.noise", 1);
  std::vector<Complex> values;
  for (std::size_t i = 0; i < size; ++i) {
    const SquarePoint u = stream.point(i);
    values.emplace_back(u.s - 0.5, u.t - 0.5);
  }
  return values;
}

// Powers of two and products of small factors; primes and products of primes.
constexpr std::size_t kSizes[] = {1, 2, 3, 4, 7, 16, 30, 77, 97, 128, 257, 500};

TEST(FourierTransform, IsItsSum) {
  for (const std::size_t size : kSizes) {
    const std::vector<Complex> in = noise(size);
    for (const bool inverse : {false, true}) {
      std::vector<Complex> out(size);
      FourierTransform(size, inverse)(in, out);
      for (std::size_t k = 0; k < size; ++k) {
        Complex sum = 0.0;
        for (std::size_t n = 0; n < size; ++n) {
          const double turns = static_cast<double>(n * k % size) / static_cast<double>(size);
          sum += in[n] * std::polar(1.0, (inverse ? 2.0 : -2.0) * kPi * turns);
        }
        // Roundings of up to `size` terms below 1.
        EXPECT_NEAR(std::abs(out[k] - sum), 0.0, 1e-15 * static_cast<double>(size) + 1e-14)
            << size << ", " << k;
      }
    }
  }
}

TEST(FourierTransform, IsUndoneByItsInverse) {
  for (const std::size_t size : {1999U, 2048U, 6000U}) {
    const std::vector<Complex> in = noise(size);
    std::vector<Complex> there(size);
    std::vector<Complex> back(size);
    FourierTransform(size, false)(in, there);
    FourierTransform(size, true)(there, back);
    for (std::size_t n = 0; n < size; ++n) {
      EXPECT_NEAR(std::abs(back[n] / static_cast<double>(size) - in[n]), 0.0, 1e-13);
    }
  }
}

}  // namespace
}  // namespace lightproof
