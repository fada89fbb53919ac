#include "lightproof/samplers/bilinear.h"

#include <algorithm>
#include <cmath>

#include "lightproof/core/parallel.h"
#include "lightproof/samplers/texel_positions.h"
#include "lightproof/samplers/texel_weights.h"

namespace lightproof {
namespace {

double between(double low, double high, double share) { return low + (high - low) * share; }

/// The patch that a coordinate lies in: those of index 0 and `count` are halves.
int patch_of(double coordinate, int count) {
  // As cell_of(), for coordinates that are no positions on a map.
  const double patch = std::max(0.0, std::floor(coordinate * count + 0.5));
  return static_cast<int>(std::min(patch, static_cast<double>(count)));
}

double inside(double share) { return std::clamp(share, kCellMargin, 1.0 - kCellMargin); }

}  // namespace

BilinearPatches::BilinearPatches(const EnvironmentMap& map, TargetDensity target)
    : measure_(position_measure(target.density_space)), luminance_(map.radiance.extent()) {
  const Extent extent = texels();
  parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const double factor =
        weighs_texels(target.density_space) ? sin_theta((y + 0.5) / extent.height) : 1.0;
    std::ranges::transform(map.radiance.row(y), luminance_.row(y).begin(), [&](Rgb rgb) {
      return static_cast<float>(factor * luminance_of(rgb, target.weights));
    });
  });
  bool is_black = true;
  bool is_possible = true;
  for (const float luminance : luminance_.values()) {
    is_black = is_black && !(luminance > 0.0F);
    is_possible = is_possible && luminance >= 0.0F && std::isfinite(luminance);
  }
  if (!is_possible) refuse_impossible(map);
  if (is_black) refuse_black(map);
  for (int row = 0; row <= extent.height; ++row) rows_.push_back(weigh(row));
}

LinearTimesSine BilinearPatches::from_pole(int row) const {
  const int height = texels().height;
  const int index = is_upper(row) ? height - row : row;
  const Part covered = part(index, height);
  return {std::max(0.0, kPi * (index - 0.5 + covered.begin) / height),
          kPi * covered.length / height};
}

BilinearPatches::Row BilinearPatches::weigh(int row) const {
  const double height = part(row, texels().height).length / texels().height;
  if (measure_ == MapMeasure::square) return {0.5 * height, 0.5 * height};
  const LinearTimesSine sine = from_pole(row);
  const double steradian = solid_angle_per_square(0.5) * height;
  const double away = steradian * sine.integral(1.0, 0.0, 1.0);
  const double towards = steradian * sine.integral(0.0, 1.0, 1.0);
  return is_upper(row) ? Row{towards, away} : Row{away, towards};
}

BilinearPatches::Corners BilinearPatches::corners(int column, int row) const {
  const auto [width, height] = texels();
  const Part covered = part(column, width);
  const int left = (column + width - 1) % width;
  const int right = column % width;
  Corners found;
  for (int k = 0; k < 2; ++k) {
    const int y = std::clamp(row - 1 + k, 0, height - 1);
    const auto a = static_cast<double>(luminance_(left, y));
    const auto b = static_cast<double>(luminance_(right, y));
    found.luminance[k][0] = covered.begin > 0.0 ? 0.5 * (a + b) : a;
    found.luminance[k][1] = covered.begin + covered.length < 1.0 ? 0.5 * (a + b) : b;
  }
  return found;
}

Grid<double> BilinearPatches::weights() const {
  Grid<double> weights(extent());
  parallel_for(static_cast<std::size_t>(extent().height), [&](std::size_t index) {
    const int row = static_cast<int>(index);
    for (int column = 0; column < extent().width; ++column) {
      weights(column, row) = integral(corners(column, row), column, row);
    }
  });
  return weights;
}

double BilinearPatches::position_in_row(const Corners& corners, int row, double share) const {
  const double low = corners.low();
  const double high = corners.high();
  if (measure_ == MapMeasure::square) return invert_linear(low, high, share);
  const LinearTimesSine sine = from_pole(row);
  return is_upper(row) ? 1.0 - sine.invert(high, low, 1.0 - share) : sine.invert(low, high, share);
}

TexelSample BilinearPatches::sample(int column, int row, double column_fraction,
                                    double row_fraction, double mass) const {
  const auto [width, height] = texels();
  const Corners corner = corners(column, row);
  const double q = inside(position_in_row(corner, row, row_fraction));
  const double p = inside(invert_linear(between(corner.luminance[0][0], corner.luminance[1][0], q),
                                        between(corner.luminance[0][1], corner.luminance[1][1], q),
                                        column_fraction));
  const Part in_s = part(column, width);
  const Part in_t = part(row, height);
  const SquarePoint at = {(column - 0.5 + in_s.begin + in_s.length * p) / width,
                          (row - 0.5 + in_t.begin + in_t.length * q) / height};
  return {at, cell_of(at.s, width), cell_of(at.t, height), density(corner, column, row, mass, at)};
}

int BilinearPatches::column_of(double s) const { return patch_of(s, texels().width); }

int BilinearPatches::row_of(double t) const { return patch_of(t, texels().height); }

PerSquare BilinearPatches::density(const Corners& corners, int column, int row, double mass,
                                   SquarePoint at) const {
  const auto [width, height] = texels();
  const double p = share_of_part(at.s * width + 0.5 - column, part(column, width));
  const double q = share_of_part(at.t * height + 0.5 - row, part(row, height));
  const double luminance = between(between(corners.luminance[0][0], corners.luminance[0][1], p),
                                   between(corners.luminance[1][0], corners.luminance[1][1], p), q);
  const double density = mass / integral(corners, column, row) * luminance;
  return measure_ == MapMeasure::square ? PerSquare{density} : to_square(PerSteradian{density}, at);
}

}  // namespace lightproof
