// Densities on a grid against samples: right ones are accepted whatever lies between the centres of
// cells, and those of another sampler are found.
#include "lightproof/check/grid_histogram.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/alias.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/warp/lat_long.h"
#include "tests/check/written_dump.h"

namespace lightproof {
namespace {

using testing::HasSubstr;

constexpr Extent kCells = {64, 32};
constexpr std::size_t kSamples = 400'000;
constexpr double kAlpha = 1e-6;

using Density = std::function<double(Direction)>;

/// Densities at the centres of a grid.
test::WrittenDump grid_of(const Density& density, Extent cells = kCells) {
  return {cells.count(), {"s", "t", "pdf"}, [&](std::size_t i) {
            const int x = static_cast<int>(i) % cells.width;
            const int y = static_cast<int>(i) / cells.width;
            const SquarePoint at = {(x + 0.5) / cells.width, (y + 0.5) / cells.height};
            return std::vector<double>{at.s, at.t, density(direction_from_square(at))};
          }};
}

/// Samples of a lobe (n + 1)/2pi cos^n around +x.
test::WrittenDump lobe_samples(double exponent) {
  const RandomStream stream("grid histogram", 3);
  return {kSamples, {"x", "y", "z"}, [&](std::size_t i) {
            const auto [u, v] = stream.point(i);
            const double cosine = std::pow(1.0 - u, 1.0 / (exponent + 1.0));
            const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
            return std::vector<double>{cosine, sine * std::cos(2.0 * kPi * v),
                                       sine * std::sin(2.0 * kPi * v)};
          }};
}

Density lobe(double exponent) {
  return [exponent](Direction d) {
    return (exponent + 1.0) / (2.0 * kPi) * std::pow(std::max(0.0, d.x), exponent);
  };
}

TestRecord judged(const test::WrittenDump& grid, const test::WrittenDump& samples) {
  return judge_grid_histogram(density_grid_of(*grid.dump()), *samples.dump(), kAlpha, {});
}

TEST(GridHistogram, OfTheDensityOfTheSamplesIsAccepted) {
  for (const double exponent : {1.0, 5.0, 20.0}) {
    const TestRecord record = judged(grid_of(lobe(exponent)), lobe_samples(exponent));
    EXPECT_EQ(record.outcome, Outcome::accept) << exponent << ": " << record.detail;
    EXPECT_EQ(record.samples, kSamples);
  }
}

// The edge of a hemisphere cuts cells, at the seam and near the poles as elsewhere: their centres
// say all or nothing of what has half.
TEST(GridHistogram, OfADensityWithAnEdgeInsideOfCellsIsAccepted) {
  for (const Direction axis : {Direction(1.0, 0.5, 0.3), Direction(0.1, 1.0, 0.02)}) {
    const auto is_inside = [axis](Direction d) { return glm::dot(d, axis) > 0.0; };
    const Density density = [&](Direction d) { return is_inside(d) ? 0.5 / kPi : 0.0; };
    const RandomStream stream("grid histogram", 5);
    const test::WrittenDump samples = {
        kSamples, {"x", "y", "z"}, [&](std::size_t i) {
          const auto [u, v] = stream.point(i);
          const double z = 2.0 * u - 1.0;
          const double sine = std::sqrt((1.0 - z) * (1.0 + z));
          Direction d = {sine * std::cos(2.0 * kPi * v), sine * std::sin(2.0 * kPi * v), z};
          if (!is_inside(d)) d = -d;
          return std::vector<double>{d.x, d.y, d.z};
        }};
    const TestRecord record = judged(grid_of(density), samples);
    EXPECT_EQ(record.outcome, Outcome::accept) << record.detail;
    const Density other = [&](Direction d) { return density(-d); };
    EXPECT_EQ(judged(grid_of(other), samples).outcome, Outcome::reject);
  }
}

TEST(GridHistogram, OfTheDensityOfOtherSamplesIsRejected) {
  for (const auto& [of_grid, of_samples] : {std::pair(1.0, 2.0), std::pair(5.0, 4.0)}) {
    const TestRecord record = judged(grid_of(lobe(of_grid)), lobe_samples(of_samples));
    EXPECT_EQ(record.outcome, Outcome::reject) << of_grid;
    EXPECT_THAT(record.detail, HasSubstr("samples where the densities say"));
  }
  // Turned by half a turn: all samples lie where the densities are 0.
  const Density turned = [](Direction d) { return lobe(1.0)({-d.x, d.y, d.z}); };
  EXPECT_EQ(judged(grid_of(turned), lobe_samples(1.0)).outcome, Outcome::reject);
}

// A sun is one texel: between centres beside it a density may be anything.
TEST(GridHistogram, OfASamplerOfTexelsIsAcceptedAndRejectedWhereTheMapIsSmooth) {
  EnvironmentMap map = make_synthetic_map("sun-sky", kCells);
  for (Rgb& rgb : map.radiance.values()) rgb = glm::min(rgb, Rgb(4.0F));
  const Alias sampler(map, {DensitySpace::sine_weighted});
  const Density density = [&sampler](Direction d) {
    const SquarePoint at = square_from_direction(d);
    return sampler.pdf(at).value / solid_angle_per_square(at.t);
  };
  const RandomStream stream("grid histogram", 4);
  const test::WrittenDump samples = {kSamples, {"x", "y", "z"}, [&](std::size_t i) {
                                       const Direction d =
                                           sample_direction(sampler, stream.point(i)).direction;
                                       return std::vector<double>{d.x, d.y, d.z};
                                     }};
  const TestRecord right = judged(grid_of(density), samples);
  EXPECT_EQ(right.outcome, Outcome::accept) << right.detail;
  const Density upside_down = [&](Direction d) { return density({d.x, d.y, -d.z}); };
  EXPECT_EQ(judged(grid_of(upside_down), samples).outcome, Outcome::reject);
}

TEST(GridHistogram, OfAGridThatIsTooCoarseIsNotRun) {
  const TestRecord record = judged(grid_of(lobe(500.0), {16, 8}), lobe_samples(500.0));
  EXPECT_EQ(record.outcome, Outcome::not_run);
  EXPECT_THAT(record.detail, HasSubstr("a finer grid"));
}

TEST(GridHistogram, OfDensitiesThatAreNoneIsNotRun) {
  const Density negative = [](Direction d) { return d.z > 0.9 ? -1.0 : 0.1; };
  EXPECT_THAT(judged(grid_of(negative), lobe_samples(1.0)).detail, HasSubstr("negative"));
  const Density zero = [](Direction) { return 0.0; };
  EXPECT_THAT(judged(grid_of(zero), lobe_samples(1.0)).detail, HasSubstr("add up to 0"));
}

}  // namespace
}  // namespace lightproof
