#include "lightproof/samplers/texel_positions.h"

#include <fmt/format.h>

#include <algorithm>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

MapMeasure declared_measure(DensitySpace density_space, const Mapping& mapping) {
  const std::string_view reason = why_not_declared({density_space}, mapping);
  if (!reason.empty()) {
    throw InputError(fmt::format("density {} on a map of mapping {}: {}", to_string(density_space),
                                 describe(mapping), reason));
  }
  return position_measure(density_space, mapping);
}

}  // namespace

SolidAngleRows::SolidAngleRows(Extent extent)
    : height_(extent.height),
      row_height_(1.0 / std::max(1, extent.height)),  // of no rows, whatever it is
      rows_per_radian_(extent.height / kPi),
      solid_angle_(4.0 * kPi / extent.width) {
  // sin^2 b - sin^2 a = sin(b + a) sin(b - a): written so, nothing cancels.
  const double half_row = 0.5 * kPi * row_height_;
  for (int row = 0; 2 * row < extent.height; ++row) {
    const double sine = std::sin(half_row * row);
    const double span = std::sin(half_row * (2 * row + 1)) * std::sin(half_row);
    const double begin = 2.0 * half_row * row;
    lines_.push_back({sine * sine, span, std::sin(begin), std::cos(begin)});
  }
}

TexelPositions::TexelPositions(Extent extent, DensitySpace density_space, const Mapping& mapping)
    : TexelPositions(extent, declared_measure(density_space, mapping), mapping) {}

TexelPositions::TexelPositions(Extent extent, MapMeasure measure, const Mapping& mapping)
    : extent_(extent),
      measure_(measure),
      is_plain_(lightproof::is_plain(mapping)),
      mapping_(mapping),
      texel_width_(1.0 / extent.width),
      texel_height_(1.0 / extent.height),
      texels_(static_cast<double>(extent.count())),
      texels_per_turn_(texels_ / (2.0 * kPi * kPi)),
      solid_angle_rows_(measure == MapMeasure::solid_angle ? extent : Extent{1, 0}),
      columns_(is_plain_ ? CellAngles(extent.width, 1.0, extent.width) : CellAngles()),
      rows_(is_plain_ && measure == MapMeasure::square
                ? CellAngles(extent.height, 0.5, (extent.height + 1) / 2)
                : CellAngles()) {}

}  // namespace lightproof
