#include "lightproof/gate/direction_histogram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/warp/hemisphere.h"
#include "lightproof/warp/lat_long.h"
#include "reference/cosine_lobes.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

using testing::AnyOf;

struct Bin {
  int x;
  int y;
  friend bool operator==(Bin, Bin) = default;
};

/// What the histogram promises for directions farther than this, in s and t, from every edge.
constexpr double kMargin = 1e-15;

Bin bin_at(SquarePoint at) {
  return {cell_of(at.s, kGateBins.width), cell_of(at.t, kGateBins.height)};
}

/// Distance in s or t to the nearest multiple of 1/count.
double to_edge(double coordinate, int count) {
  return std::abs(coordinate - std::round(coordinate * count) / count);
}

bool is_near_edge(SquarePoint at) {
  return to_edge(at.s, kGateBins.width) < kMargin || to_edge(at.t, kGateBins.height) < kMargin;
}

/// The histogram takes its directions by component.
struct Components {
  std::vector<double> x, y, z;

  explicit Components(std::span<const Direction> directions) {
    for (const Direction& d : directions) {
      x.push_back(d.x);
      y.push_back(d.y);
      z.push_back(d.z);
    }
  }
};

DirectionHistogram histogram_of(std::span<const Direction> directions) {
  const Components all(directions);
  DirectionHistogram histogram;
  histogram.add({all.x, all.y, all.z});
  return histogram;
}

/// The bin of one direction; {-1, -1} if it was invalid.
Bin bin_of(Direction d) {
  const DirectionHistogram histogram = histogram_of({&d, 1});
  EXPECT_EQ(histogram.samples(), 1U);
  const Grid<std::uint64_t> bins = histogram.bins();
  const auto found = std::ranges::find(bins.values(), 1U);
  if (found == bins.values().end()) return {-1, -1};
  const auto index = static_cast<int>(found - bins.values().begin());
  return {index % kGateBins.width, index / kGateBins.width};
}

std::vector<Direction> random_directions(std::uint64_t count) {
  const RandomStream stream("direction histogram", 1);
  std::vector<Direction> directions;
  for (std::uint64_t i = 0; i < count; ++i) {
    directions.push_back(direction_from_square(stream.point(i)));
  }
  return directions;
}

TEST(DirectionHistogram, CountsAMillionDirectionsAsTheScalarDefinition) {
  std::vector<Direction> directions = random_directions(1'000'003);  // not a multiple of anything
  std::erase_if(directions, [](Direction d) { return is_near_edge(square_from_direction(d)); });
  Grid<std::uint64_t> expected(kGateBins);
  for (const Direction& d : directions) {
    const Bin bin = bin_at(square_from_direction(d));
    ++expected(bin.x, bin.y);
  }
  const DirectionHistogram histogram = histogram_of(directions);
  EXPECT_THAT(histogram.bins().values(), testing::ElementsAreArray(expected.values()));
  EXPECT_EQ(histogram.invalid(), 0U);
  EXPECT_EQ(histogram.samples(), directions.size());
  EXPECT_GT(directions.size(), 1'000'000U - 10U);  // 48 edges of 2e-15 each
}

/// Both sides of every edge, at 1.5 times the margin: the coordinates and the direction themselves
/// are rounded by no more than 3e-16.
TEST(DirectionHistogram, SeparatesDirectionsOnBothSidesOfEveryEdge) {
  constexpr double kBeside = 1.5e-15;
  for (int y = 0; y < kGateBins.height; ++y) {
    for (int x = 0; x < kGateBins.width; ++x) {
      for (const double s : {x + kGateBins.width * kBeside, x + 1 - kGateBins.width * kBeside}) {
        for (const double t :
             {y + kGateBins.height * kBeside, y + 1 - kGateBins.height * kBeside}) {
          const SquarePoint at = {s / kGateBins.width, t / kGateBins.height};
          EXPECT_EQ(bin_of(direction_from_square(at)), (Bin{x, y})) << at.s << ' ' << at.t;
        }
      }
    }
  }
}

TEST(DirectionHistogram, PutsADirectionOnAnEdgeBesideIt) {
  const double half = std::sqrt(0.5);
  for (const double zero : {0.0, -0.0}) {
    // The seam at -x, and then s = 1/8, 1/4, … at the horizon, where t = 1/2.
    const std::vector<Direction> around = {
        {-1, zero, zero}, {-half, half, zero}, {zero, 1, zero},  {half, half, zero},
        {1, zero, zero},  {half, -half, zero}, {zero, -1, zero}, {-half, -half, zero}};
    for (int i = 0; i < 8; ++i) {
      const Bin bin = bin_of(around[static_cast<std::size_t>(i)]);
      EXPECT_THAT(bin.x, AnyOf(4 * i, (4 * i + 31) % 32)) << i << ' ' << zero;
      EXPECT_THAT(bin.y, AnyOf(7, 8)) << i << ' ' << zero;
    }
    EXPECT_EQ(bin_of({zero, zero, -1}).y, 0);
    EXPECT_EQ(bin_of({zero, zero, 1}).y, 15);
    EXPECT_EQ(bin_of({zero, 1e-200, -1}).y, 0);
    EXPECT_EQ(bin_of({1e-200, zero, 1}).y, 15);
  }
}

