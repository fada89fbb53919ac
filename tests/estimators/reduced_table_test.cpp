// Smaller tables of the map: what they add to the variance, against plain sums over texels, and
// that no light is lost to them.
#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/core/moments.h"
#include "lightproof/estimators/reduced_table.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/estimators/rounded_table.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/sphere_batch.h"

namespace lightproof {
namespace {

/// A map of values spread over so many powers of ten.
EnvironmentMap random_map(Extent extent, double decades) {
  EnvironmentMap map{"random", Grid<Rgb>(extent)};
  const RandomStream stream("reduced table", 1);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const auto index = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(extent.width) +
                         static_cast<std::uint64_t>(x);
      map.radiance(x, y) = Rgb(static_cast<float>(std::pow(10.0, decades * stream.point(index).s)));
    }
  }
  return map;
}

/// The sum of q CV^2 over blocks of whole texels, as it is written.
double plain_sum(const EnvironmentMap& map, int factor) {
  const Extent extent = map.radiance.extent();
  double whole = 0.0;
  double sum = 0.0;
  for (int top = 0; top < extent.height; top += factor) {
    for (int left = 0; left < extent.width; left += factor) {
      double area = 0.0;
      double light = 0.0;
      double square = 0.0;
      for (int y = top; y < top + factor; ++y) {
        for (int x = left; x < left + factor; ++x) {
          const double luminance = luminance_of(map.radiance(x, y), map.weights);
          area += texel_solid_angle(extent, y);
          light += luminance * texel_solid_angle(extent, y);
          square += luminance * luminance * texel_solid_angle(extent, y);
        }
      }
      whole += light;
      if (light > 0.0) sum += light * (square * area / (light * light) - 1.0);
    }
  }
  return sum / whole;
}

TEST(ReducedTable, AddsTheVarianceInsideItsBlocks) {
  for (const double decades : {0.5, 4.0}) {
    const EnvironmentMap map = random_map({64, 32}, decades);
    for (const int factor : {2, 4, 8, 16}) {
      const double expected = plain_sum(map, factor);
      EXPECT_NEAR(reduced_table_variance(map, factor), expected, 1e-12 * (1.0 + expected));
    }
    EXPECT_NEAR(reduced_table_variance(map, 1), 0.0, 1e-12);
  }
}

// 1 everywhere but in one texel of a block of 2 x 2, which is dark: in this block the mean is less
// than 1, and CV^2 is the dark share over the lit one.
TEST(ReducedTable, OfOneDarkTexelHasAClosedForm) {
  EnvironmentMap map = make_synthetic_map("constant", {16, 8});
  map.radiance(4, 6) = Rgb(0.0F);
  const double dark = texel_solid_angle({16, 8}, 6);
  const double block = 2.0 * (dark + texel_solid_angle({16, 8}, 7));
  const double q = (block - dark) / (kSphere - dark);
  EXPECT_NEAR(reduced_table_variance(map, 2), q * dark / (block - dark), 1e-14);
}

// Edges of blocks that cut texels: all integrals are those of the map.
TEST(ReducedTable, KeepsAllLightWhereBlocksCutTexels) {
  const EnvironmentMap map = random_map({19, 11}, 2.0);
  const BlockSums texels = block_sums(map, {19, 11});
  const BlockSums blocks = block_sums(map, reduced_extent({19, 11}, 4));
  ASSERT_EQ(blocks.light.extent(), (Extent{5, 3}));
  const auto sum = [](std::span<const double> values) {
    double all = 0.0;
    for (const double value : values) all += value;
    return all;
  };
  EXPECT_NEAR(sum(blocks.light.values()) / sum(texels.light.values()), 1.0, 1e-14);
  EXPECT_NEAR(sum(blocks.square.values()) / sum(texels.square.values()), 1.0, 1e-14);
  EXPECT_NEAR(5.0 * sum(blocks.solid_angle), kSphere, 1e-13);
}

/// Draws ∫ L by a source as if k were 1: mean and variance of single samples.
template <class Draw>
Moments estimates_of_light(const EnvironmentMap& map, const Draw& draw, std::size_t count) {
  Moments moments;
  LightSamples samples;
  const RandomStream stream("light", 1);
  for (std::size_t done = 0; done < count; done += samples.count) {
    samples.count = LightSamples::kCapacity;
    draw(BatchPoints(stream, done), samples);
    for (std::size_t i = 0; i < samples.count; ++i) {
      const Rgb texel = map.radiance(samples.column[i], samples.row[i]);
      moments.add(luminance_of(texel, map.weights) / samples.pdf[i]);
    }
  }
  return moments;
}

