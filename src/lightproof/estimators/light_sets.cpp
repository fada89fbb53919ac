#include "lightproof/estimators/light_sets.h"

#include <algorithm>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/estimators/cell_cdf.h"
#include "lightproof/estimators/light_samples.h"
#include "lightproof/estimators/texel_directions.h"
#include "lightproof/points/sobol.h"
#include "lightproof/samplers/texel_positions.h"
#include "lightproof/samplers/texel_weights.h"
#include "lightproof/warp/octahedral.h"

namespace lightproof {
namespace {

/// Orientations along a side of the octahedral square, and lights of each.
constexpr int kSide = 8;
constexpr std::uint32_t kLights = 1024;
constexpr std::uint64_t kSeed = 1;

std::size_t orientation_of(Direction normal) {
  const SquarePoint at = square_from_octahedral(normal);
  return static_cast<std::size_t>(cell_of(at.t, kSide) * kSide + cell_of(at.s, kSide));
}

Direction centre_of(std::size_t orientation) {
  const auto side = static_cast<std::size_t>(kSide);
  const std::size_t row = orientation / side;
  return octahedral_from_square({(static_cast<double>(orientation % side) + 0.5) / kSide,
                                 (static_cast<double>(row) + 0.5) / kSide});
}

/// The sine of the largest angle between an orientation's centre and a normal that is looked up
/// there. Along the edges of a cell the angle has its largest value: many places of them are tried,
/// and a step between two is added.
double sine_of_reach(std::size_t orientation) {
  constexpr int kSteps = 64;
  const Direction centre = centre_of(orientation);
  const std::size_t row = orientation / static_cast<std::size_t>(kSide);
  const auto x = static_cast<double>(orientation % static_cast<std::size_t>(kSide));
  const auto y = static_cast<double>(row);
  double least = 1.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double fraction = static_cast<double>(i) / kSteps;
    for (const SquarePoint in : {SquarePoint{fraction, 0.0}, SquarePoint{fraction, 1.0},
                                 SquarePoint{0.0, fraction}, SquarePoint{1.0, fraction}}) {
      const Direction edge = octahedral_from_square({(x + in.s) / kSide, (y + in.t) / kSide});
      least = std::min(least, glm::dot(edge, centre));
    }
  }
  return std::sin(std::acos(least) + kPi / (kSide * kSteps));
}

/// Sets of lights of all orientations, one after the other.
class LightSets {
 public:
  explicit LightSets(const EnvironmentMap& map)
      : lights_(static_cast<std::size_t>(kSide * kSide) * kLights) {
    const Grid<double> weights = texel_weights(map, on_map({DensitySpace::solid_angle}, map));
    const TexelPositions positions(weights.extent(), DensitySpace::solid_angle);
    const TexelDirections centres(cell_size(weights.extent()), 0.5, weights.extent());
    parallel_for(static_cast<std::size_t>(kSide * kSide), [&](std::size_t orientation) {
      draw_set(orientation, product(orientation, weights, centres), positions);
    });
  }

  std::size_t bytes() const { return lights_.size() * sizeof(LightSample); }
  std::span<const LightSample> of(Direction normal) const {
    return std::span(lights_).subspan(orientation_of(normal) * kLights, kLights);
  }

 private:
  /// Light times (n·w) plus the sine of the reach, and 0 where no normal sees anything of a texel.
  static CellCdf product(std::size_t orientation, const Grid<double>& weights,
                         const TexelDirections& centres) {
    Grid<double> product = weights;
    const Direction normal = centre_of(orientation);
    const double texel = std::hypot(kPi / weights.extent().height, kPi / weights.extent().width);
    const double reach = std::min(1.0, sine_of_reach(orientation) + texel);
    double sum = 0.0;
    for (int y = 0; y < weights.extent().height; ++y) {
      for (int x = 0; x < weights.extent().width; ++x) {
        const double seen = glm::dot(normal, centres.at(x, y)) + reach;
        sum += product(x, y) *= std::max(0.0, seen);
      }
    }
    if (!(sum > 0.0)) product = weights;
    return CellCdf(std::move(product));
  }

  void draw_set(std::size_t orientation, const CellCdf& product, const TexelPositions& positions) {
    const Sobol points(kSeed + orientation);
    for (std::uint32_t i = 0; i < kLights; ++i) {
      lights_[orientation * kLights + i] = positions.direction(product.draw(points.point(i)));
    }
  }

  std::vector<LightSample> lights_;
};

/// Lights of a set from one on, and around from its end to its beginning.
struct Run {
  std::span<const LightSample> set;
  std::size_t first;
  std::size_t count;

  const LightSample& operator[](std::size_t i) const { return set[(first + i) % set.size()]; }
};

Rgb mean_of(const Run& run, const EnvironmentMap& map, const Scene& scene, const Material& material,
            const ShadingPoint& at) {
  LightSamples samples;
  Arrivals arrivals;
  glm::dvec3 sum(0.0);
  for (std::size_t done = 0; done < run.count; done += LightSamples::kCapacity) {
    samples.count = std::min(run.count - done, LightSamples::kCapacity);
    for (std::size_t i = 0; i < samples.count; ++i) {
      samples.set(i, run[done + i]);
    }
    samples.reflect(material, at);
    for (const Rgb rgb : samples.estimates(scene, map.radiance, at.position, arrivals)) {
      sum += glm::dvec3(rgb);
    }
  }
  return Rgb(sum / static_cast<double>(run.count));
}

}  // namespace

PreparedEstimator light_sets(const EnvironmentMap& map) {
  const auto sets = std::make_shared<const LightSets>(map);
  return {
      [&map, sets](const Scene& scene, const Material& material) -> BoundEstimator {
        return {[&map, sets, &scene, material](const ShadingPoint& at, const RandomStream& stream,
                                               Budget budget, const EachEstimate& /*each*/) {
          const auto set = sets->of(at.frame.normal);
          const auto count = std::min<std::uint64_t>(budget.samples, set.size());
          const auto first = static_cast<std::size_t>(stream.point(budget.first).s *
                                                      static_cast<double>(set.size()));
          return mean_of({set, first, count}, map, scene, material, at);
        }};
      },
      sets->bytes()};
}

}  // namespace lightproof
