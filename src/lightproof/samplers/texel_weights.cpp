#include "lightproof/samplers/texel_weights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/samplers/weight_vectors.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

struct Texel {
  int x;
  int y;
};

/// Weights of texels of one row, from the first on.
void weigh_part(const EnvironmentMap& map, TargetDensity target, Texel first,
                std::span<double> weights) {
  const double area =
      target.weighting == Weighting::B ? texel_solid_angle(map.radiance.extent(), first.y) : 1.0;
  weigh(map.radiance.row(first.y).subspan(static_cast<std::size_t>(first.x), weights.size()),
        target.grey, area, weights);
}

/// Looks no further than the first cell with some.
bool has_light(const CellWeights& weights) {
  std::array<double, 64> block;
  for (std::size_t first = 0; first < weights.count(); first += block.size()) {
    const auto some = std::span(block).first(std::min(block.size(), weights.count() - first));
    weights.get(first, some);
    if (std::ranges::any_of(some, [](double weight) { return weight > 0.0; })) return true;
  }
  return false;
}

}  // namespace

Grid<double> texel_weights(const EnvironmentMap& map, TargetDensity target) {
  const Extent extent = map.radiance.extent();
  Grid<double> weights = Grid<double>::without_values(extent);
  std::vector<char> has_light(static_cast<std::size_t>(extent.height));
  parallel_for(has_light.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    weigh_row(map, target, y, weights.row(y));
    has_light[row] = std::ranges::any_of(weights.row(y), [](double w) { return w > 0.0; }) ? 1 : 0;
  });
  if (std::ranges::find(has_light, 1) == has_light.end()) refuse_black(map);
  return weights;
}

void weigh_row(const EnvironmentMap& map, TargetDensity target, int y, std::span<double> weights) {
  weigh_part(map, target, {0, y}, weights);
}

CellWeights::CellWeights(std::span<const double> weights)
    : count_(weights.size()), get_([weights](std::size_t first, std::span<double> out) {
        std::ranges::copy(weights.subspan(first, out.size()), out.begin());
      }) {}

CellWeights::CellWeights(const EnvironmentMap& map, TargetDensity target)
    : count_(map.radiance.extent().count()),
      get_([&map, target](std::size_t first, std::span<double> out) {
        const auto width = static_cast<std::size_t>(map.radiance.extent().width);
        while (!out.empty()) {
          const std::size_t x = first % width;
          const std::size_t count = std::min(out.size(), width - x);
          weigh_part(map, target, {static_cast<int>(x), static_cast<int>(first / width)},
                     out.first(count));
          out = out.subspan(count);
          first += count;
        }
      }) {
  if (!has_light(*this)) refuse_black(map);
}

void refuse_black(const EnvironmentMap& map) {
  throw InputError(fmt::format("{}: the map is black: there is no light to sample", map.name));
}

}  // namespace lightproof
