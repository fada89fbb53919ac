// Claims about every sampler that inverts the shared table.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lightproof/cases/adversarial_points.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/image/look_up.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/registry.h"
#include "reference/slow_sampler.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

class InversionOnMaps : public testing::TestWithParam<std::tuple<std::string_view, DensitySpace>> {
 protected:
  static constexpr Extent kSizes[] = {{1, 1}, {2, 1}, {1, 5}, {31, 15}, {33, 65}, {64, 32}};
};

TEST_P(InversionOnMaps, EverySearchReturnsTheSameTexelAndPosition) {
  const auto [name, density_space] = GetParam();
  for (const Extent extent : kSizes) {
    const EnvironmentMap map = make_synthetic_map(name, extent);
    const LinearScan scan(map, {density_space, kRec709});
    const BinarySearch search(map, {density_space, kRec709});
    const Eytzinger tree(map, {density_space, kRec709});
    const GuideTable guide(map, {density_space, kRec709});
    std::vector<SquarePoint> points = adversarial_points(scan.table());
    const RandomStream stream("every search", 1);
    for (std::uint64_t i = 0; i < 10000; ++i) points.push_back(stream.point(i));
    for (const SquarePoint u : points) {
      const TexelSample a = scan.sample(u);
      for (const TexelSample& b : {search.sample(u), tree.sample(u), guide.sample(u)}) {
        ASSERT_EQ(a.x, b.x);
        ASSERT_EQ(a.y, b.y);
        ASSERT_EQ(a.at, b.at);
        ASSERT_EQ(a.pdf.value, b.pdf.value);
      }
    }
  }
}

TEST_P(InversionOnMaps, SamplesOfEveryCorrectSamplerStayInsideATexelWithLight) {
  const auto [name, density_space] = GetParam();
  for (const Extent extent : kSizes) {
    const EnvironmentMap map = make_synthetic_map(name, extent);
    const std::vector<SquarePoint> points =
        adversarial_points(CdfTable(map, {density_space, kRec709}));
    for (const SamplerInfo& info : samplers()) {
      if (info.known_defects) continue;
      SCOPED_TRACE(info.name);
      const Grid<double> luminance = luminance_of(map, info.weights);
      const auto stay_inside = [&](const auto& sampler) {
        for (const SquarePoint u : points) {
          const TexelSample sample = sampler.sample(u);
          ASSERT_EQ(cell_of(sample.at.s, extent.width), sample.x) << u.s << ", " << u.t;
          ASSERT_EQ(cell_of(sample.at.t, extent.height), sample.y) << u.s << ", " << u.t;
          ASSERT_GT(sample.at.t, 0.0);
          ASSERT_LT(sample.at.t, 1.0);
          ASSERT_GT(look_up(luminance, info.lookup, sample.at), 0.0);
          ASSERT_TRUE(sample.pdf.value > 0.0 && std::isfinite(sample.pdf.value));
          // Of the sine of a t that is rounded to 2^-53, near a pole.
          const double near = std::min(sample.at.t, 1.0 - sample.at.t);
          ASSERT_NEAR(sampler.pdf(sample.at).value / sample.pdf.value, 1.0, 1e-12 + 0x1p-52 / near);
        }
      };
      std::visit(stay_inside, info.make(map, density_space));
    }
  }
}

TEST_P(InversionOnMaps, TexelsAreTheReferencesAwayFromItsEntries) {
  const auto [name, density_space] = GetParam();
  const Extent extent = {64, 32};
  const EnvironmentMap map = make_synthetic_map(name, extent);
  const BinarySearch sampler(map, {density_space, kRec709});
  const reference::SlowSampler slow(map, {density_space, kRec709});
  const RandomStream stream("reference", 1);
  // A CDF entry of the table is less than one unit per cell from the exact one.
  const double tolerance = (extent.width + 1) * 0x1p-31;
  int compared = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const SquarePoint u = stream.point(i);
    if (slow.near_entry(u, tolerance)) continue;
    const TexelSample sample = sampler.sample(u);
    ++compared;
    ASSERT_EQ((reference::Texel{sample.x, sample.y}), slow.sample(u)) << u.s << ", " << u.t;
  }
  EXPECT_GT(compared, 19900);
}

INSTANTIATE_TEST_SUITE_P(All, InversionOnMaps,
                         testing::Combine(testing::Values("constant", "one-texel", "gradient",
                                                          "cosine-lobe", "step", "sun-sky",
                                                          "checker", "black-first-row"),
                                          testing::ValuesIn(kDensitySpaces)));

// In u.t along the map, and in u.s across the row that was found. What is not monotone must be seen
// not to be, or nothing was tested.
TEST(Registry, MonotoneSamplersKeepTheOrderOfRandomNumbers) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  constexpr int kSteps = 20000;
  for (const SamplerInfo& info : samplers()) {
    if (info.known_defects) continue;
    for (const DensitySpace density_space : kDensitySpaces) {
      const auto turns_back = [](const auto& sampler) {
        int turns = 0;
        SquarePoint last = {0.0, 0.0};
        for (int i = 0; i < kSteps; ++i) {
          const double u = static_cast<double>(i) / kSteps;
          const SquarePoint at = {sampler.sample({u, 0.7}).at.s, sampler.sample({0.5, u}).at.t};
          turns += at.s < last.s || at.t < last.t ? 1 : 0;
          last = at;
        }
        return turns;
      };
      const int turns = std::visit(turns_back, info.make(map, density_space));
      EXPECT_EQ(turns == 0, info.monotone) << info.name << ": " << turns;
    }
  }
}

