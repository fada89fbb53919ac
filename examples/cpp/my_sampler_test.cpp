#include "my_sampler.h"

#include <gtest/gtest.h>

#include "lightproof/testing/gtest.h"

LIGHTPROOF_TEST_SAMPLER(MySampler);
