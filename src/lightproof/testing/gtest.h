// The gate as a GoogleTest of your own sampler, in one line at the level of a namespace:
//
//   #include <gtest/gtest.h>
//   #include "lightproof/testing/gtest.h"
//   LIGHTPROOF_TEST_SAMPLER(MySampler)
//   LIGHTPROOF_TEST_SAMPLER(OtherSampler, {.density_space = lightproof::DensitySpace::texture})
//
// Link to lightproof::testing and GTest::gtest_main. What a sampler must offer is in
// sampler_verdict.h.
#pragma once

#include <gtest/gtest.h>

#include "lightproof/testing/sampler_verdict.h"

/// Defines the test Lightproof.Sampler: it fails if the gate does not accept the sampler, with
/// the gate's table. What follows the type is a lightproof::SamplerTestOptions.
#define LIGHTPROOF_TEST_SAMPLER(Sampler, ...)                               \
  TEST(Lightproof, Sampler) {                                               \
    const lightproof::SamplerTestOptions options __VA_OPT__(= __VA_ARGS__); \
    const lightproof::SamplerVerdict verdict =                              \
        lightproof::judge_sampler<Sampler>(#Sampler, options);              \
    EXPECT_TRUE(verdict.is_accepted) << verdict.text;                       \
  }                                                                         \
  static_assert(true)
