// Densities on a grid of directions: right ones are accepted, and single cells that are off,
// factors and holes are found.
#include "lightproof/check/density_grid.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <vector>

#include "lightproof/image/synthetic.h"
#include "lightproof/warp/lat_long.h"
#include "tests/check/written_dump.h"

namespace lightproof {
namespace {

using testing::HasSubstr;

constexpr Extent kExtent = {64, 32};

const EnvironmentMap& sky() {
  static const EnvironmentMap map = make_synthetic_map("sun-sky", kExtent);
  return map;
}

const std::shared_ptr<const Expectation>& exact() {
  static const auto expectation = std::make_shared<const Expectation>(
      texel_expectation_of(sky(), {DensitySpace::sine_weighted}));
  return expectation;
}

/// The declared density per steradian at the centre of a texel.
double density_at(int x, int y) {
  const SquarePoint at = {(x + 0.5) / kExtent.width, (y + 0.5) / kExtent.height};
  return exact()->masses(x, y) * static_cast<double>(kExtent.count()) /
         solid_angle_per_square(at.t);
}

using Change = std::function<double(double, int x, int y)>;

/// The densities at all centres, last row first.
test::WrittenDump table(const Change& change = {}) {
  return {kExtent.count(), {"x", "y", "z", "pdf"}, [&](std::size_t i) {
            const int x = static_cast<int>(i) % kExtent.width;
            const int y = kExtent.height - 1 - static_cast<int>(i) / kExtent.width;
            const Direction d =
                direction_from_square({(x + 0.5) / kExtent.width, (y + 0.5) / kExtent.height});
            const double density = density_at(x, y);
            return std::vector<double>{d.x, d.y, d.z, change ? change(density, x, y) : density};
          }};
}

struct Outcomes {
  Outcome points;
  Outcome integral;
  friend bool operator==(const Outcomes&, const Outcomes&) = default;
  friend void PrintTo(const Outcomes& o, std::ostream* out) {
    *out << static_cast<int>(o.points) << ", " << static_cast<int>(o.integral);
  }
};

Outcomes judged(const DensityGrid& grid) {
  const auto records = judge_density_grid(grid, declared_density_of(exact()), 1e-4, {});
  return {records.at(0).outcome, records.at(1).outcome};
}
Outcomes judged(const Change& change) { return judged(density_grid_of(*table(change).dump())); }

constexpr Outcomes kAccepted = {Outcome::accept, Outcome::accept};
constexpr Outcomes kRejected = {Outcome::reject, Outcome::reject};

TEST(DensityGrid, OfTheDeclaredDensityIsAcceptedAndIntegratesToOne) {
  EXPECT_EQ(judged(Change{}), kAccepted);
}

TEST(DensityGrid, ThatIsOffIsRejectedPointByPointAndAsAWhole) {
  EXPECT_EQ(judged([](double p, int, int) { return 1.1 * p; }), kRejected);
  EXPECT_EQ(judged([](double p, int, int y) { return y >= 16 ? 0.0 : p; }), kRejected);
  EXPECT_EQ(judged([](double p, int x, int y) { return x == 3 && y == 20 ? std::nan("") : p; }),
            kRejected);
  // One dim cell of 2048: no integral shows it.
  EXPECT_EQ(judged([](double p, int x, int y) { return x == 3 && y == 3 ? 1.01 * p : p; }),
            (Outcomes{Outcome::reject, Outcome::accept}));
}

TEST(DensityGrid, ThatIsNoGridIsComparedAndNotIntegrated) {
  const test::WrittenDump some = {100, {"s", "t", "pdf"}, [](std::size_t i) {
                                    const int y = static_cast<int>(i) % kExtent.height;
                                    return std::vector<double>{0.5 / kExtent.width,
                                                               (y + 0.5) / kExtent.height,
                                                               density_at(0, y)};
                                  }};
  EXPECT_EQ(judged(density_grid_of(*some.dump())), (Outcomes{Outcome::accept, Outcome::not_run}));
}

TEST(DensityGrid, OfAPictureIsReadPerSteradianOrPerSquare) {
  EnvironmentMap picture = make_synthetic_map("constant", kExtent);
  const auto fill = [&](DensityMeasure measure) {
    for (int y = 0; y < kExtent.height; ++y) {
      for (int x = 0; x < kExtent.width; ++x) {
        const double per = measure == DensityMeasure::square
                               ? solid_angle_per_square((y + 0.5) / kExtent.height)
                               : 1.0;
        picture.radiance(x, y) = Rgb(static_cast<float>(density_at(x, y) * per));
      }
    }
  };
  for (const DensityMeasure measure : {DensityMeasure::solid_angle, DensityMeasure::square}) {
    fill(measure);
    EXPECT_EQ(judged(density_grid_of(picture, measure)), kAccepted);
  }
  EXPECT_EQ(judged(density_grid_of(picture, DensityMeasure::solid_angle)), kRejected);
}

TEST(DensityGrid, OfADistributionOverDirectionsIsComparedWithIt) {
  const auto cosine = [](double factor) {
    return test::WrittenDump(kExtent.count(), {"s", "t", "pdf"}, [factor](std::size_t i) {
      const std::size_t column = i % 64;
      const std::size_t row = i / 64;
      const SquarePoint at = {(static_cast<double>(column) + 0.5) / kExtent.width,
                              (static_cast<double>(row) + 0.5) / kExtent.height};
      const double z = direction_from_square(at).z;
      return std::vector<double>{at.s, at.t, factor * std::max(0.0, z) / kPi};
    });
  };
  const DeclaredDensity declared = declared_density_of(direction_target("cosine").value());
  const auto outcomes = [&](double factor) {
    const auto records =
        judge_density_grid(density_grid_of(*cosine(factor).dump()), declared, 1e-4, {});
    return Outcomes{records.at(0).outcome, records.at(1).outcome};
  };
  EXPECT_EQ(outcomes(1.0), kAccepted);
  EXPECT_EQ(outcomes(1.02), kRejected);
}

// With no declared density the integral is all that can be said.
TEST(DensityGrid, WithoutADeclaredDensityIsIntegrated) {
  const auto integral = [](const Change& change) {
    return judge_density_grid(density_grid_of(*table(change).dump()), {}, 1e-4, {}).at(0);
  };
  EXPECT_EQ(integral({}).outcome, Outcome::accept);
  const TestRecord wrong = integral([](double p, int, int) { return 1.1 * p; });
  EXPECT_EQ(wrong.outcome, Outcome::reject);
  EXPECT_THAT(wrong.detail, HasSubstr("add up to 1.09956"));
}

}  // namespace
}  // namespace lightproof
