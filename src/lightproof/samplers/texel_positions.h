// Where in a texel a sample lies, and with what density: the same for every sampler that draws
// whole texels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "lightproof/core/select.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/sin_cos.h"

namespace lightproof {

/// Fractions inside a cell keep this distance from its edges, so that no rounding moves a point to
/// the neighbour (up to 2^16 cells) or onto a pole.
inline constexpr double kCellMargin = 0x1p-34;

/// The fraction, or the nearest one that keeps the margin.
inline double inside_cell(double fraction) {
  return std::min(std::max(fraction, kCellMargin), 1.0 - kCellMargin);
}

/// The coordinate in [0,1) at `fraction` of the way through cell `index`; each cell is `size` wide.
inline double position_in_cell(int index, double fraction, double size) {
  return (index + inside_cell(fraction)) * size;
}

/// The coordinate in [0,1) at `fraction` of the way through cell `index` of `count` equal ones.
inline double position_in_cell(int index, double fraction, int count) {
  return position_in_cell(index, fraction, 1.0 / count);
}

/// Chooses t inside a row so that cos(theta) is uniform: equal solid angles are equally likely.
/// sin^2 of half the angle from a pole is linear in the share of the row's solid angle; rows are
/// counted from the nearer pole, where its inverse loses no precision.
class SolidAngleRows {
 public:
  explicit SolidAngleRows(Extent extent);

  /// The t in row `y` below which lies the share `fraction` of the row's solid angle.
  double position(int y, double fraction) const {
    const bool upper = 2 * y >= height_;
    const int row = from_pole(y);
    const double f = inside_cell(upper ? 1.0 - fraction : fraction);
    const double low = squared_sines_[static_cast<std::size_t>(row)];
    const double sine = std::sqrt(low + f * spans_[static_cast<std::size_t>(row)]);
    const double within = 2.0 / kPi * std::asin(std::min(sine, 1.0)) * height_ - row;
    return position_in_cell(y, upper ? 1.0 - within : within, row_height_);
  }

  /// The height of a direction over the equator, and its distance from the axis.
  struct Height {
    double sine;  ///< of the angle from a pole
    double z;
  };
  /// The height in row `y` below which lies the share `fraction` of the row's solid angle.
  Height height(int y, double fraction) const {
    const bool upper = 2 * y >= height_;
    const auto row = static_cast<std::size_t>(from_pole(y));
    const double f = inside_cell(select(upper, 1.0 - fraction, fraction));
    const double squared_sine = squared_sines_[row] + f * spans_[row];
    const double rest = 1.0 - squared_sine;
    return {2.0 * std::sqrt(squared_sine * rest), negate_if(!upper, rest - squared_sine)};
  }

  /// Solid angle of a texel of row `y`, in steradian.
  double texel_solid_angle(int y) const {
    return solid_angle_ * spans_[static_cast<std::size_t>(from_pole(y))];
  }

  /// sin^2 of half the angle from the pole at which rows begin, for rows counted from that pole.
  std::span<const double> squared_sines() const { return squared_sines_; }
  /// By how much sin^2 of half the angle from the pole is more where rows end than where they
  /// begin.
  std::span<const double> spans() const { return spans_; }
  /// Steradian of a texel whose row has the span 1.
  double solid_angle() const { return solid_angle_; }
  std::size_t bytes() const { return 2 * spans_.size() * sizeof(double); }

 private:
  int from_pole(int y) const { return 2 * y >= height_ ? height_ - 1 - y : y; }

  int height_;
  double row_height_;
  double solid_angle_;
  std::vector<double> squared_sines_;
  std::vector<double> spans_;
};

/// What TexelPositions keeps, for code that works on many samples at once.
struct TexelPositionsView {
  Extent extent;
  DensitySpace density_space;
  double texel_width;   ///< width of a texel in s
  double texel_height;  ///< height of a texel in t
  double texels;        ///< how many there are
  double solid_angle;   ///< SolidAngleRows::solid_angle()
  const double* squared_sines;
  const double* spans;
};

/// Column and row of a texel.
struct TexelIndex {
  int x;
  int y;
};

/// The positions of samples inside their texels: uniform in (s, t) under density A, in solid angle
/// under B.
class TexelPositions {
 public:
  TexelPositions(Extent extent, DensitySpace density_space);

  Extent extent() const { return extent_; }
  DensitySpace density_space() const { return density_space_; }

  /// Column and row of a texel, of texels counted row by row: exact below 2^48, and quicker than
  /// the processor's division.
  TexelIndex texel(std::uint64_t index) const {
    const auto y = static_cast<std::int64_t>((to_double(index) + 0.5) * texel_width_);
    return {static_cast<int>(static_cast<std::int64_t>(index) - y * extent_.width),
            static_cast<int>(y)};
  }

  /// The drawn texel's sample as a point of the square.
  TexelSample sample(const TexelDraw& draw) const {
    const double t = density_space_ == DensitySpace::texture
                         ? position_in_cell(draw.y, draw.along, texel_height_)
                         : solid_angle_rows_.position(draw.y, draw.along);
    const SquarePoint at = {position_in_cell(draw.x, draw.across, texel_width_), t};
    return {at, draw.x, draw.y, pdf(draw.y, draw.mass, at)};
  }

  /// The drawn texel's sample as a direction: that of sample(), to some roundings, without the arc
  /// sine that a position under B takes.
  LightSample direction(const TexelDraw& draw) const {
    const SinCosOfTurns azimuth =
        sin_cos_of_turns(position_in_cell(draw.x, draw.across, texel_width_));
    double sine;
    double z;
    double pdf;
    if (density_space_ == DensitySpace::texture) {
      const SinCosOfTurns from_nadir =
          sin_cos_of_turns(0.5 * position_in_cell(draw.y, draw.along, texel_height_));
      sine = from_nadir.sin;
      z = -from_nadir.cos;
      pdf = draw.mass * texels_ / (2.0 * kPi * kPi * sine);
    } else {
      const SolidAngleRows::Height height = solid_angle_rows_.height(draw.y, draw.along);
      sine = height.sine;
      z = height.z;
      pdf = draw.mass / solid_angle_rows_.texel_solid_angle(draw.y);
    }
    return {{-sine * azimuth.cos, sine * azimuth.sin, z}, {pdf}, draw.x, draw.y};
  }

  /// Density over the square at `at`, inside a texel of row y that is drawn with this probability.
  PerSquare pdf(int y, double mass, SquarePoint at) const {
    if (density_space_ == DensitySpace::texture) return {mass * texels_};
    return to_square(PerSteradian{mass / solid_angle_rows_.texel_solid_angle(y)}, at);
  }

  TexelPositionsView view() const {
    return {extent_,
            density_space_,
            texel_width_,
            texel_height_,
            texels_,
            solid_angle_rows_.solid_angle(),
            solid_angle_rows_.squared_sines().data(),
            solid_angle_rows_.spans().data()};
  }

  std::size_t bytes() const { return solid_angle_rows_.bytes(); }

 private:
  Extent extent_;
  DensitySpace density_space_;
  double texel_width_;
  double texel_height_;
  double texels_;
  SolidAngleRows solid_angle_rows_;  ///< under B only
};

}  // namespace lightproof
