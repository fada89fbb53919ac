// Hierarchical sample warping (Clarberg et al. 2005, "Wavelet importance sampling", section 4):
// from the whole map down, a point chooses among four quarters by their sums, first the row, then
// the column, and what is left of it goes on in the chosen quarter. O(log(max(W, H))) a sample,
// 16/3 bytes a texel. Neighbouring points stay neighbours, and strata keep their area, but get
// pinched.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lightproof/core/huge_pages.h"
#include "lightproof/core/select.h"
#include "lightproof/samplers/alias_table.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// The sampler by hierarchical warping over a pyramid of sums.
class Hierarchical {
 public:
  /// Throws InputError if the map is black.
  Hierarchical(const EnvironmentMap& map, TargetDensity target);

  TexelDraw draw(SquarePoint point) const {
    Descent at{below_one(point)};
    for (const Level& level : levels_) descend(level, at);
    return at.draw();
  }
  /// Draws at several points, level by level: the way down is one long chain of divisions, of which
  /// a processor works on several at once. The samples are those of draw(), bit for bit.
  template <std::size_t kCount>
  void draw_together(std::span<const SquarePoint, kCount> points,
                     std::span<TexelDraw, kCount> draws) const {
    std::array<Descent, kCount> all;
    for (std::size_t i = 0; i < kCount; ++i) all[i] = Descent{below_one(points[i])};
    for (const Level& level : levels_) {
      for (Descent& at : all) descend(level, at);
    }
    for (std::size_t i = 0; i < kCount; ++i) draws[i] = all[i].draw();
  }
  TexelSample sample(SquarePoint u) const { return positions_.sample(draw(u)); }
  const TexelPositions& positions() const { return positions_; }

  PerSquare pdf(SquarePoint at) const;

  std::size_t table_bytes() const { return sums_.size() * sizeof(float) + positions_.bytes(); }

 private:
  /// Sums of squares of 2^k texels; those at the edges may reach beyond the map. The last one holds
  /// texels, the first one has at most 2 x 2 sums.
  struct Level {
    Extent extent;
    bool splits_s;      ///< whether it is wider than the level before it
    bool splits_t;      ///< whether it is higher than the level before it
    std::size_t first;  ///< where its sums begin
  };

  /// A sample on its way down: the square that was chosen, and what is left of its point.
  struct Descent {
    SquarePoint u;
    int x = 0;
    int y = 0;
    double mass = 1.0;  ///< probability of the square

    TexelDraw draw() const { return {x, y, u.s, u.t, mass}; }
  };
  void descend(const Level& level, Descent& at) const {
    const Children children = children_of(level, at.x, at.y);
    const Split row = split(at.u.t, children.sum[0][0] + children.sum[0][1],
                            children.sum[1][0] + children.sum[1][1]);
    const bool upper = row.chosen == 0;
    const Split column = split(at.u.s, select(upper, children.sum[0][0], children.sum[1][0]),
                               select(upper, children.sum[0][1], children.sum[1][1]));
    at.x = children.x + column.chosen;
    at.y = children.y + row.chosen;
    at.u = {column.rest, row.rest};
    at.mass *= row.share * column.share;
  }

  /// The quarters of a square, and the first one's position. Those that do not exist have no mass.
  struct Children {
    int x;
    int y;
    double sum[2][2];  ///< [row][column]
  };
  Children children_of(const Level& level, int x, int y) const {
    const int x0 = level.splits_s ? 2 * x : x;
    const int y0 = level.splits_t ? 2 * y : y;
    const float* const row =
        &sums_[level.first +
               static_cast<std::size_t>(y0) * static_cast<std::size_t>(level.extent.width) +
               static_cast<std::size_t>(x0)];
    const bool across = level.splits_s && x0 + 1 < level.extent.width;
    const bool along = level.splits_t && y0 + 1 < level.extent.height;
    const float* const next = row + level.extent.width;
    const auto sum = [](bool exists, const float* at) { return exists ? double{*at} : 0.0; };
    return {
        x0,
        y0,
        {{double{*row}, sum(across, row + 1)}, {sum(along, next), sum(across && along, next + 1)}}};
  }

  struct Split {
    int chosen;
    double share;  ///< probability of what was chosen
    double rest;   ///< what is left of the random number, in [0,1)
  };
  /// Chooses between two sums by a random number in [0,1), without a branch: a processor would
  /// guess it wrong at every other level.
  static Split split(double u, double low, double high) {
    const double share = low / (low + high);
    const bool is_low = u < share;
    return {is_low ? 0 : 1, select(is_low, share, high / (low + high)), rest_of_choice(u, share)};
  }

  void set_sums(const Level& level, const Grid<double>& sums, double scale);

  TexelPositions positions_;
  std::vector<Level> levels_;  ///< from the coarsest to the texels
  TableVector<float> sums_;    ///< in units of the mean texel
};
static_assert(EnvSampler<Hierarchical>);

}  // namespace lightproof
