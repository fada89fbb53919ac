// Somebody else's test program: one line of GoogleTest for a sampler. With BROKEN it claims the
// density that renderers use, which uniform samples have on no map, and must fail.
#include <gtest/gtest.h>

#include "lightproof/testing/gtest.h"

namespace {

using namespace lightproof;

/// Uniform over the sphere, with its density per steradian.
struct UniformSphere {
  explicit UniformSphere(const EnvironmentMap& /*map*/) {}
  struct Sample {
    Direction direction;
    PerSteradian pdf;
  };
  Sample sample(SquarePoint u) const {
    const double z = 2.0 * u.t - 1.0;
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    const double phi = kPi - 2.0 * kPi * u.s;
    return {{radius * std::cos(phi), radius * std::sin(phi), z}, {0.25 / kPi}};
  }
  PerSteradian pdf(Direction /*direction*/) const { return {0.25 / kPi}; }
};

EnvironmentMap grey_map() { return {"grey", Grid<Rgb>({64, 32}, Rgb(0.5F)), {}}; }

#ifdef BROKEN
LIGHTPROOF_TEST_SAMPLER(UniformSphere);
#else
LIGHTPROOF_TEST_SAMPLER(UniformSphere,
                        {.density_space = DensitySpace::solid_angle, .maps = {grey_map()}});
#endif

}  // namespace
