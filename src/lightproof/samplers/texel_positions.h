// Where in a texel a sample lies, and with what density: the same for every sampler that draws
// whole texels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "lightproof/core/select.h"
#include "lightproof/samplers/cell_angles.h"
#include "lightproof/samplers/cell_margin.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {

/// Chooses t inside a row so that cos(theta) is uniform: equal solid angles are equally likely.
/// sin^2 of half the angle from a pole is linear in the share of the row's solid angle; rows are
/// counted from the nearer pole, where its inverse loses no precision.
///
/// The sine of the angle theta from the pole follows from that by a square root, and theta itself
/// without an arc sine of it: sin(theta - begin) = sin(theta) cos(begin) - cos(theta) sin(begin),
/// begin being the angle of the row's edge, and of so small a number a few terms of the arc sine's
/// series are all that a double holds. Every operation is one that IEEE 754 rounds, so that all
/// kinds of vectors get the bits of the scalar code. On maps of few rows it is an arc sine.
class SolidAngleRows {
 public:
  /// A line of the table: what is known of a row, and of the one as far from the other pole. Angles
  /// are those from the pole.
  struct Line {
    double squared_sine;  ///< sin^2 of half the angle at which the row begins
    double span;          ///< by how much that is more where it ends
    double sine;          ///< of the angle at which the row begins
    double cosine;        ///< of the angle at which the row begins
  };

  /// A position along a row.
  struct RowPosition {
    double t;
    double sine;  ///< sin(theta) there
  };

  explicit SolidAngleRows(Extent extent);

  /// The position in row `y` below which lies the share `fraction` of the row's solid angle.
  RowPosition position(int y, double fraction) const {
    const RowShare at = row_share(y, fraction);
    if (!has_many_rows(height_)) {
      const double half_sine = std::min(std::sqrt(at.squared_sine), 1.0);
      const double t = t_of(y, 2.0 / kPi * std::asin(half_sine) * height_ - from_pole(y));
      return {t, sin_theta(t)};
    }
    return {t_of(y, since_edge(*at.line, at.sine, at.cosine)), at.sine};
  }

  /// The height of a direction over the equator, and its distance from the axis.
  struct Height {
    double sine;  ///< of the angle from a pole
    double z;
  };
  /// The height in row `y` below which lies the share `fraction` of the row's solid angle.
  Height height(int y, double fraction) const {
    const RowShare at = row_share(y, fraction);
    return {at.sine, negate_if(2 * y < height_, at.cosine)};
  }

  /// Solid angle of a texel of row `y`, in steradian.
  double texel_solid_angle(int y) const {
    return solid_angle_ * lines_[static_cast<std::size_t>(from_pole(y))].span;
  }

  std::span<const Line> lines() const { return lines_; }
  /// Steradian of a texel whose row has the span 1.
  double solid_angle() const { return solid_angle_; }
  std::size_t bytes() const { return lines_.size() * sizeof(Line); }

  /// How near an edge of its row a share of it comes, so that its place stays kCellMargin away: in
  /// the row of a pole it is twice as near.
  static constexpr double kMargin = 4.0 * kCellMargin;
  /// Whether rows are so low, pi/32 at most, that the series below gives the angles in them.
  static constexpr bool has_many_rows(int height) { return height >= 32; }
  /// Whether they are so low, pi/256 at most, that its first kFewTerms do.
  static constexpr bool needs_few_terms(int height) { return height >= 256; }
  static constexpr std::size_t kFewTerms = 4;
  /// asin(x) / x = 1 + x^2/6 + 3 x^4/40 + …: what is left out is below 2^-52 at x = sin(pi/32), and
  /// beyond kFewTerms at sin(pi/256).
  static constexpr std::array<double, 7> kArcSine = {1.0,
                                                     1.0 / 6.0,
                                                     3.0 / 40.0,
                                                     15.0 / 336.0,
                                                     105.0 / 3456.0,
                                                     945.0 / 42240.0,
                                                     10395.0 / 599040.0};

 private:
  int from_pole(int y) const { return 2 * y >= height_ ? height_ - 1 - y : y; }

  /// A share of a row. Angles are those from the pole.
  struct RowShare {
    const Line* line;
    double squared_sine;  ///< of half the angle
    double sine;
    double cosine;
  };
  RowShare row_share(int y, double fraction) const {
    const bool upper = 2 * y >= height_;
    const Line& line = lines_[static_cast<std::size_t>(from_pole(y))];
    const double from_edge = select(upper, 1.0 - fraction, fraction);
    const double f = std::min(std::max(from_edge, kMargin), 1.0 - kMargin);
    const double squared = line.squared_sine + f * line.span;
    const double rest = 1.0 - squared;
    return {&line, squared, 2.0 * std::sqrt(squared * rest), rest - squared};
  }

  /// The t at this share of the height of row y, counted from its edge at the pole.
  double t_of(int y, double within) const {
    return position_in_cell(y, 2 * y >= height_ ? 1.0 - within : within, row_height_);
  }
  /// The share of a row's height at an angle of this sine and cosine.
  double since_edge(const Line& line, double sine, double cosine) const {
    const double x = sine * line.cosine - cosine * line.sine;
    const double square = x * x;
    const std::size_t terms = needs_few_terms(height_) ? kFewTerms : kArcSine.size();
    double sum = kArcSine[terms - 1];
    for (std::size_t k = terms - 1; k-- > 0;) sum = sum * square + kArcSine[k];
    return x * sum * rows_per_radian_;
  }

