#include "lightproof/recommend/map_summary.h"

#include <algorithm>
#include <cmath>

#include "lightproof/core/parallel.h"
#include "lightproof/estimators/hierarchical_product.h"
#include "lightproof/estimators/reduced_table.h"
#include "lightproof/estimators/rounded_table.h"
#include "lightproof/estimators/sum_pyramid.h"
#include "lightproof/estimators/two_level_product.h"
#include "lightproof/prefilter/spherical_harmonics.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// Octaves from the mean over the sphere that are told apart.
constexpr int kFaintest = -12;
constexpr int kBrightest = 19;
constexpr int kDark = kFaintest - 1;
constexpr std::size_t kOctaves = kBrightest - kDark + 1;
/// A fainter octave with less than this share of its block's light joins the next one.
constexpr double kLeastShare = 0.02;

/// What is summed over texels.
struct TexelSums {
  double luminance = 0.0;
  double light = 0.0;
  double square = 0.0;
  double mass_squares = 0.0;
  double mass_logarithms = 0.0;
  double largest = 0.0;
};

TexelSums sums_of_row(const EnvironmentMap& map, int y) {
  const double area = texel_solid_angle(map.radiance.extent(), y);
  TexelSums row;
  double squares = 0.0;
  double logarithms = 0.0;
  for (const Rgb texel : map.radiance.row(y)) {
    const double luminance = luminance_of(texel, map.weights);
    row.luminance += luminance;
    squares += luminance * luminance;
    if (luminance > 0.0) logarithms += luminance * std::log2(luminance * area);
    row.largest = std::max(row.largest, luminance);
  }
  row.light = row.luminance * area;
  row.square = squares * area;
  row.mass_squares = squares * area * area;
  row.mass_logarithms = logarithms * area;
  return row;
}

void set_figures(const EnvironmentMap& map, MapSummary& summary) {
  const Extent extent = map.radiance.extent();
  std::vector<TexelSums> rows(static_cast<std::size_t>(extent.height));
  parallel_for(rows.size(),
               [&](std::size_t y) { rows[y] = sums_of_row(map, static_cast<int>(y)); });
  TexelSums all;
  for (const TexelSums& row : rows) {
    all.luminance += row.luminance;
    all.light += row.light;
    all.square += row.square;
    all.mass_squares += row.mass_squares;
    all.mass_logarithms += row.mass_logarithms;
    all.largest = std::max(all.largest, row.largest);
  }
  summary.light = all.light;
  summary.square = all.square;
  summary.square_mean = all.luminance / static_cast<double>(extent.count());
  if (!summary.has_light()) return;
  summary.effective_fraction = all.light * all.light / (kSphere * all.square);
  summary.effective_texels = all.light * all.light / all.mass_squares;
  summary.entropy = std::log2(all.light) - all.mass_logarithms / all.light;
  summary.max_over_mean = all.largest * kSphere / all.light;
}

void set_finest(const EnvironmentMap& map, MapSummary& summary) {
  const Extent extent = map.radiance.extent();
  const int factor =
      std::max((extent.width + MapSummary::kFinest.width - 1) / MapSummary::kFinest.width,
               (extent.height + MapSummary::kFinest.height - 1) / MapSummary::kFinest.height);
  if (factor == 1) {
    summary.finest = Grid<float>::without_values(extent);
    parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
      const auto y = static_cast<int>(row);
      for (int x = 0; x < extent.width; ++x) {
        summary.finest(x, y) = static_cast<float>(luminance_of(map.radiance(x, y), map.weights));
      }
    });
    return;
  }
  const BlockSums sums = block_sums(map, reduced_extent(extent, factor));
  summary.finest = Grid<float>(sums.light.extent());
  summary.finest_square = Grid<float>(sums.light.extent());
  for (int y = 0; y < sums.light.extent().height; ++y) {
    const double area = sums.solid_angle[static_cast<std::size_t>(y)];
    for (int x = 0; x < sums.light.extent().width; ++x) {
      summary.finest(x, y) = static_cast<float>(sums.light(x, y) / area);
      summary.finest_square(x, y) = static_cast<float>(sums.square(x, y) / area);
    }
  }
}

/// For the blocks of a reduced table the solid angle over the light: L^2 / p is L^2 times that and
/// the map's light.
Grid<double> inverse_means(const BlockSums& sums) {
  Grid<double> inverse(sums.light.extent());
  for (int y = 0; y < inverse.extent().height; ++y) {
    for (int x = 0; x < inverse.extent().width; ++x) {
      const double light = sums.light(x, y);
      inverse(x, y) = light > 0.0 ? sums.solid_angle[static_cast<std::size_t>(y)] / light : 0.0;
    }
  }
  return inverse;
}