// Sums are floats: each of seven levels rounds twice.
TEST(Hierarchical, DrawsTheReferencesMasses) {
  for (const SyntheticMap& entry : synthetic_maps()) {
    for (const Extent extent : {Extent{1, 1}, Extent{3, 1}, Extent{1, 6}, Extent{97, 41}}) {
      const EnvironmentMap map = entry.make(extent);
      const Hierarchical sampler(map, {DensitySpace::texture, kRec709});
      const Grid<double> exact = reference::texel_masses(map, {DensitySpace::texture, kRec709});
      for (int y = 0; y < extent.height; ++y) {
        for (int x = 0; x < extent.width; ++x) {
          const SquarePoint at = {(x + 0.5) / extent.width, (y + 0.5) / extent.height};
          const double mass = sampler.pdf(at).value / static_cast<double>(extent.count());
          ASSERT_NEAR(mass, exact(x, y), 14.0 * 0x1p-24 * exact(x, y)) << entry.name;
        }
      }
    }
  }
}

// Those that invert the sums of linear_scan, and so must give its texels point for point.
TEST(Registry, NamesTheSamplersThatShareTheirSums) {
  std::vector<std::string_view> names;
  for (const SamplerInfo& sampler : samplers()) {
    if (sampler.inverts_shared_cdf) names.push_back(sampler.name);
  }
  EXPECT_EQ(names, (std::vector<std::string_view>{"binary_search", "eytzinger", "guide_table"}));
}

// 16 bytes an entry; 4 bytes a sum, of which a level has a quarter as many as the next one.
TEST(Registry, TablesAreAsLargeAsTheirEntries) {
  const EnvironmentMap map = make_synthetic_map("constant", {64, 64});
  const auto bytes_of = [&](const char* name) {
    return std::visit([](const auto& sampler) { return sampler.table_bytes(); },
                      sampler_by_name(name).make(map, DensitySpace::texture));
  };
  const std::size_t positions =
      TexelPositions(map.radiance.extent(), DensitySpace::texture).bytes();
  EXPECT_EQ(bytes_of("alias"), 16U * 4096U + positions);
  EXPECT_EQ(bytes_of("hierarchical"), 4U * (4096U + 1024U + 256U + 64U + 16U + 4U) + positions);
  // Guides of two bytes for every sum of four.
  EXPECT_GT(bytes_of("guide_table"), bytes_of("binary_search"));
  EXPECT_LT(bytes_of("guide_table"), 2U * bytes_of("binary_search"));
}

TEST(Inversion, EqualSolidAnglesAreEquallyLikelyUnderB) {
  const EnvironmentMap map = make_synthetic_map("constant", {4, 2});
  const BinarySearch sampler(map, {DensitySpace::solid_angle, kRec709});
  // On a constant map cos(theta) is linear in u; units of 2^-31 and 4 ulp of the warp.
  for (int i = 1; i < 1000; ++i) {
    const double u = i / 1000.0;
    EXPECT_NEAR(cos_theta(sampler.sample({0.5, u}).at.t), 2.0 * u - 1.0, 4e-9);
  }
}

TEST(Registry, NamesAreUniqueAndFoundAgain) {
  for (const SamplerInfo& info : samplers()) {
    EXPECT_EQ(&sampler_by_name(info.name), &info);
  }
  EXPECT_THROW(sampler_by_name("no such sampler"), InputError);
}

/// Drawn from every column of a table of so many, twice.
std::vector<TexelSample> samples_of_all_columns(const AnySampler& any, std::size_t columns) {
  std::vector<SquarePoint> points;
  for (std::size_t column = 0; column < columns; ++column) {
    const double s = (static_cast<double>(column) + 0.5) / static_cast<double>(columns);
    for (const double t : {0.01, 0.99}) points.push_back({s, t});
  }
  std::vector<TexelSample> samples(points.size());
  std::visit([&](const auto& sampler) { sample(sampler, points, samples); }, any);
  return samples;
}

/// With the density of every texel, at its centre.
std::vector<TexelSample> whole_table(const AnySampler& any, Extent extent) {
  std::vector<TexelSample> samples = samples_of_all_columns(any, extent.count());
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const SquarePoint at = {(x + 0.5) / extent.width, (y + 0.5) / extent.height};
      const PerSquare pdf = std::visit([&](const auto& sampler) { return sampler.pdf(at); }, any);
      samples.push_back({at, x, y, pdf});
    }
  }
  return samples;
}

// Of several tasks each.
TEST(Registry, TablesAreTheSameForAnyNumberOfThreads) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {601, 301});
  for (const SamplerInfo& info : samplers()) {
    const auto draw = [&] {
      return whole_table(info.make(map, DensitySpace::texture), map.radiance.extent());
    };
    const std::vector<TexelSample> by_all = draw();
    const ThreadLimit one(1);
    const std::vector<TexelSample> by_one = draw();
    for (std::size_t i = 0; i < by_all.size(); ++i) {
      ASSERT_EQ(by_all[i].at, by_one[i].at) << info.name;
      ASSERT_EQ(by_all[i].pdf.value, by_one[i].pdf.value) << info.name;
    }
  }
}

TEST(Registry, EverySamplerDrawsFromEveryMap) {
  for (const SyntheticMap& entry : synthetic_maps()) {
    const EnvironmentMap map = entry.make({16, 8});
    for (const SamplerInfo& info : samplers()) {
      for (const DensitySpace density_space : kDensitySpaces) {
        const AnySampler any = info.make(map, density_space);
        const TexelSample sample = std::visit(
            [](const auto& sampler) {
              return sampler.sample({0.3, 0.6});
            },
            any);
        EXPECT_GT(sample.pdf.value, 0.0) << info.name << " on " << entry.name;
      }
    }
  }
}

}  // namespace
}  // namespace lightproof