  int height_;
  double row_height_;
  double rows_per_radian_;
  double solid_angle_;
  std::vector<Line> lines_;
};

/// What TexelPositions keeps, for code that works on many samples at once.
struct TexelPositionsView {
  Extent extent;
  MapMeasure measure;                 ///< in which positions are uniform
  double texel_width;                 ///< width of a texel in s
  double texel_height;                ///< height of a texel in t
  double texels;                      ///< how many there are
  double solid_angle;                 ///< SolidAngleRows::solid_angle()
  double rows_per_radian;             ///< rows that an angle of 1 radian spans
  const SolidAngleRows::Line* lines;  ///< SolidAngleRows::lines()
};

/// Column and row of a texel.
struct TexelIndex {
  int x;
  int y;
};

/// The positions of samples inside their texels: uniform in (s, t) under the densities A and C, in
/// solid angle under B.
class TexelPositions {
 public:
  /// Positions that are uniform in this measure: in solid angle only where rows are those of a
  /// latitude-longitude mapping.
  TexelPositions(Extent extent, MapMeasure measure, const Mapping& mapping = {});
  /// The positions of a density on maps of this mapping. Throws InputError if there are none, see
  /// why_not_declared().
  TexelPositions(Extent extent, DensitySpace density_space, const Mapping& mapping = {});

  Extent extent() const { return extent_; }
  /// The measure in which positions are uniform.
  MapMeasure measure() const { return measure_; }
  const Mapping& mapping() const { return mapping_; }

  /// Column and row of a texel, of texels counted row by row: exact below 2^48, and quicker than
  /// the processor's division.
  TexelIndex texel(std::uint64_t index) const {
    const auto y = static_cast<std::int64_t>((to_double(index) + 0.5) * texel_width_);
    return {static_cast<int>(static_cast<std::int64_t>(index) - y * extent_.width),
            static_cast<int>(y)};
  }

  /// The drawn texel's sample as a point of the square.
  TexelSample sample(const TexelDraw& draw) const {
    const double s = position_in_cell(draw.x, draw.column_fraction, texel_width_);
    if (measure_ == MapMeasure::square) {
      const double t = position_in_cell(draw.y, draw.row_fraction, texel_height_);
      return {{s, t}, draw.x, draw.y, {draw.mass * texels_}};
    }
    const auto [t, sine] = solid_angle_rows_.position(draw.y, draw.row_fraction);
    const double per_steradian = draw.mass / solid_angle_rows_.texel_solid_angle(draw.y);
    return {{s, t}, draw.x, draw.y, {per_steradian * (2.0 * kPi * kPi * sine)}};
  }

  /// The drawn texel's sample as a direction: that of sample(), to some roundings.
  LightSample direction(const TexelDraw& draw) const {
    if (!is_plain_) return mapped(sample(draw));
    const SinCosOfTurns azimuth = columns_.at(draw.x, draw.column_fraction);
    double sine;
    double z;
    double pdf;
    if (measure_ == MapMeasure::square) {
      // Rows are counted from the nearer pole, where the sine loses no precision.
      const bool upper = 2 * draw.y >= extent_.height;
      const SinCosOfTurns from_pole =
          rows_.at(upper ? extent_.height - 1 - draw.y : draw.y,
                   select(upper, 1.0 - draw.row_fraction, draw.row_fraction));
      sine = from_pole.sin;
      z = negate_if(!upper, from_pole.cos);
      pdf = draw.mass * texels_per_turn_ / sine;
    } else {
      const SolidAngleRows::Height height = solid_angle_rows_.height(draw.y, draw.row_fraction);
      sine = height.sine;
      z = height.z;
      pdf = draw.mass / solid_angle_rows_.texel_solid_angle(draw.y);
    }
    return {{-sine * azimuth.cos, sine * azimuth.sin, z}, {pdf}, draw.x, draw.y};
  }

  /// A point of the square as a direction.
  LightSample mapped(const TexelSample& sample) const {
    return {direction_at(mapping_, sample.at), to_solid_angle(mapping_, sample.pdf, sample.at),
            sample.x, sample.y};
  }

  /// Density over the square at `at`, inside a texel of row y that is drawn with this probability.
  PerSquare pdf(int y, double mass, SquarePoint at) const {
    if (measure_ == MapMeasure::square) return {mass * texels_};
    return to_square(PerSteradian{mass / solid_angle_rows_.texel_solid_angle(y)}, at);
  }

  TexelPositionsView view() const {
    return {extent_,
            measure_,
            texel_width_,
            texel_height_,
            texels_,
            solid_angle_rows_.solid_angle(),
            extent_.height / kPi,
            solid_angle_rows_.lines().data()};
  }

  std::size_t bytes() const { return solid_angle_rows_.bytes() + columns_.bytes() + rows_.bytes(); }

 private:
  Extent extent_;
  MapMeasure measure_;
  bool is_plain_;
  Mapping mapping_;
  double texel_width_;
  double texel_height_;
  double texels_;
  double texels_per_turn_;           ///< texels over 2 pi^2
  SolidAngleRows solid_angle_rows_;  ///< empty if positions are uniform in (s, t)
  CellAngles columns_;               ///< empty on maps of other mappings
  CellAngles rows_;  ///< from a pole; empty if positions are uniform in solid angle, or as columns_
};

}  // namespace lightproof
