// A renderer's sampler as somebody else would write it, right and with defects that are not among
// the mutants.
#include "lightproof/testing/sampler_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lightproof/testing/gtest.h"

namespace lightproof {
namespace {

enum class Defect {
  none,
  no_sine,
  density_of_square,
  one_column_late,
  texel_centres,
  clipped_sun,
  squared_luminance,
  upside_down,
  half_texel,
  coarse_numbers,
  red_only,
  uniform_rows,
  pdf_of_last_row_missing,
};

/// Inversion of float sums of luminance times sin(theta), rows first: density C.
template <Defect kDefect>
class Inversion {
 public:
  explicit Inversion(const EnvironmentMap& map)
      : width_(map.radiance.extent().width), height_(map.radiance.extent().height) {
    for (int y = 0; y < height_; ++y) {
      const double sine = kDefect == Defect::no_sine ? 1.0 : std::sin(kPi * (y + 0.5) / height_);
      double sum = 0.0;
      columns_.push_back(0.0);
      for (int x = 0; x < width_; ++x) {
        const int from = kDefect == Defect::upside_down ? height_ - 1 - y : y;
        columns_.push_back(sum += weight_of(map.radiance(x, from)) * sine);
      }
      rows_.push_back(kDefect == Defect::uniform_rows ? (sum > 0.0 ? 1.0 : 0.0) : sum);
    }
    for (int y = 0; y < height_; ++y) {
      double* const row = columns_.data() + std::ptrdiff_t{y} * (width_ + 1);
      if (row[width_] > 0.0)
        std::for_each(row, row + width_ + 1, [end = row[width_]](double& c) { c /= end; });
    }
    double sum = 0.0;
    for (double& row : rows_) row = sum += row;
    for (double& row : rows_) row /= sum;
    rows_.insert(rows_.begin(), 0.0);
  }

  struct Sample {
    Direction direction;
    PerSteradian pdf;
  };
  Sample sample(SquarePoint u) const {
    if (kDefect == Defect::coarse_numbers) u = {std::floor(u.s * 256.0) / 256.0, u.t};
    const auto [y, along] = find(rows_.data(), height_, u.t);
    auto [x, across] = find(columns_.data() + std::ptrdiff_t{y} * (width_ + 1), width_, u.s);
    const double density = density_of(x, y);
    if (kDefect == Defect::one_column_late) x = (x + 1) % width_;
    if (kDefect == Defect::texel_centres) across = 0.5;
    if (kDefect == Defect::half_texel) across += 0.5;
    const double theta = kPi * (y + along) / height_;
    const double phi = kPi - 2.0 * kPi * (x + across) / width_;
    const Direction direction = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                 -std::cos(theta)};
    return {direction, per_steradian(density, std::sin(theta))};
  }

  PerSteradian pdf(Direction d) const {
    const double theta = std::acos(std::clamp(-d.z, -1.0, 1.0));
    const double phi = std::atan2(d.y, d.x);
    const int x = std::clamp(static_cast<int>((kPi - phi) / (2.0 * kPi) * width_), 0, width_ - 1);
    const int y = std::clamp(static_cast<int>(theta / kPi * height_), 0, height_ - 1);
    if (kDefect == Defect::pdf_of_last_row_missing && y == height_ - 1) return {0.0};
    return per_steradian(density_of(x, y), std::hypot(d.x, d.y));
  }

 private:
  static double weight_of(Rgb rgb) {
    double weight = luminance_of(rgb, kRec709);
    if (kDefect == Defect::clipped_sun) weight = std::min(weight, 1.0);
    if (kDefect == Defect::squared_luminance) weight *= weight;
    if (kDefect == Defect::red_only) weight = rgb.r;
    return weight;
  }
  struct Found {
    int cell;
    double share;
  };
  static Found find(const double* sums, int count, double u) {
    const double* const upper = std::upper_bound(sums, sums + count + 1, u);
    const int cell = std::min(static_cast<int>(upper - sums) - 1, count - 1);
    const double share = (u - sums[cell]) / (sums[cell + 1] - sums[cell]);
    return {cell, std::clamp(share, 1e-9, 1.0 - 1e-9)};  // on no pole
  }
  double density_of(int x, int y) const {
    const double* const row = columns_.data() + std::ptrdiff_t{y} * (width_ + 1);
    return (rows_[static_cast<std::size_t>(y) + 1] - rows_[static_cast<std::size_t>(y)]) *
           (row[x + 1] - row[x]) * width_ * height_;
  }
  static PerSteradian per_steradian(double density, double sine) {
    if (kDefect == Defect::density_of_square) return {density};
    return {density / (2.0 * kPi * kPi * sine)};
  }

