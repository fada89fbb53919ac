// Luminance weights from primaries, against the values that the standards print.
#include "lightproof/image/chromaticities.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightproof {
namespace {

struct Space {
  std::string_view name;
  Chromaticities chromaticities;
  LuminanceWeights weights;
  double digits;  ///< half a unit of the last one that is printed
};

// Rec. 709 and Rec. 2020: ITU-R BT.709-6 and BT.2020-2. AP0 and AP1: SMPTE ST 2065-1 and the ACES
// documents. Radiance: color.h (CIE_rf, CIE_gf, CIE_bf). Adobe RGB (1998), section 4.3.5.3.
const Space kSpaces[] = {
    {"Rec. 709", {{.64, .33}, {.30, .60}, {.15, .06}, {.3127, .3290}}, kRec709, 5e-5},
    {"Rec. 2020",
     {{.708, .292}, {.170, .797}, {.131, .046}, {.3127, .3290}},
     {0.2627, 0.6780, 0.0593},
     5e-5},
    {"ACEScg",
     {{.713, .293}, {.165, .830}, {.128, .044}, {.32168, .33767}},
     {0.2722287168, 0.6740817658, 0.0536895174},
     5e-10},
    {"ACES 2065-1 (AP0)",
     {{.7347, .2653}, {0.0, 1.0}, {.0001, -.0770}, {.32168, .33767}},
     {0.3439664498, 0.7281660966, -0.0721325464},
     5e-10},
    // ICC profile of sRGB, the middle row of its matrix to the D50 connection space.
    {"Rec. 709 adapted to D50",
     {{.6484, .3309}, {.3212, .5979}, {.1559, .0660}, {.3457, .3585}},
     {0.2225, 0.7169, 0.0606},
     1e-4},
    {"Radiance",
     {{.640, .330}, {.290, .600}, {.150, .060}, {1.0 / 3.0, 1.0 / 3.0}},
     {0.265, 0.670, 0.065},
     5e-4},
    {"Adobe RGB (1998)",
     {{.64, .33}, {.21, .71}, {.15, .06}, {.3127, .3290}},
     {0.29734, 0.62736, 0.07529},
     5e-6},
};

TEST(Chromaticities, GiveTheWeightsOfTheStandards) {
  for (const Space& space : kSpaces) {
    const LuminanceWeights weights = luminance_weights(space.chromaticities);
    EXPECT_NEAR(weights.red, space.weights.red, space.digits) << space.name;
    EXPECT_NEAR(weights.green, space.weights.green, space.digits) << space.name;
    EXPECT_NEAR(weights.blue, space.weights.blue, space.digits) << space.name;
    EXPECT_NEAR(weights.red + weights.green + weights.blue, 1.0, 1e-12) << space.name;
  }
}

TEST(Chromaticities, AreKnownByNameWhenRoundedToThreeDigits) {
  for (const Space& space : kSpaces) {
    Chromaticities rounded = space.chromaticities;
    for (auto* xy : {&rounded.red, &rounded.green, &rounded.blue, &rounded.white}) {
      for (double& v : *xy) v = std::round(1000.0 * v) / 1000.0;
    }
    EXPECT_EQ(name_of(rounded), space.name);
    rounded.red[0] += 0.003;
    EXPECT_EQ(name_of(rounded), "");
  }
}

TEST(Chromaticities, ThatSpanNothingMakeNoSpace) {
  const Chromaticities rec709 = kSpaces[0].chromaticities;
  EXPECT_TRUE(is_colour_space(rec709));
  Chromaticities line = rec709;
  line.green = line.red;
  EXPECT_FALSE(is_colour_space(line));
  Chromaticities dark = rec709;
  dark.white = {0.3, 0.0};
  EXPECT_FALSE(is_colour_space(dark));
}

}  // namespace
}  // namespace lightproof
