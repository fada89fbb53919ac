// Batches give the texels of the scalar interface, whatever vectors the processor has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <ostream>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "lightproof/core/huge_pages.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/light_sample.h"
#include "lightproof/samplers/registry.h"
#include "tests/core/kinds_of_vectors.h"
#include "tests/core/whole_vectors.h"
#include "tests/samplers/points_beside_changes.h"

namespace lightproof {

/// For messages of parameterised tests.
void PrintTo(const SamplerInfo& info, std::ostream* out) { *out << info.name; }

namespace {

/// Off by the rounding of vectorised sines and arc sines, some 10^-15 of a quarter circle each, in
/// a map of up to 64 rows.
constexpr double kPositionError = 1e-12;

/// What is published may be no number.
void expect_close(double a, double b, double tolerance) {
  const bool is_same = a == b || (std::isnan(a) && std::isnan(b));
  EXPECT_TRUE(is_same || std::abs(a - b) <= tolerance) << a << " is not " << b;
}

/// Bit for bit, but for the arc sines and sines of maps of few rows.
void expect_same(const TexelSample& batch, const TexelSample& scalar, DensitySpace density_space,
                 int rows = 0) {
  EXPECT_EQ(batch.x, scalar.x);
  EXPECT_EQ(batch.y, scalar.y);
  expect_close(batch.at.s, scalar.at.s, 0.0);
  const bool is_exact =
      position_measure(density_space) == MapMeasure::square || SolidAngleRows::has_many_rows(rows);
  const double error = is_exact ? 0.0 : kPositionError;
  expect_close(batch.at.t, scalar.at.t, error);
  // Near a pole the density follows the sine, and so the rounding of t.
  const double near = std::min(scalar.at.t, 1.0 - scalar.at.t);
  expect_close(batch.pdf.value, scalar.pdf.value,
               error == 0.0 ? 0.0 : error * scalar.pdf.value * (1.0 + 1.0 / near));
}

/// Uniform points, and those at the ends of the square and of low resolution.
std::vector<SquarePoint> test_points(std::size_t count) {
  const RandomStream stream("batch", 1);
  std::vector<SquarePoint> points = {{0.0, 0.0},
                                     {std::nextafter(1.0, 0.0), std::nextafter(1.0, 0.0)},
                                     {0.0, std::nextafter(1.0, 0.0)},
                                     {std::nextafter(1.0, 0.0), 0.0},
                                     {0.5, 0.5},
                                     {0.25, 0.75}};
  while (points.size() < count) points.push_back(stream.point(points.size()));
  points.resize(count);
  return points;
}

class Batch : public testing::TestWithParam<SamplerInfo> {};

TEST_P(Batch, GivesTheTexelsOfTheScalarInterface) {
  for (const std::string_view map_name : {"sun-sky", "one-texel", "gradient", "checker"}) {
    for (const Extent extent : {Extent{64, 32}, Extent{37, 19}, Extent{1, 1}, Extent{100, 3}}) {
      const EnvironmentMap map = make_synthetic_map(map_name, extent);
      for (const DensitySpace density_space : kDensitySpaces) {
        const AnySampler any = GetParam().make(map, density_space);
        std::visit(
            [&](const auto& sampler) {
              const std::vector<SquarePoint> points = test_points(1500);
              for_each_kind_of_vector([&](const char* vectors) {
                SCOPED_TRACE(testing::Message() << map_name << " " << extent.width << " x "
                                                << extent.height << ", " << vectors);
                std::vector<TexelSample> samples(points.size());
                sample(sampler, points, samples);
                for (std::size_t i = 0; i < points.size() && !HasFailure(); ++i) {
                  expect_same(samples[i], sampler.sample(points[i]), density_space, extent.height);
                }
              });
            },
            any);
      }
    }
  }
}

/// Under density A, with every kind of vector.
template <class Sampler>
void expect_same_as_one_by_one(const Sampler& sampler, std::span<const SquarePoint> points) {
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    std::vector<TexelSample> samples(points.size());
    sample(sampler, points, samples);
    for (std::size_t i = 0; i < points.size() && !testing::Test::HasFailure(); ++i) {
      expect_same(samples[i], sampler.sample(points[i]), DensitySpace::texture);
    }
  });
}

