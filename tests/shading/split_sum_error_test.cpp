#include "lightproof/shading/split_sum_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include <chrono>
#include "lightproof/core/measure.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {
TEST(Probe, Times) {
  for (const char* name : {"gradient", "sun-sky", "checker"}) {
    const auto power = luminance_power(make_synthetic_map(name, {512, 256}));
    for (double r : {0.1, 0.2, 0.3, 0.5, 1.0}) {
      for (double a : {0.0, 40.0, 60.0, 80.0, 85.0}) {
        for (double f0 : {0.04, 1.0}) {
        const auto start = std::chrono::steady_clock::now();
        const auto kernel = split_sum_kernel(r, std::cos(a * kPi / 180), f0);
        const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const auto e = split_sum_error(kernel, power);
        printf("%s R %g angle %g f0 %g: w %.6f l0 %g beyond %g rmse %.5f left %.5f  %.3fs\n", name, r, a, f0, kernel.reflectance,
          kernel.difference.of_degree[0], kernel.difference.beyond, e.rmse, e.left_out, s);
      }}
    }
  }
}
}  // namespace
}  // namespace lightproof
