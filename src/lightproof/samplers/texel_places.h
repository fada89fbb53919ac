// Where in a texel a sample lies, and with what density: the same for every sampler that draws
// whole texels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "lightproof/samplers/sampler.h"

namespace lightproof {

/// Fractions inside a cell keep this distance from its edges, so that no rounding moves a point to
/// the neighbour (up to 2^16 cells) or onto a pole.
inline constexpr double kCellMargin = 0x1p-34;

/// The coordinate in [0,1) at `fraction` of cell `index`, of which each is `size` wide.
inline double place_in_cell(int index, double fraction, double size) {
  return (index + std::clamp(fraction, kCellMargin, 1.0 - kCellMargin)) * size;
}

/// The same of `count` cells.
inline double place_in_cell(int index, double fraction, int count) {
  return place_in_cell(index, fraction, 1.0 / count);
}

/// Chooses t inside a row so that cos(theta) is uniform: equal solid angles are equally likely.
class SolidAngleRows {
 public:
  explicit SolidAngleRows(int height) : height_(height), row_height_(1.0 / height) {
    if (height == 0) return;
    for (int edge = 0; edge <= height; ++edge) {
      const double sine = std::sin(0.5 * kPi * edge / height);
      squared_sines_.push_back(sine * sine);
    }
  }

  /// The t in row `y` below which lies the share `fraction` of the row's solid angle.
  /// sin^2(pi t / 2) is linear in the fraction; the row is mirrored to the lower half first, where
  /// its inverse loses no precision.
  double place(int y, double fraction) const {
    const bool upper = 2 * y >= height_;
    const int row = upper ? height_ - 1 - y : y;
    const double f = std::clamp(upper ? 1.0 - fraction : fraction, kCellMargin, 1.0 - kCellMargin);
    const double low = squared_sines_[static_cast<std::size_t>(row)];
    const double high = squared_sines_[static_cast<std::size_t>(row) + 1];
    const double sine = std::sqrt(low + f * (high - low));
    const double within = 2.0 / kPi * std::asin(std::min(sine, 1.0)) * height_ - row;
    return place_in_cell(y, upper ? 1.0 - within : within, row_height_);
  }

  /// sin^2 of half the angle from the nadir at the lower edge of every row, and at the zenith.
  std::span<const double> squared_sines() const { return squared_sines_; }
  std::size_t bytes() const { return squared_sines_.size() * sizeof(double); }

 private:
  int height_;
  double row_height_;
  std::vector<double> squared_sines_;
};

/// What TexelPlaces keeps, for code that works on many samples at once.
struct TexelPlacesView {
  Extent extent;
  Weighting weighting;
  double texel_width;   ///< of the square
  double texel_height;  ///< likewise
  double texels;        ///< how many there are
  const double* squared_sines;
  const double* texels_per_steradian;
};

/// Uniform in (s, t) inside a texel under weighting A, in solid angle under B.
class TexelPlaces {
 public:
  TexelPlaces(Extent extent, Weighting weighting);

  Extent extent() const { return extent_; }
  Weighting weighting() const { return weighting_; }

  /// The sample in texel (x, y), which is drawn with probability `mass`, at these shares of its
  /// width and of its height (under B: of its solid angle), both in [0,1].
  TexelSample sample(int x, int y, double across, double along, double mass) const {
    const double t = weighting_ == Weighting::A ? place_in_cell(y, along, texel_height_)
                                                : solid_angle_rows_.place(y, along);
    const SquarePoint at = {place_in_cell(x, across, texel_width_), t};
    return {at, x, y, pdf(y, mass, at)};
  }

  /// Density over the square at `at`, inside a texel of row y that is drawn with this probability.
  PerSquare pdf(int y, double mass, SquarePoint at) const {
    if (weighting_ == Weighting::A) return {mass * texels_};
    return to_square(PerSteradian{mass * texels_per_steradian_[static_cast<std::size_t>(y)]}, at);
  }

  TexelPlacesView view() const {
    return {extent_,
            weighting_,
            texel_width_,
            texel_height_,
            texels_,
            solid_angle_rows_.squared_sines().data(),
            texels_per_steradian_.data()};
  }

  std::size_t bytes() const {
    return solid_angle_rows_.bytes() + texels_per_steradian_.size() * sizeof(double);
  }

 private:
  Extent extent_;
  Weighting weighting_;
  double texel_width_;
  double texel_height_;
  double texels_;
  SolidAngleRows solid_angle_rows_;           ///< under B only
  std::vector<double> texels_per_steradian_;  ///< in each row, under B only
};

}  // namespace lightproof