TEST_P(Batch, GivesTheTexelsAtEveryEntryOfTheSumsAndBesideIt) {
  for (const std::string_view map_name : {"sun-sky", "black-first-row", "step"}) {
    for (const Extent extent : {Extent{2, 1}, Extent{1, 5}, Extent{3, 2}, Extent{33, 65}}) {
      SCOPED_TRACE(testing::Message() << map_name << " " << extent.width << " x " << extent.height);
      const EnvironmentMap map = make_synthetic_map(map_name, extent);
      const CdfTable table(map, {DensitySpace::texture, GetParam().weights});
      std::vector<SquarePoint> points = adversarial_points_of_rows(table);
      std::ranges::copy(adversarial_points(table), std::back_inserter(points));
      std::visit([&](const auto& sampler) { expect_same_as_one_by_one(sampler, points); },
                 GetParam().make(map, DensitySpace::texture));
    }
  }
}

// Thresholds of alias tables, CDF entries of lines, edges of texels, whatever the sampler has.
TEST_P(Batch, GivesTheTexelsOnBothSidesOfEveryChange) {
  for (const std::string_view map_name : {"sun-sky", "black-first-row", "step"}) {
    for (const Extent extent : {Extent{1, 5}, Extent{3, 2}, Extent{37, 9}}) {
      SCOPED_TRACE(testing::Message() << map_name << " " << extent.width << " x " << extent.height);
      const EnvironmentMap map = make_synthetic_map(map_name, extent);
      std::visit(
          [&](const auto& sampler) {
            expect_same_as_one_by_one(sampler,
                                      test::points_beside_changes(sampler, extent.count()));
          },
          GetParam().make(map, DensitySpace::texture));
    }
  }
}

TEST_P(Batch, OfAnySizeWritesNothingElse) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const AnySampler any = GetParam().make(map, DensitySpace::texture);
  std::visit(
      [&](const auto& sampler) {
        const std::vector<SquarePoint> points = test_points(600);
        for (const std::size_t size : {0U, 1U, 7U, 8U, 9U, 255U, 256U, 257U, 520U}) {
          const TexelSample untouched{{-1.0, -1.0}, -1, -1, {-1.0}};
          std::vector<TexelSample> samples(size + 9, untouched);
          sample(sampler, std::span(points).first(size), std::span(samples).first(size));
          for (std::size_t i = 0; i < size; ++i) {
            expect_same(samples[i], sampler.sample(points[i]), DensitySpace::texture);
          }
          for (std::size_t i = size; i < samples.size(); ++i) EXPECT_EQ(samples[i].x, -1);
        }
      },
      any);
}

// More than 2^16 runs, and guides of several batches.
TEST_P(Batch, OnALargeMapGivesTheTexelsToo) {
  static const EnvironmentMap map = make_synthetic_map("sun-sky", {2048, 1024});
  const AnySampler any = GetParam().make(map, DensitySpace::texture);
  std::visit(
      [&](const auto& sampler) {
        const std::vector<SquarePoint> points = test_points(4096);
        for_each_kind_of_vector([&](const char* vectors) {
          SCOPED_TRACE(vectors);
          std::vector<TexelSample> samples(points.size());
          sample(sampler, points, samples);
          for (std::size_t i = 0; i < points.size(); ++i) {
            expect_same(samples[i], sampler.sample(points[i]), DensitySpace::texture);
          }
        });
      },
      any);
}

TEST_P(Batch, OfAStreamDrawsAtItsPoints) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const AnySampler any = GetParam().make(map, DensitySpace::texture);
  const RandomStream stream("batch of a stream", 3);
  const std::uint64_t first = (std::uint64_t{1} << 32U) - 300;  // both words of the counter change
  std::visit(
      [&](const auto& sampler) {
        std::vector<TexelSample> samples(700);
        sample(sampler, stream, first, samples);
        for (std::size_t i = 0; i < samples.size(); ++i) {
          expect_same(samples[i], sampler.sample(stream.point(first + i)), DensitySpace::texture);
        }
      },
      any);
}

/// Samples of directions, each number in an array of its own.
struct Directions {
  explicit Directions(std::size_t size)
      : x(size), y(size), z(size), pdf(size), column(size), row(size) {}
  DirectionBatch batch() { return {x, y, z, pdf, column, row}; }
  LightSample operator[](std::size_t i) const {
    return {{x[i], y[i], z[i]}, {pdf[i]}, column[i], row[i]};
  }

  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  std::vector<double> pdf;
  std::vector<std::int32_t> column;
  std::vector<std::int32_t> row;
};

// Directions are off by the rounding of the place, and so are densities over them near a pole.
// Under B a position keeps its margin to the edges of its row as a share of angle, a direction as
// one of solid angle.
void expect_same_direction(const LightSample& found, const TexelSample& sample, Extent extent) {
  EXPECT_EQ(found.x, sample.x);
  EXPECT_EQ(found.y, sample.y);
  const Direction at = direction_from_square(sample.at);
  const double error = kPositionError + kCellMargin * kPi / extent.height;
  EXPECT_NEAR(found.direction.x, at.x, error);
  EXPECT_NEAR(found.direction.y, at.y, error);
  EXPECT_NEAR(found.direction.z, at.z, error);
  const double near = std::min(sample.at.t, 1.0 - sample.at.t);
  const double pdf = to_solid_angle(sample.pdf, sample.at).value;
  EXPECT_NEAR(found.pdf.value, pdf, kPositionError * pdf * (1.0 + 1.0 / near));
}

