#include "lightproof/estimators/reduced_table.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <utility>

#include "lightproof/core/parallel.h"
#include "lightproof/samplers/alias.h"

namespace lightproof {
namespace {

/// A part of a texel's side: the block that it lies in, its share of the texel's side, and where it
/// begins and ends in texels.
struct Part {
  int block;
  double from;
  double to;
};

/// The parts into which the edges of blocks cut each of the texels of a side, one or two.
std::vector<std::vector<Part>> parts_of(int texels, int blocks) {
  std::vector<std::vector<Part>> parts(static_cast<std::size_t>(texels));
  for (int block = 0; block < blocks; ++block) {
    const double begin = static_cast<double>(block) * texels / blocks;
    const double end = static_cast<double>(block + 1) * texels / blocks;
    for (int texel = static_cast<int>(begin); texel < end && texel < texels; ++texel) {
      const Part part = {block, std::max(begin, static_cast<double>(texel)),
                         std::min(end, texel + 1.0)};
      if (part.to > part.from) parts[static_cast<std::size_t>(texel)].push_back(part);
    }
  }
  return parts;
}

/// The solid angle between two t, of all columns, without cancellation at the poles.
double band(double from, double to) {
  return kSphere * sin_theta(0.5 * (from + to)) * std::sin(0.5 * kPi * (to - from));
}

/// Sums over the columns of one row of texels, in texels: L and L^2.
struct RowSums {
  explicit RowSums(std::size_t blocks) : light(blocks), square(blocks) {}

  void add(double luminance, std::span<const Part> parts) {
    for (const Part& part : parts) {
      const auto block = static_cast<std::size_t>(part.block);
      light[block] += (part.to - part.from) * luminance;
      square[block] += (part.to - part.from) * luminance * luminance;
    }
  }

  std::vector<double> light;
  std::vector<double> square;
};

/// A grey map of the blocks' means; where there is light, none rounds to 0.
EnvironmentMap map_of_means(const EnvironmentMap& map, int factor) {
  const BlockSums sums = block_sums(map, reduced_extent(map.radiance.extent(), factor));
  EnvironmentMap means{"means of blocks", Grid<Rgb>(sums.light.extent())};
  for (int y = 0; y < means.radiance.extent().height; ++y) {
    for (int x = 0; x < means.radiance.extent().width; ++x) {
      const double mean = sums.light(x, y) / sums.solid_angle[static_cast<std::size_t>(y)];
      if (!(mean > 0.0)) continue;
      means.radiance(x, y) =
          Rgb(std::max(static_cast<float>(mean), std::numeric_limits<float>::min()));
    }
  }
  means.weights = kAverageLuminance;
  return means;
}

}  // namespace

Extent reduced_extent(Extent map, int factor) {
  return {(map.width + factor - 1) / factor, (map.height + factor - 1) / factor};
}

BlockSums block_sums(const EnvironmentMap& map, Extent blocks) {
  const Extent extent = map.radiance.extent();
  assert(blocks.width >= 1 && blocks.width <= extent.width);
  assert(blocks.height >= 1 && blocks.height <= extent.height);
  const auto columns = parts_of(extent.width, blocks.width);
  BlockSums sums{Grid<double>(blocks), Grid<double>(blocks),
                 std::vector<double>(static_cast<std::size_t>(blocks.height))};
  parallel_for(static_cast<std::size_t>(blocks.height), [&](std::size_t block) {
    const auto row = static_cast<int>(block);
    const double begin = static_cast<double>(row) * extent.height / blocks.height;
    const double end = static_cast<double>(row + 1) * extent.height / blocks.height;
    sums.solid_angle[block] = band(begin / extent.height, end / extent.height) / blocks.width;
    for (int y = static_cast<int>(begin); y < end && y < extent.height; ++y) {
      const double from = std::max(begin, static_cast<double>(y));
      const double to = std::min(end, y + 1.0);
      if (!(to > from)) continue;
      RowSums of_row(static_cast<std::size_t>(blocks.width));
      for (int x = 0; x < extent.width; ++x) {
        of_row.add(luminance_of(map.radiance(x, y), map.weights),
                   columns[static_cast<std::size_t>(x)]);
      }
      const double area = band(from / extent.height, to / extent.height) / extent.width;
      for (int x = 0; x < blocks.width; ++x) {
        sums.light(x, row) += area * of_row.light[static_cast<std::size_t>(x)];
        sums.square(x, row) += area * of_row.square[static_cast<std::size_t>(x)];
      }
    }
  });
  return sums;
}

PreparedSource reduced_table_source(const EnvironmentMap& map, int factor) {
  const EnvironmentMap means = map_of_means(map, factor);
  const auto table =
      std::make_shared<const Alias>(means, on_map({DensitySpace::solid_angle}, means));
  return {&map,
          [&map, table](const Material& material) -> SamplesAt {
            return [&map, table, material](const ShadingPoint& at) -> DrawSamples {
              return [&map, &table = *table, &material, &at](const BatchPoints& points,
                                                             LightSamples& samples) {
                draw_batch(table, points, samples.batch());
                samples.locate(map.radiance.extent());
                samples.reflect(material, at);
              };
            };
          },
          table->table_bytes()};
}

std::function<PerSteradian(SquarePoint)> reduced_table_pdf(const EnvironmentMap& map, int factor) {
  BlockSums sums = block_sums(map, reduced_extent(map.radiance.extent(), factor));
  Grid<double> densities = std::move(sums.light);
  double whole = 0.0;
  for (const double light : densities.values()) whole += light;
  for (int y = 0; y < densities.extent().height; ++y) {
    const double area = sums.solid_angle[static_cast<std::size_t>(y)];
    for (double& density : densities.row(y)) density = whole > 0.0 ? density / area / whole : 0.0;
  }
  return [densities = std::make_shared<const Grid<double>>(std::move(densities))](SquarePoint at) {
    const Extent extent = densities->extent();
    return PerSteradian{(*densities)(cell_of(at.s, extent.width), cell_of(at.t, extent.height))};
  };
}

double reduced_table_variance(const EnvironmentMap& map, int factor) {
  const BlockSums sums = block_sums(map, reduced_extent(map.radiance.extent(), factor));
  double whole = 0.0;
  for (const double light : sums.light.values()) whole += light;
  double variance = 0.0;
  for (int y = 0; y < sums.light.extent().height; ++y) {
    const double solid_angle = sums.solid_angle[static_cast<std::size_t>(y)];
    for (int x = 0; x < sums.light.extent().width; ++x) {
      const double light = sums.light(x, y);
      if (!(light > 0.0)) continue;
      variance += std::max(0.0, solid_angle * sums.square(x, y) / light - light) / whole;
    }
  }
  return variance;
}

}  // namespace lightproof
