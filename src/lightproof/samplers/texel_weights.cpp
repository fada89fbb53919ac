#include "lightproof/samplers/texel_weights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/texel_faults.h"
#include "lightproof/samplers/weight_vectors.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

struct Texel {
  int x;
  int y;
};

/// Weights of texels of one row, from the first on.
void weigh_part(const EnvironmentMap& map, TargetDensity target, Texel first,
                std::span<double> weights) {
  const Extent extent = map.radiance.extent();
  const bool by_solid_angle =
      texel_measure(target.density_space, map.mapping) == MapMeasure::solid_angle;
  const bool has_rows = rows_are_parallels(map.mapping);
  const double area =
      by_solid_angle && has_rows ? texel_solid_angle(map.mapping, extent, 0, first.y) : 1.0;
  const auto offset =
      static_cast<std::size_t>(first.y) * static_cast<std::size_t>(map.radiance.extent().width) +
      static_cast<std::size_t>(first.x);
  if (!weigh(map.radiance.values().subspan(offset), target.weights, area, weights).are_possible) {
    refuse_impossible(map);
  }
  if (!by_solid_angle || has_rows) return;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] *= texel_solid_angle(map.mapping, extent, first.x + static_cast<int>(i), first.y);
  }
}

bool any_light(std::span<const double> weights) {
  return std::ranges::any_of(weights, [](double weight) { return weight > 0.0; });
}

/// Looks no further than to where some is found.
bool has_light(const CellWeights& weights) {
  std::atomic<bool> found = false;
  parallel_chunks(
      weights.count(), kTaskCells, [&](std::size_t /*task*/, std::size_t first, std::size_t end) {
        std::array<double, 64> memory;
        for (; first < end && !found.load(std::memory_order_relaxed); first += memory.size()) {
          const auto block = std::span(memory).first(std::min(memory.size(), end - first));
          weights.get(first, block);
          if (any_light(block)) found.store(true, std::memory_order_relaxed);
        }
      });
  return found;
}

}  // namespace

Grid<double> texel_weights(const EnvironmentMap& map, TargetDensity target) {
  const Extent extent = map.radiance.extent();
  Grid<double> weights = Grid<double>::without_values(extent);
  std::vector<char> lit(static_cast<std::size_t>(extent.height));
  parallel_for(lit.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    weigh_row(map, target, y, weights.row(y));
    lit[row] = any_light(weights.row(y)) ? 1 : 0;
  });
  if (std::ranges::find(lit, 1) == lit.end()) refuse_black(map);
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

void refuse_impossible(const EnvironmentMap& map) {
  const TexelScan scan = scan_texels(map.radiance);
  throw InputError(fmt::format(
      "{}: texels have a luminance that is negative or no finite number ({}): there is no density "
      "in "
      "proportion to it; readers of files refuse or repair such values",
      map.name, scan.clean() ? "by their weights of red, green and blue" : describe_faults(scan)));
}

void refuse_black(const EnvironmentMap& map) {
  throw InputError(fmt::format("{}: the map is black: there is no light to sample", map.name));
}

}  // namespace lightproof