TEST_P(Batch, OfDirectionsAtGivenPointsAndDirectionsOneByOneLieAtTheSamplesPositionsToo) {
  if (GetParam().known_defects) return;  // may leave the map
  for (const Extent extent : {Extent{64, 32}, Extent{37, 19}, Extent{1, 1}, Extent{2, 1}}) {
    const EnvironmentMap map = make_synthetic_map("sun-sky", extent);
    for (const DensitySpace density_space : kDensitySpaces) {
      std::visit(
          [&](const auto& sampler) {
            const std::vector<SquarePoint> points = test_points(1000);
            Directions directions(points.size());
            sample_directions(sampler, points, directions.batch());
            for (std::size_t i = 0; i < points.size(); ++i) {
              const TexelSample sample = sampler.sample(points[i]);
              expect_same_direction(directions[i], sample, extent);
              if constexpr (PreparingSampler<std::remove_cvref_t<decltype(sampler)>>) {
                // Begun, then others, then finished: no sample knows of another.
                const auto prepared = sampler.prepare(points[i]);
                sampler.prepare(points[points.size() - 1 - i]);
                expect_same_direction(finish_direction(sampler, prepared), sample, extent);
              }
              expect_same_direction(sample_direction(sampler, points[i]), sample, extent);
            }
          },
          GetParam().make(map, density_space));
    }
  }
}

TEST_P(Batch, OfDirectionsLieAtTheSamplesPositions) {
  if (GetParam().known_defects) return;  // may leave the map
  const RandomStream stream("batch of directions", 4);
  for (const Extent extent : {Extent{64, 32}, Extent{37, 19}, Extent{1, 1}}) {
    const EnvironmentMap map = make_synthetic_map("sun-sky", extent);
    for (const DensitySpace density_space : kDensitySpaces) {
      const AnySampler any = GetParam().make(map, density_space);
      std::visit(
          [&](const auto& sampler) {
            for_each_kind_of_vector([&](const char* vectors) {
              SCOPED_TRACE(testing::Message() << extent.width << " wide, " << vectors);
              Directions directions(1000);
              sample_directions(sampler, stream, 5, directions.batch());
              for (std::size_t i = 0; i < directions.pdf.size(); ++i) {
                expect_same_direction(directions[i], sampler.sample(stream.point(5 + i)), extent);
              }
            });
          },
          any);
    }
  }
}

// Scans, descents of a hierarchy and what is interpolated have no vectorised form.
bool is_drawn_one_by_one(std::string_view name) {
  return name.starts_with("linear_scan") || name == "hierarchical" || name == "bilinear";
}

TEST_P(Batch, IsDrawnByVectors) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const AnySampler any = GetParam().make(map, DensitySpace::solid_angle);
  const RandomStream stream("batch", 5);
  constexpr std::size_t kSize = 1003;
  const auto expect_drawn = [](const char* vectors, std::size_t drawn) {
    if (is_drawn_one_by_one(GetParam().name)) {
      EXPECT_EQ(drawn, 0U);
    } else {
      expect_whole_vectors(vectors, drawn, kSize);
    }
  };
  std::visit(
      [&](const auto& sampler) {
        for_each_kind_of_vector([&](const char* vectors) {
          SCOPED_TRACE(vectors);
          std::vector<TexelSample> samples(kSize);
          expect_drawn(vectors, sample(sampler, test_points(kSize), samples));
          expect_drawn(vectors, sample(sampler, stream, 0, samples));
          Directions directions(kSize);
          expect_drawn(vectors, sample_directions(sampler, stream, 0, directions.batch()));
        });
      },
      any);
}

INSTANTIATE_TEST_SUITE_P(Samplers, Batch, testing::ValuesIn(samplers().begin(), samplers().end()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(HugePages, HoldTablesOfAnySize) {
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, kHugePage - 1, kHugePage, kHugePage + 1, 3 * kHugePage}) {
    TableVector<unsigned char> table(size, 7);
    const std::size_t alignment = size >= kHugePage ? kHugePage : 64;
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(table.data()) % alignment, 0U);
    for (const unsigned char byte : table) ASSERT_EQ(byte, 7);
  }
}

}  // namespace
}  // namespace lightproof