double added_variance(const BlockSums& sums, double whole) {
  double variance = 0.0;
  for (int y = 0; y < sums.light.extent().height; ++y) {
    const double area = sums.solid_angle[static_cast<std::size_t>(y)];
    for (int x = 0; x < sums.light.extent().width; ++x) {
      const double light = sums.light(x, y);
      if (light > 0.0) variance += std::max(0.0, area * sums.square(x, y) / light - light) / whole;
    }
  }
  return variance;
}

/// One octave of one block while it is summed up.
struct Cell {
  double solid_angle = 0.0;
  double light = 0.0;
  double square = 0.0;
  glm::dvec3 moment = glm::dvec3(0.0);  ///< ∫ L omega, of a dark one ∫ omega
  std::array<double, kTableDensities> second = {};

  void add(const Cell& other) {
    solid_angle += other.solid_angle;
    light += other.light;
    square += other.square;
    moment += other.moment;
    for (std::size_t i = 0; i < kTableDensities; ++i) second[i] += other.second[i];
  }
};

/// What a row of blocks gives.
struct BlockRow {
  std::vector<LightBlock> blocks;
  LightCells cells;
  double light_above_half = 0.0;
  double light_above_mean = 0.0;
};

int octave_of(double luminance, double mean) {
  if (!(luminance > 0.0)) return kDark;
  return std::clamp(std::ilogb(luminance / mean), kFaintest, kBrightest);
}

/// The finest grid cut into blocks, and those into cells.
class Cutter {
 public:
  explicit Cutter(const EnvironmentMap& map, MapSummary& summary)
      : summary_(&summary),
        extent_(summary.finest.extent()),
        most_{std::min(MapSummary::kMostBlocks.width, extent_.width),
              std::min(MapSummary::kMostBlocks.height, extent_.height)},
        mean_(summary.light / kSphere) {
    for (int x = 0; x < extent_.width; ++x) {
      const double phi = kPi - 2.0 * kPi * (x + 0.5) / extent_.width;
      cosine_.push_back(std::cos(phi));
      sine_.push_back(std::sin(phi));
    }
    for (std::size_t i = 0; i < kReductions.size(); ++i) {
      const BlockSums sums = block_sums(map, reduced_extent(map.radiance.extent(), kReductions[i]));
      summary.reduced_variance[i] = added_variance(sums, summary.light);
      inverse_.push_back(inverse_means(sums));
      std::vector<int> columns;
      for (int x = 0; x < extent_.width; ++x) {
        columns.push_back(cell_of((x + 0.5) / extent_.width, sums.light.extent().width));
      }
      columns_.push_back(std::move(columns));
    }
  }

  int rows() const { return most_.height; }

  BlockRow cut(int row) const {
    const int y0 = begin(row, most_.height, extent_.height);
    const int y1 = begin(row + 1, most_.height, extent_.height);
    // Blocks near a pole are joined, so that none is much narrower than high.
    const double sine = sin_theta(0.5 * (y0 + y1) / extent_.height);
    int joined = 1;
    while (2 * joined * sine <= 1.0 && most_.width % (2 * joined) == 0) joined *= 2;
    const int count = most_.width / joined;
    BlockRow made;
    std::vector<std::array<Cell, kOctaves>> cells(static_cast<std::size_t>(count));
    for (int y = y0; y < y1; ++y) add_row(y, joined, cells, made);
    for (int i = 0; i < count; ++i) {
      LightBlock block;
      block.x0 = begin(i * joined, most_.width, extent_.width);
      block.x1 = begin((i + 1) * joined, most_.width, extent_.width);
      block.y0 = y0;
      block.y1 = y1;
      block.centre = direction_from_square(
          {0.5 * (block.x0 + block.x1) / extent_.width, 0.5 * (y0 + y1) / extent_.height});
      block.width = std::max(kPi * (y1 - y0) / extent_.height,
                             2.0 * kPi * sine * (block.x1 - block.x0) / extent_.width);
      block.first_cell = made.cells.size();
      keep(cells[static_cast<std::size_t>(i)], made.cells);
      block.end_cell = made.cells.size();
      made.blocks.push_back(block);
    }
    return made;
  }

 private:
  static int begin(int block, int blocks, int texels) {
    return (block * texels + blocks - 1) / blocks;
  }

