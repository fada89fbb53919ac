// The alias method's tables draw exactly what they say, and that is what they were asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/mass_palette.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"
#include "tests/core/kinds_of_vectors.h"
#include "tests/samplers/parts.h"

namespace lightproof {
namespace {

using Masses = TableVector<std::uint64_t>;

std::uint64_t sum_of(const Masses& masses) {
  return std::accumulate(masses.begin(), masses.end(), std::uint64_t{0});
}

std::vector<double> weights_of(std::string_view name, Extent extent) {
  const Grid<double> exact =
      reference::texel_masses(make_synthetic_map(name, extent), {DensitySpace::texture, kRec709});
  return {exact.values().begin(), exact.values().end()};
}

Masses masses_of(std::span<const double> weights, unsigned bits) {
  return whole_masses(weights, bits);
}

TEST(WholeMasses, AreWithinOneUnitOfTheirSharesAndSumToTheirNumber) {
  for (const std::string_view name : {"constant", "sun-sky", "gradient", "checker", "one-texel"}) {
    const std::vector<double> weights = weights_of(name, {64, 32});
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (const unsigned bits : {8U, 13U, 31U}) {
      const Masses masses = masses_of(weights, bits);
      const std::uint64_t whole = weights.size() << bits;
      EXPECT_EQ(sum_of(masses), whole) << name;
      const bool any_faint = std::any_of(weights.begin(), weights.end(), [&](double w) {
        return w > 0.0 && static_cast<double>(whole) * w < total;
      });
      const auto largest = static_cast<std::size_t>(
          std::max_element(weights.begin(), weights.end()) - weights.begin());
      for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_EQ(masses[i] > 0, weights[i] > 0.0) << name << ", cell " << i;
        const double share = static_cast<double>(whole) * weights[i] / total;
        // What raises the faint to one unit comes out of everybody's share.
        const double gift =
            share * static_cast<double>(weights.size()) / static_cast<double>(whole);
        if (weights[i] == weights[largest]) continue;  // one of them takes the rest
        EXPECT_NEAR(static_cast<double>(masses[i]), std::max(share, weights[i] > 0.0 ? 1.0 : 0.0),
                    1.0 + (any_faint ? gift : 0.0));
      }
    }
  }
}

// No single cell has to bear the roundings of many.
TEST(WholeMasses, TheBrightestOfManyCellsHasItsShare) {
  constexpr std::size_t kCells = (std::size_t{1} << 22U) + 1;  // of 65 tasks
  std::vector<double> weights(kCells, 1.0);
  weights[100'000] = 1.3;
  const double total = static_cast<double>(kCells) + 0.3;
  for (const unsigned bits : {9U, 13U, 31U}) {
    const Masses masses = masses_of(weights, bits);
    const std::uint64_t whole = kCells << bits;
    EXPECT_EQ(sum_of(masses), whole);
    // Shares are rounded to 2^-8 of a unit at 31 bits, where the sum is below 2^54, and to 2^-20 at
    // fewer; 65 cells take what that leaves, in proportion: the brightest 1.3 parts of 65.3.
    const double half_step = bits == 31U ? 0x1p-9 : 0x1p-21;
    const double rest = 1.0 + static_cast<double>(kCells) * half_step * 1.3 / 65.3;
    double worst = 0.0;
    for (std::size_t i = 0; i < kCells; ++i) {
      const double share = static_cast<double>(whole) * weights[i] / total;
      worst = std::max(worst, std::abs(static_cast<double>(masses[i]) - share));
    }
    EXPECT_LT(worst, 1.0 + half_step + rest) << bits;
    const ThreadLimit one(1);
    EXPECT_TRUE(masses_of(weights, bits) == masses) << bits;
  }
}

// What every task leaves of a unit adds up under an even sky: a lamp among the few bright cells
// must not bear as much of it as the sun.
TEST(WholeMasses, ALampBesideASunHasItsShare) {
  constexpr std::size_t kCells = std::size_t{1} << 22U;
  constexpr unsigned kBits = 4;
  constexpr double kSky = 3.0 + 0x1p-17;  // units: each task of sky has half a unit left
  constexpr std::size_t kLamp = std::size_t{10} << 16U;
  std::vector<double> weights(kCells, kSky);
  weights[kLamp] = 8.0;
  const double total = 16.0 * static_cast<double>(kCells);
  weights[std::size_t{20} << 16U] = total - 8.0 - kSky * static_cast<double>(kCells - 2);
  const Masses masses = masses_of(weights, kBits);
  EXPECT_EQ(sum_of(masses), kCells << kBits);
  EXPECT_NEAR(static_cast<double>(masses[kLamp]), 8.0, 1.0 + 8.0 * 0x1p-4);
}

TEST(WholeMasses, FaintWeightsGetOneUnitBesideASun) {
  std::vector<double> weights(1000, 1.0);
  weights[500] = 1e15;
  const Masses masses = masses_of(weights, 13);
  for (std::size_t i = 0; i < weights.size(); ++i) EXPECT_EQ(masses[i] == 1, i != 500) << i;
  EXPECT_EQ(sum_of(masses), weights.size() << 13U);
}

// Units for the faint would be drawn from the bright if all positive weights had one beforehand: by
// 19 % of all that the sky is drawn here.
TEST(WholeMasses, ASkyBesideASunIsNotDrawnTooOften) {
  std::vector<double> weights(1000, 0.01 / 999.0);
  weights[500] = 0.99;
  const Masses masses = masses_of(weights, 9);
  const std::uint64_t sky = sum_of(masses) - masses[500];
  EXPECT_NEAR(static_cast<double>(sky), 0.01 * 512000.0, 1.0);
}

/// The columns of a table, after a check that they draw these masses.
std::vector<AliasColumn> columns_of(const Masses& masses, unsigned bits) {
  EXPECT_EQ(sum_of(masses), masses.size() << bits);
  std::vector<AliasColumn> columns(masses.size());
  std::vector<int> visits(masses.size());
  AliasSweep(masses, bits).for_columns([&](std::size_t cell, const AliasColumn& column) {
    ++visits[cell];
    columns[cell] = column;
  });
  EXPECT_EQ(visits, std::vector<int>(masses.size(), 1));
  Masses drawn(masses.size(), 0);
  for (std::size_t cell = 0; cell < columns.size(); ++cell) {
    drawn[cell] += columns[cell].threshold;
    drawn[columns[cell].alias] += (std::uint64_t{1} << bits) - columns[cell].threshold;
  }
  EXPECT_TRUE(drawn == masses);
  return columns;
}

TEST(AliasSweep, EveryColumnIsFilledAndEveryCellDrawnByItsMass) {
  const std::vector<Masses> cases = {{8},           {8, 8},
                                     {0, 16},       {16, 0},
                                     {1, 15, 8},    {20, 1, 1, 17, 1, 8},
                                     {0, 0, 0, 32}, {9, 9, 6},
                                     {7, 9, 7, 9},  {48, 0, 0, 0, 0, 0}};
  for (const Masses& masses : cases) {
    SCOPED_TRACE(testing::PrintToString(masses));
    columns_of(masses, 3);
  }
}

// Large ones before all small ones, behind them, between them, and averages among them.
TEST(AliasSweep, GoesOnAlikeInManyPlacesAtOnce) {
  constexpr std::size_t kCells = 100'000;  // of several tasks
  constexpr unsigned kBits = 8;
  std::vector<Masses> cases;
  for (const std::size_t sun : {std::size_t{0}, kCells / 2, kCells - 1}) {
    cases.emplace_back(kCells, 250);
    cases.back()[sun] += 6 * kCells;
  }
  cases.emplace_back(kCells, 0);
  for (std::size_t i = 0; i < kCells; ++i) cases.back()[i] = i < kCells / 2 ? 1 : 511;
  cases.emplace_back(cases.back().rbegin(), cases.back().rend());
  cases.emplace_back(kCells, 256);
  for (std::size_t i = 0; i < kCells; i += 10) {
    cases.back()[i] -= i % 256;
    cases.back()[kCells - 1 - i] += i % 256;
  }
  for (const Masses& masses : cases) {
    const std::vector<AliasColumn> all_threads = columns_of(masses, kBits);
    const ThreadLimit one(1);
    EXPECT_TRUE(columns_of(masses, kBits) == all_threads);
  }
}

// With stretches that one large cell fills up, stretches with large ones among them, averages,
// black cells, and an end in the middle of a vector.
TEST(AliasTable, EntriesAreTheColumnsOfTheSweep) {
  constexpr std::size_t kCells = 70'003;
  std::vector<std::vector<double>> cases;
  cases.emplace_back(kCells, 1.0);
  cases.emplace_back(kCells, 1.0);
  cases.back()[2000] = 1e5;
  cases.emplace_back(kCells, 0.0);
  for (std::size_t i = 0; i < kCells; i += 3) cases.back()[i] = static_cast<double>(i % 50'000);
  // The sun is at the end, and what is before it at the average.
  cases.emplace_back(kCells, 2.0);
  std::fill(cases.back().begin() + 60'000, cases.back().end() - 1, 1.0);
  cases.back().back() += 10'002.0;
  for (const std::vector<double>& weights : cases) {
    constexpr unsigned kBits = AliasTable::kBits;
    const Masses masses = masses_of(weights, kBits);
    const std::vector<AliasColumn> columns = columns_of(masses, kBits);
    const auto probability = [&](std::size_t cell) {
      const double unit = 0x1p-31 / static_cast<double>(kCells);
      return static_cast<float>(unit * static_cast<double>(masses[cell]));
    };
    for_each_kind_of_vector([&](const char* vectors) {
      SCOPED_TRACE(vectors);
      const AliasTable table{CellWeights(weights)};
      for (std::size_t i = 0; i < kCells; ++i) {
        const AliasTable::Entry& entry = table.entries()[i];
        ASSERT_EQ(entry.threshold, columns[i].threshold) << i;
        ASSERT_EQ(entry.alias, columns[i].alias) << i;
        ASSERT_EQ(entry.mass, probability(i)) << i;
        ASSERT_EQ(entry.alias_mass, probability(columns[i].alias)) << i;
      }
    });
  }
}

TEST(MassPalette, SmallMapsKeepEveryMass) {
  const Masses exact = {5, 0, 123456789, 7};
  const MassPalette palette(exact, 2);
  EXPECT_EQ(palette.cells, exact);
  ASSERT_EQ(palette.codes.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_EQ(palette.masses[palette.codes[i]], exact[i]);
  }
}

/// Binary digits that masses keep in a palette of so many bits: the most, up to 12, at which those
/// cut to them and the next ones above these leave room for the 1024 brightest cells.
int digits_of(const Masses& exact, unsigned bits) {
  for (int digits = 12;; --digits) {
    Masses cut;
    for (const std::uint64_t mass : exact) {
      const int surplus = std::max(0, static_cast<int>(std::bit_width(mass)) - digits);
      cut.push_back(mass >> surplus << surplus);
      cut.push_back(cut.back() + (std::uint64_t{1} << surplus));
    }
    std::ranges::sort(cut);
    cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
    if (cut.size() + 1024 <= std::size_t{1} << bits) return digits;
  }
}

/// That a palette has masses for so many bits, that they differ from the exact ones by less than a
/// step, and that it is the same on one thread.
void expect_palette_of(const Masses& exact, unsigned bits, int digits) {
  EXPECT_EQ(digits_of(exact, bits), digits) << "the case is none of its kind";
  const MassPalette palette(exact, bits);
  EXPECT_LE(palette.masses.size(), std::size_t{1} << bits);
  {
    const ThreadLimit one(1);
    const MassPalette by_one(exact, bits);
    EXPECT_TRUE(by_one.cells == palette.cells);
    EXPECT_TRUE(by_one.codes == palette.codes);
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const std::uint64_t rounded = palette.cells[i];
    ASSERT_EQ(rounded, palette.masses[palette.codes[i]]) << "cell " << i;
    ASSERT_EQ(rounded > 0, exact[i] > 0) << "cell " << i;
    if (exact[i] == 0) continue;
    worst = std::max(worst,
                     std::abs(static_cast<double>(rounded) / static_cast<double>(exact[i]) - 1.0));
  }
  EXPECT_EQ(sum_of(palette.cells), sum_of(exact));
  EXPECT_LT(worst, std::ldexp(1.0, 1 - digits));
}

TEST(MassPalette, RoundsByLittleAndLosesNothing) {
  for (const std::string_view name : {"constant", "sun-sky", "gradient", "checker", "one-texel"}) {
    const std::vector<double> weights = weights_of(name, {600, 300});  // of several tasks
    for (const unsigned bits : {13U, 31U}) {
      SCOPED_TRACE(testing::Message() << name << ", " << bits << " bits");
      expect_palette_of(masses_of(weights, bits), 13, 12);
    }
  }
}

// On maps with more brightnesses than codes masses have fewer digits.
TEST(MassPalette, RoundsToAsManyDigitsAsThereAreCodesFor) {
  expect_palette_of(masses_of(weights_of("cosine-lobe", {600, 300}), 31), 13, 10);
  expect_palette_of(masses_of(weights_of("cosine-lobe", {600, 300}), 31), 11, 7);
  expect_palette_of(masses_of(weights_of("black-first-row", {600, 300}), 31), 11, 10);
}

// Where cells are counted in parts of several tasks each.
TEST(MassPalette, OfManyCellsRoundsByLittleToo) {
  constexpr std::size_t kCells = 1'200'000;
  std::vector<double> weights;
  const RandomStream stream("palette", 1);
  for (std::size_t i = 0; i < kCells; ++i) {
    weights.push_back(std::exp2(20.0 * stream.point(i).s));  // log-uniform
  }
  expect_palette_of(masses_of(weights, 13), 13, 10);
}

// Rounded up and down by turns: no stretch of the map gains or loses more than a step of each
// brightness, which are half as large from one octave to the next.
TEST(MassPalette, StretchesKeepTheirMass) {
  const Masses exact = masses_of(weights_of("gradient", {600, 300}), 31);
  const Masses rounded = MassPalette(exact, 13).cells;
  std::vector<std::int64_t> steps;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    steps.push_back(static_cast<std::int64_t>(rounded[i] - exact[i]));
  }
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  EXPECT_GT(*most - *least, 0);
  std::int64_t gained = 0;
  for (const std::int64_t step : steps) {
    gained += step;
    ASSERT_LE(std::abs(gained), 2 * (*most - *least));
  }
}

/// What a sampler that reads its first table by u.s, one of so many columns, draws of every texel:
/// where u.t leads from one texel to another is found by bisection. In a column no texel comes
/// back.
template <class Sampler>
Grid<double> drawn_masses(const Sampler& sampler, Extent extent, std::size_t columns) {
  Grid<double> masses(extent);
  for (std::size_t column = 0; column < columns; ++column) {
    const double s = (static_cast<double>(column) + 0.5) / static_cast<double>(columns);
    const auto texel = [&](double t) {
      const TexelSample sample = sampler.sample({s, t});
      return std::pair(sample.x, sample.y);
    };
    test::for_parts(0.0, 1.0, texel, [&](const test::Part& part) {
      const auto [x, y] = texel(part.first);
      masses(x, y) += (part.end - part.first) / static_cast<double>(columns);
    });
  }
  return masses;
}

/// The same of a monotone sampler: rows are found at u.s = 1/2, then the columns in each.
template <class Sampler>
Grid<double> drawn_by_inversion(const Sampler& sampler, Extent extent) {
  Grid<double> masses(extent);
  const auto row = [&](double t) { return sampler.sample({0.5, t}).y; };
  test::for_parts(0.0, 1.0, row, [&](const test::Part& height) {
    const double t = 0.5 * (height.first + height.last);
    const auto column = [&](double s) { return sampler.sample({s, t}).x; };
    test::for_parts(0.0, 1.0, column, [&](const test::Part& width) {
      const TexelSample sample = sampler.sample({0.5 * (width.first + width.last), t});
      masses(sample.x, sample.y) += (width.end - width.first) * (height.end - height.first);
    });
  });
  return masses;
}

template <class Sampler>
class TableSamplers : public testing::Test {};
using All = testing::Types<Alias, PackedAlias, AliasLines, GuideLines, GuideTable>;
TYPED_TEST_SUITE(TableSamplers, All);

TYPED_TEST(TableSamplers, ReturnTheDensityThatTheyDraw) {
  for (const std::string_view name : {"sun-sky", "gradient", "checker", "one-texel"}) {
    // Runs of 32 that are cut off at the row's end; more texels than a palette has masses.
    for (const Extent extent : {Extent{1, 1}, Extent{45, 3}, Extent{130, 65}}) {
      const EnvironmentMap map = make_synthetic_map(name, extent);
      const TypeParam sampler(map, {DensitySpace::texture, kRec709});
      const auto runs = static_cast<std::size_t>((extent.width + 31) / 32 * extent.height);
      Grid<double> masses;
      if constexpr (std::is_same_v<TypeParam, GuideLines> ||
                    std::is_same_v<TypeParam, GuideTable>) {
        masses = drawn_by_inversion(sampler, extent);
      } else {
        masses = drawn_masses(sampler, extent,
                              std::is_same_v<TypeParam, AliasLines> ? runs : extent.count());
      }
      for (int y = 0; y < extent.height; ++y) {
        for (int x = 0; x < extent.width; ++x) {
          const SquarePoint at = {(x + 0.5) / extent.width, (y + 0.5) / extent.height};
          const double returned = sampler.pdf(at).value / static_cast<double>(extent.count());
          ASSERT_NEAR(returned, masses(x, y), 0x1p-22 * masses(x, y) + 1e-15)
              << name << ", texel (" << x << ", " << y << ")";
        }
      }
    }
  }
}

// And it is the density that the map demands: to the step of each one's table.
TYPED_TEST(TableSamplers, DrawTheReferencesMasses) {
  constexpr bool kRuns =
      std::is_same_v<TypeParam, AliasLines> || std::is_same_v<TypeParam, GuideLines>;
  constexpr double kShare = kRuns                                    ? 1.0 / 32.0
                            : std::is_same_v<TypeParam, PackedAlias> ? 1.0 / 256.0
                                                                     : 0x1p-22;
  for (const std::string_view name : {"sun-sky", "gradient", "checker", "one-texel"}) {
    for (const DensitySpace density_space : kDensitySpaces) {
      const Extent extent = {130, 65};
      const EnvironmentMap map = make_synthetic_map(name, extent);
      const TypeParam sampler(map, {density_space, kRec709});
      const Grid<double> exact = reference::texel_masses(map, {density_space, kRec709});
      for (int y = 0; y < extent.height; ++y) {
        for (int x = 0; x < extent.width; ++x) {
          const SquarePoint at = {(x + 0.5) / extent.width, (y + 0.5) / extent.height};
          const double mass =
              position_measure(density_space) == MapMeasure::square
                  ? sampler.pdf(at).value / static_cast<double>(extent.count())
                  : to_solid_angle(sampler.pdf(at), at).value * texel_solid_angle(extent, y);
          // Two units of sums of a row or of thresholds of 24 bits.
          const double units = 2.0 * (extent.width + 2) * 0x1p-31;
          ASSERT_NEAR(mass, exact(x, y), kShare * exact(x, y) + units) << name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lightproof