  int width_;
  int height_;
  std::vector<double> rows_;     ///< sums up to each row's end, from 0 to 1
  std::vector<double> columns_;  ///< likewise of each row
};

using RightSampler = Inversion<Defect::none>;
LIGHTPROOF_TEST_SAMPLER(RightSampler);

template <Defect kDefect>
void expect_rejected(const char* looks_like) {
  std::vector<EnvironmentMap> maps = sampler_test_maps();
  std::erase_if(maps, [](const EnvironmentMap& map) { return map.name == "one-texel"; });
  const SamplerVerdict verdict = judge_sampler<Inversion<kDefect>>(
      "mine", {.samples = std::uint64_t{1} << 18U, .maps = std::move(maps)});
  EXPECT_FALSE(verdict.is_accepted) << looks_like;
  EXPECT_EQ(verdict.outcome, Outcome::reject) << verdict.text;
  EXPECT_THAT(verdict.text, testing::HasSubstr("mine"));
  std::string names;
  for (const Rejection& rejection : verdict.result.rejections) {
    names += rejection.map + ": " + rejection.looks_like + "; ";
  }
  EXPECT_THAT(names, testing::HasSubstr(looks_like)) << verdict.text;
}

// Each is named right on some map, or called unknown.
TEST(JudgeSampler, RejectsDefectsOfSomebodyElses) {
  expect_rejected<Defect::no_sine>("other-density");
  expect_rejected<Defect::density_of_square>("pdf-of-another-measure");
  expect_rejected<Defect::one_column_late>("column-late");
  expect_rejected<Defect::texel_centres>("uneven-in-texel");
  expect_rejected<Defect::clipped_sun>("unknown");
  expect_rejected<Defect::squared_luminance>("squared");
  expect_rejected<Defect::upside_down>("upside-down");
  expect_rejected<Defect::half_texel>("half-texel");
  expect_rejected<Defect::coarse_numbers>("coarse-numbers");
  expect_rejected<Defect::red_only>("unknown");
  expect_rejected<Defect::uniform_rows>("rows-alike");
  expect_rejected<Defect::pdf_of_last_row_missing>("pdf-mismatch");
}

/// Uniform over the square: right on a map without features under density A, and only there.
struct UniformOverSquare {
  explicit UniformOverSquare(const EnvironmentMap& map) : extent(map.radiance.extent()) {}
  TexelSample sample(SquarePoint u) const {
    return {u, cell_of(u.s, extent.width), cell_of(u.t, extent.height), {1.0}};
  }
  PerSquare pdf(SquarePoint /*at*/) const { return {1.0}; }
  Extent extent;
};

TEST(JudgeSampler, TakesPointsOfTheSquareAndMapsOfTheCallers) {
  EnvironmentMap grey = {"grey", Grid<Rgb>({32, 16}, Rgb(0.5F)), {}};
  const SamplerTestOptions on_grey = {.density_space = DensitySpace::texture, .maps = {grey}};
  const SamplerVerdict accepted = judge_sampler<UniformOverSquare>("uniform", on_grey);
  EXPECT_TRUE(accepted.is_accepted) << accepted.text;
  EXPECT_FALSE(judge_sampler<UniformOverSquare>("uniform", {.density_space = DensitySpace::texture})
                   .is_accepted);
}

/// Uniform over the sphere: at u.t = 0 it is exactly at a pole.
struct UniformOverSphere {
  explicit UniformOverSphere(const EnvironmentMap& /*map*/) {}
  LightSample sample(SquarePoint u) const {
    const double z = 2.0 * u.t - 1.0;
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    const double phi = kPi - 2.0 * kPi * u.s;
    return {{radius * std::cos(phi), radius * std::sin(phi), z}, {0.25 / kPi}, 0, 0};
  }
  PerSteradian pdf(Direction /*direction*/) const { return {0.25 / kPi}; }
};

TEST(JudgeSampler, AcceptsDirectionsThatAreExactlyAtAPole) {
  EnvironmentMap grey = {"grey", Grid<Rgb>({32, 16}, Rgb(0.5F)), {}};
  const SamplerVerdict verdict = judge_sampler<UniformOverSphere>(
      "uniform", {.density_space = DensitySpace::solid_angle, .maps = {grey}});
  EXPECT_TRUE(verdict.is_accepted) << verdict.text;
}

// No verdict is no acceptance.
TEST(JudgeSampler, DoesNotAcceptWhatTooFewSamplesCannotTell) {
  const SamplerVerdict verdict = judge_sampler<RightSampler>("mine", {.samples = 1024});
  EXPECT_FALSE(verdict.is_accepted);
  EXPECT_EQ(verdict.outcome, Outcome::inconclusive) << verdict.text;
}

}  // namespace
}  // namespace lightproof