  void add_row(int y, int joined, std::vector<std::array<Cell, kOctaves>>& cells,
               BlockRow& made) const {
    const double t = (y + 0.5) / extent_.height;
    const double area = texel_solid_angle(extent_, y);
    const double sine = sin_theta(t);
    const double height = cos_theta(t);
    // Means over the texel's solid angle of sin(theta), for A, and over the one at its centre.
    const double step = kPi / extent_.height;
    const double mean_sine = (0.5 * step - 0.5 * std::sin(step) * std::cos(2.0 * kPi * t)) /
                             (2.0 * sine * std::sin(0.5 * step));
    const double a = 2.0 * kPi * kPi * summary_->square_mean * mean_sine;
    const double c = summary_->light * mean_sine / (sine * std::sin(0.5 * step) / (0.5 * step));
    std::array<std::span<const double>, kReductions.size()> inverse;
    for (std::size_t i = 0; i < inverse.size(); ++i) {
      inverse[i] = inverse_[i].row(cell_of(t, inverse_[i].extent().height));
    }
    for (int x = 0; x < extent_.width; ++x) {
      const double luminance = static_cast<double>(summary_->finest(x, y));
      const double light = area * luminance;
      const double square = summary_->finest_square.extent().count() > 0
                                ? area * static_cast<double>(summary_->finest_square(x, y))
                                : light * luminance;
      made.light_above_half += std::max(0.0, light - 0.5 * mean_ * area);
      made.light_above_mean += std::max(0.0, light - mean_ * area);
      const int block = x * most_.width / extent_.width / joined;
      Cell& cell = cells[static_cast<std::size_t>(block)]
                        [static_cast<std::size_t>(octave_of(luminance, mean_) - kDark)];
      cell.solid_angle += area;
      cell.light += light;
      cell.square += square;
      const auto column = static_cast<std::size_t>(x);
      cell.moment += (light > 0.0 ? light : area) *
                     glm::dvec3(sine * cosine_[column], sine * sine_[column], height);
      cell.second[0] += a * light;
      cell.second[1] += c * light;
      for (std::size_t i = 0; i < inverse.size(); ++i) {
        cell.second[2 + i] +=
            summary_->light * square * inverse[i][static_cast<std::size_t>(columns_[i][column])];
      }
    }
  }

  /// Keeps the octaves of a block, the faint ones joined to brighter ones.
  void keep(const std::array<Cell, kOctaves>& octaves, LightCells& cells) const {
    double all = 0.0;
    std::size_t brightest = 0;
    for (std::size_t i = 0; i < kOctaves; ++i) {
      all += octaves[i].light;
      if (octaves[i].light > 0.0) brightest = i;
    }
    if (octaves[0].solid_angle > 0.0) push(octaves[0], kDark, cells);
    if (!(all > 0.0)) return;
    Cell joined;
    for (std::size_t i = 1; i <= brightest; ++i) {
      joined.add(octaves[i]);
      if (i < brightest && joined.light < kLeastShare * all) continue;
      if (!(octaves[i].light > 0.0)) continue;
      push(joined, static_cast<int>(i) + kDark, cells);
      joined = Cell{};
    }
  }

  void push(const Cell& cell, int octave, LightCells& cells) const {
    const Direction to = glm::normalize(cell.moment);
    cells.x.push_back(to.x);
    cells.y.push_back(to.y);
    cells.z.push_back(to.z);
    cells.solid_angle.push_back(cell.solid_angle);
    cells.light.push_back(cell.light);
    cells.square.push_back(cell.square);
    for (std::size_t i = 0; i < kTableDensities; ++i) cells.second[i].push_back(cell.second[i]);
    cells.octave.push_back(static_cast<std::int8_t>(octave));
  }