TEST(DirectionHistogram, KeepsTheColumnNearThePoles) {
  for (const double sine : {1e-8, 1e-100}) {
    for (int x = 0; x < kGateBins.width; ++x) {
      const double phi = kPi - 2.0 * kPi * (x + 0.5) / kGateBins.width;
      for (const double height : {-1.0, 1.0}) {
        EXPECT_EQ(bin_of({sine * std::cos(phi), sine * std::sin(phi), height}),
                  (Bin{x, height < 0.0 ? 0 : 15}));
      }
    }
  }
}

TEST(DirectionHistogram, CountsWhatIsNoDirectionAsInvalid) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kMax = std::numeric_limits<double>::max();
  for (const double bad : {kNan, -kNan, kInfinity, -kInfinity, kMax, -kMax, 2.0}) {
    for (const Direction& d :
         {Direction{bad, 0, 1}, {0, bad, 1}, {1, 0, bad}, {bad, bad, 0}, {bad, bad, bad}}) {
      EXPECT_EQ(bin_of(d), (Bin{-1, -1})) << d.x << ' ' << d.y << ' ' << d.z;
    }
  }
  EXPECT_EQ(bin_of({0, 0, 0}), (Bin{-1, -1}));
  // Squared lengths just beside (1/2, 3/2), and just inside.
  for (const double length : {0.707, 1.225}) EXPECT_EQ(bin_of({0, 0, length}), (Bin{-1, -1}));
  for (const double length : {0.708, 1.224}) EXPECT_EQ(bin_of({0, 0, length}).y, 15);
}

TEST(DirectionHistogram, FindsTheInvalidAmongOthers) {
  std::vector<Direction> directions = random_directions(5000);
  for (std::size_t i = 0; i < directions.size(); i += 7) directions[i].y = std::nan("");
  const DirectionHistogram histogram = histogram_of(directions);
  EXPECT_EQ(histogram.invalid(), 715U);
  EXPECT_EQ(histogram.samples(), 5000U);
  const Grid<std::uint64_t> bins = histogram.bins();
  EXPECT_EQ(std::accumulate(bins.values().begin(), bins.values().end(), std::uint64_t{0}), 4285U);
}

TEST(DirectionHistogram, IsTheSameHoweverTheWorkWasSplit) {
  std::vector<Direction> directions = random_directions(100'000);
  directions[50'000] = {};
  const DirectionHistogram whole = histogram_of(directions);
  DirectionHistogram merged;
  const std::span all(directions);
  for (const auto& [first, size] : {std::pair<std::size_t, std::size_t>{70'001, 29'999},
                                    {0, 0},
                                    {0, 1},
                                    {1, 1023},
                                    {1024, 68'977}}) {
    merged.merge(histogram_of(all.subspan(first, size)));
  }
  EXPECT_THAT(merged.bins().values(), testing::ElementsAreArray(whole.bins().values()));
  EXPECT_EQ(merged.invalid(), 1U);
  EXPECT_EQ(merged.samples(), directions.size());
}

/// Most of it in one bin: three million, more than 16 bits hold.
TEST(DirectionHistogram, CountsOnFromCallToCall) {
  constexpr std::uint64_t kRepeats = 50;
  std::vector<Direction> directions = random_directions(70'001);
  std::fill_n(directions.begin(), 60'000, Direction{0.6, 0.48, 0.64});
  const Grid<std::uint64_t> once = histogram_of(directions).bins();
  const Components all(directions);
  DirectionHistogram histogram;
  for (std::uint64_t i = 0; i < kRepeats; ++i) histogram.add({all.x, all.y, all.z});
  const Grid<std::uint64_t> bins = histogram.bins();
  for (std::size_t i = 0; i < once.values().size(); ++i) {
    EXPECT_EQ(bins.values()[i], kRepeats * once.values()[i]);
  }
  EXPECT_EQ(histogram.samples(), kRepeats * directions.size());
}

/// Independent of square_from_direction: the distribution's exact masses. Fixed points, alpha =
/// 1e-6.
TEST(DirectionHistogram, CountsOfTheCosineHemisphereFitItsDistribution) {
  const RandomStream stream("direction histogram/cosine", 1);
  std::vector<Direction> directions;
  for (std::uint64_t i = 0; i < 1'000'000; ++i) {
    directions.push_back(cosine_hemisphere_from_square(stream.point(i)));
  }
  const std::vector<reference::CosineLobe> distribution = {{{0.0, 0.0, 1.0}, 1.0, 1.0}};
  const Grid<double> masses = reference::bin_masses(
      reference::cell_masses(distribution, reference::cells_for(distribution)),
      DensitySpace::solid_angle, kGateBins);
  const DirectionHistogram histogram = histogram_of(directions);
  const GoodnessOfFit fit =
      cressie_read(serpentine(histogram.bins()), serpentine(masses), histogram.samples());
  EXPECT_EQ(fit.impossible_hits, 0U);
  EXPECT_GT(fit.log10_p, -6.0);
}

}  // namespace
}  // namespace lightproof
