// No operation of a correct sampler gives NaN or an infinity, on the hardest of maps and at the
// ends of the random numbers, alone or with any vectors.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "lightproof/cases/adversarial_maps.h"
#include "lightproof/core/random.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/registry.h"
#include "tests/core/kinds_of_vectors.h"
#include "tests/core/trap_floating_point.h"

namespace lightproof {
namespace {

constexpr std::size_t kPoints = 509;  // no whole number of vectors

EnvironmentMap map_of(std::string name, Extent extent, float everywhere, float at_one) {
  EnvironmentMap map{.name = std::move(name), .radiance = Grid<Rgb>(extent, Rgb(everywhere))};
  map.radiance(extent.width / 2, extent.height / 3) = Rgb(at_one);
  return map;
}

std::vector<EnvironmentMap> hard_maps() {
  constexpr float kMost = std::numeric_limits<float>::max();
  constexpr float kLeast = std::numeric_limits<float>::denorm_min();
  std::vector<EnvironmentMap> maps;
  for (const Extent extent : {Extent{1, 1}, Extent{7, 5}, Extent{64, 33}}) {
    maps.push_back(map_of("largest", extent, kMost, kMost));
    maps.push_back(map_of("least", extent, kLeast, kLeast));
    maps.push_back(map_of("largest over least", extent, kLeast, kMost));
    maps.push_back(map_of("one texel", extent, 0.0F, 1.0F));
    for (const AdversarialMap& kind : adversarial_maps()) {
      maps.push_back(make_adversarial_map(kind, extent, 1));
    }
  }
  return maps;
}

std::vector<SquarePoint> hard_points() {
  constexpr double kEnds[] = {0.0, 0x1p-60, 0x1p-31, 0.5, 1.0 - 0x1p-24, 1.0 - 0x1p-53, 1.0};
  std::vector<SquarePoint> points;
  for (const double s : kEnds) {
    for (const double t : kEnds) points.push_back({s, t});
  }
  const RandomStream stream("tests/floating-point", 1);
  for (std::uint64_t i = 0; points.size() < kPoints; ++i) points.push_back(stream.point(i));
  return points;
}

struct Directions {
  DirectionBatch spans() { return {x, y, z, pdf, column, row}; }

  std::vector<double> x = std::vector<double>(kPoints);
  std::vector<double> y = std::vector<double>(kPoints);
  std::vector<double> z = std::vector<double>(kPoints);
  std::vector<double> pdf = std::vector<double>(kPoints);
  std::vector<std::int32_t> column = std::vector<std::int32_t>(kPoints);
  std::vector<std::int32_t> row = std::vector<std::int32_t>(kPoints);
};

/// Whether all densities are finite.
bool draw(const AnySampler& any, const std::vector<SquarePoint>& points) {
  std::vector<TexelSample> samples(points.size());
  Directions directions;
  bool are_finite = true;
  std::visit(
      [&](const auto& sampler) {
        sample(sampler, points, samples);
        sample_directions(sampler, points, directions.spans());
        for (const TexelSample& drawn : samples) {
          are_finite = are_finite && std::isfinite(sampler.pdf(drawn.at).value);
        }
        for (const SquarePoint u : points) {
          are_finite = are_finite && std::isfinite(sampler.sample(u).pdf.value);
          are_finite = are_finite && std::isfinite(sample_direction(sampler, u).pdf.value);
        }
      },
      any);
  return are_finite;
}

TEST(FloatingPoint, OfNoCorrectSamplerGivesNaNOrInfinity) {
  const std::vector<SquarePoint> points = hard_points();
  for (const EnvironmentMap& map : hard_maps()) {
    for (const SamplerInfo& info : samplers()) {
      if (info.known_defects) continue;
      for (const DensitySpace density_space : kDensitySpaces) {
        SCOPED_TRACE(testing::Message()
                     << info.name << " " << map.name << " " << map.radiance.extent().width);
        for_each_kind_of_vector([&](const char* /*vectors*/) {
          const test::TrapFloatingPoint trap;
          EXPECT_TRUE(draw(info.make(map, density_space), points));
        });
      }
    }
  }
}

}  // namespace
}  // namespace lightproof