  MapSummary* summary_;
  Extent extent_;
  Extent most_;
  double mean_;
  std::vector<double> cosine_;
  std::vector<double> sine_;
  std::vector<Grid<double>> inverse_;
  std::vector<std::vector<int>> columns_;
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void append(LightCells& to, const LightCells& from) {
  append(to.x, from.x);
  append(to.y, from.y);
  append(to.z, from.z);
  append(to.solid_angle, from.solid_angle);
  append(to.light, from.light);
  append(to.square, from.square);
  for (std::size_t i = 0; i < kTableDensities; ++i) append(to.second[i], from.second[i]);
  append(to.octave, from.octave);
}

void set_cells(const EnvironmentMap& map, MapSummary& summary) {
  const Cutter cutter(map, summary);
  std::vector<BlockRow> rows(static_cast<std::size_t>(cutter.rows()));
  parallel_for(rows.size(),
               [&](std::size_t row) { rows[row] = cutter.cut(static_cast<int>(row)); });
  for (const BlockRow& row : rows) {
    const std::size_t before = summary.cells.size();
    append(summary.cells, row.cells);
    for (LightBlock block : row.blocks) {
      block.first_cell += before;
      block.end_cell += before;
      summary.blocks.push_back(block);
    }
    summary.light_above_half += row.light_above_half;
    summary.light_above_mean += row.light_above_mean;
  }
}

/// The blocks that columns or rows of the finest grid lie in: block_of(texel of the map).
template <class BlockOf>
std::vector<std::uint16_t> blocks_along(int cells, int texels, const BlockOf& block_of) {
  std::vector<std::uint16_t> blocks;
  for (int i = 0; i < cells; ++i) {
    blocks.push_back(
        static_cast<std::uint16_t>(block_of(static_cast<int>((i + 0.5) * texels / cells))));
  }
  return blocks;
}

template <class BlockOf>
BlockIndex index_of(const MapSummary& summary, Extent blocks, const BlockOf& block_of) {
  const auto [width, height] = summary.finest.extent();
  return {blocks_along(width, summary.extent.width,
                       [&](int x) { return block_of(x, summary.extent.width, blocks.width); }),
          blocks_along(height, summary.extent.height,
                       [&](int y) { return block_of(y, summary.extent.height, blocks.height); }),
          blocks.width};
}

/// Sums of light and of solid angle over larger blocks.
struct BlockTotals {
  Grid<double> light;
  Grid<double> area;
};

BlockTotals totals_of(const MapSummary& summary, const BlockIndex& index, Extent blocks) {
  BlockTotals totals{Grid<double>(blocks), Grid<double>(blocks)};
  const Extent extent = summary.finest.extent();
  for (int y = 0; y < extent.height; ++y) {
    const double area = texel_solid_angle(extent, y);
    for (int x = 0; x < extent.width; ++x) {
      const std::size_t block = index.of(x, y);
      totals.light.values()[block] += area * static_cast<double>(summary.finest(x, y));
      totals.area.values()[block] += area;
    }
  }
  return totals;
}

void set_products(MapSummary& summary) {
  constexpr int kMost = TwoLevelProduct::kMostBlocks;
  const Extent blocks = {std::min(kMost, summary.extent.width),
                         std::min(kMost, summary.extent.height)};
  summary.product_index = index_of(summary, blocks, [](int texel, int texels, int count) {
    int block = texel * count / texels;
    while ((block + 1) * texels / count <= texel) ++block;
    return block;
  });
  summary.product_light = totals_of(summary, summary.product_index, blocks).light;

  Extent squares = summary.extent;
  int side = 1;
  while (squares.width > HierarchicalProduct::kMostSquares.width ||
         squares.height > HierarchicalProduct::kMostSquares.height) {
    squares = {(squares.width + 1) / 2, (squares.height + 1) / 2};
    side *= 2;
  }
  summary.quadrant_side = side;
  summary.quadrant_index =
      index_of(summary, squares, [side](int texel, int, int) { return texel / side; });
  BlockTotals totals = totals_of(summary, summary.quadrant_index, squares);
  summary.quadtree_light = sum_pyramid(std::move(totals.light));
  summary.quadtree_area = sum_pyramid(std::move(totals.area));

  const Extent extent = summary.finest.extent();
  LightCells& cells = summary.cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const SquarePoint at = approximate_square_from_direction({cells.x[i], cells.y[i], cells.z[i]});
    const int x = cell_of(at.s, extent.width);
    const int y = cell_of(at.t, extent.height);
    cells.product.push_back(summary.product_index.of(x, y));
    cells.quadrant.push_back(summary.quadrant_index.of(x, y));
  }
}

}  // namespace

double MapSummary::light_above(double of_mean) const {
  if (of_mean == 0.0) return light;
  if (of_mean == 0.5) return light_above_half;
  if (of_mean == 1.0) return light_above_mean;
  const double floor = of_mean * light / kSphere;
  double above = 0.0;
  for (int y = 0; y < finest.extent().height; ++y) {
    double row = 0.0;
    for (const float luminance : finest.row(y)) {
      row += std::max(0.0, static_cast<double>(luminance) - floor);
    }
    above += row * texel_solid_angle(finest.extent(), y);
  }
  return above;
}

double MapSummary::power(int degree) const {
  double sum = 0.0;
  for (int m = -degree; m <= degree; ++m) {
    const double coefficient = harmonics[harmonic_index(degree, m)];
    sum += coefficient * coefficient;
  }
  return sum;
}

MapSummary summarise(const EnvironmentMap& map) {
  MapSummary summary;
  summary.extent = map.radiance.extent();
  summary.weights = map.weights;
  set_figures(map, summary);
  const SphericalHarmonics harmonics = project(map, MapSummary::kDegree);
  for (const glm::dvec3& coefficient : harmonics.coefficients) {
    summary.harmonics.push_back(map.weights.red * coefficient.r +
                                map.weights.green * coefficient.g +
                                map.weights.blue * coefficient.b);
  }
  if (!summary.has_light()) return summary;
  set_finest(map, summary);
  set_cells(map, summary);
  set_products(summary);
  summary.half_float_variance = rounded_table_variance(map, MassForm::half);
  summary.byte_variance = rounded_table_variance(map, MassForm::byte);
  for (std::size_t i = 0; i < summary.lights.size(); ++i) {
    summary.lights[i] = median_cut(map, MapSummary::kCuts[i]);
  }
  return summary;
}

}  // namespace lightproof