/// Judges a source by 2^18 samples: mean within z = 6 of its exact standard error; the variance
/// within z = 8 of the one that its measured fourth moment gives.
void expect_light(const EnvironmentMap& map, const PreparedSource& source, double variance) {
  const double light = block_sums(map, {1, 1}).light(0, 0);
  const auto at = source.bind(Lambert{1.0});
  const ShadingPoint point = {glm::dvec3(0.0), frame_around({0.0, 0.0, 1.0}), {0.0, 0.0, 1.0}};
  const auto draw = at(point);
  const Moments moments = estimates_of_light(map, draw, std::size_t{1} << 18U);
  const auto count = static_cast<double>(moments.count());
  EXPECT_NEAR(moments.mean() / light, 1.0, 6.0 * std::sqrt(variance / count) + 1e-6);
  const double measured = moments.variance();
  const double error = std::sqrt((moments.fourth_central() - measured * measured) / count);
  EXPECT_NEAR(measured / (light * light), variance,
              8.0 * error / (light * light) + 1e-6 * (1.0 + variance));
}

TEST(ReducedTable, DrawsWithTheVarianceThatItSays) {
  for (const Extent extent : {Extent{64, 32}, Extent{50, 27}}) {
    const EnvironmentMap map = random_map(extent, 1.5);
    for (const int factor : {2, 4, 8, 16}) {
      expect_light(map, reduced_table_source(map, factor), reduced_table_variance(map, factor));
    }
  }
}

TEST(RoundedTable, DrawsWithTheVarianceThatItSays) {
  for (const Extent extent : {Extent{64, 32}, Extent{50, 27}}) {
    const EnvironmentMap map = random_map(extent, 1.5);
    for (const MassForm form : {MassForm::half, MassForm::byte}) {
      expect_light(map, rounded_table_source(map, form), rounded_table_variance(map, form));
    }
  }
}

// m^2/M less 1, as it is written; half of the last bit is 1/2048 of a half float, 1/16 of a byte's.
TEST(RoundedTable, AddsWhatItsRoundingAdds) {
  const EnvironmentMap map = random_map({64, 32}, 3.0);
  for (const MassForm form : {MassForm::half, MassForm::byte}) {
    const RoundedTable table(map, form);
    const BlockSums texels = block_sums(map, {64, 32});
    double whole = 0.0;
    for (const double light : texels.light.values()) whole += light;
    double squares = 0.0;
    double masses = 0.0;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 64; ++x) {
        const double share = texels.light(x, y) / whole;
        squares += share * share / table.mass(x, y);
        masses += table.mass(x, y);
      }
    }
    EXPECT_NEAR(masses, 1.0, 1e-12);
    EXPECT_NEAR(rounded_table_variance(map, form), squares - 1.0, 1e-12);
    const double step = form == MassForm::half ? 1.0 / 2048.0 : 1.0 / 16.0;
    EXPECT_LT(rounded_table_variance(map, form), 4.0 * step * step);
    EXPECT_GT(rounded_table_variance(map, form), 0.01 * step * step);
  }
}

TEST(RoundedTable, LosesNoTexelWithLight) {
  for (const MassForm form : {MassForm::half, MassForm::byte}) {
    EnvironmentMap map = random_map({40, 20}, 30.0);
    map.radiance(7, 7) = Rgb(0.0F);
    const RoundedTable table(map, form);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 40; ++x) {
        EXPECT_EQ(table.mass(x, y) > 0.0, x != 7 || y != 7) << x << ", " << y;
      }
    }
  }
}

TEST(SmallerTables, RefuseBlackMapsAndTakeLessMemory) {
  const EnvironmentMap black{"black", Grid<Rgb>({8, 4})};
  EXPECT_THROW(reduced_table_source(black, 2), InputError);
  EXPECT_THROW(rounded_table_source(black, MassForm::half), InputError);
  EXPECT_EQ(reduced_table_variance(black, 2), 0.0);
  EXPECT_EQ(rounded_table_variance(black, MassForm::byte), 0.0);
  const EnvironmentMap map = make_synthetic_map("gradient", {256, 128});
  const auto bytes = [&](std::string_view name) {
    return estimator_by_name(name).prepare(map).bytes;
  };
  const auto texels = static_cast<double>(map.radiance.extent().count());
  EXPECT_LT(bytes("environment B alias 1/2") * 3, bytes("environment B alias"));
  EXPECT_LT(bytes("environment B alias 1/16") * 50, bytes("environment B alias"));
  EXPECT_NEAR(static_cast<double>(bytes("environment B half")) / texels, 2.25, 0.25);
  EXPECT_NEAR(static_cast<double>(bytes("environment B 8-bit")) / texels, 1.25, 0.25);
}

}  // namespace
}  // namespace lightproof
