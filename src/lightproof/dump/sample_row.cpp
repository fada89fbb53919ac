#include "lightproof/dump/sample_row.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// By how much a unit vector's length may differ from 1: more than rounding does, half floats' too.
constexpr double kLengthTolerance = 1e-3;

/// The unit vector; not a number if it is none.
Direction normalised(Direction d) {
  const double length = std::sqrt(glm::dot(d, d));
  return d * (std::abs(length - 1.0) <= kLengthTolerance ? 1.0 / length : kNaN);
}

/// Steradian per area of the image at a direction: of latitude and longitude by the angle from the
/// map's own axis, which is Lightproof's z.
double solid_angle_per_image(Preset preset, Direction d) {
  if (preset == Preset::pbrt_v4) return kSphere;
  if (preset == Preset::cube) {
    const Mapping faces = {MappingKind::cube_strip};
    return solid_angle_per_square(faces, square_point_of(faces, d));
  }
  return 2.0 * kPi * kPi * std::hypot(d.x, d.y);
}

}  // namespace

SampleRows::SampleRows(SampleColumns columns, SampleConvention convention)
    : columns_(columns), convention_(convention), to_theirs_(convention.axes.inverse()) {}

DumpedSample SampleRows::sample(std::span<const double> row) const {
  DumpedSample sample{{kNaN, kNaN, kNaN}, {kNaN}};
  if (columns_.are_directions()) {
    sample.direction =
        convention_.axes(normalised({row[*columns_.x], row[*columns_.y], row[*columns_.z]}));
  } else {
    const double s = row[*columns_.s];
    const double t = columns_.t_is_from_top ? 1.0 - row[*columns_.t] : row[*columns_.t];
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) {
      sample.direction = convention_.axes(direction_from_image(convention_.preset, {s, t}));
    }
  }
  if (columns_.pdf) sample.pdf = density(sample.direction, row[*columns_.pdf]);
  return sample;
}

void SampleRows::set_samples(std::span<const double> rows, std::span<DumpedSample> samples) const {
  if (columns_.are_directions()) return set_directions(rows, samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = sample(rows.subspan(i * columns_.count, columns_.count));
  }
}

void SampleRows::set_directions(std::span<const double> rows,
                                std::span<DumpedSample> samples) const {
  const std::size_t x = *columns_.x;
  const std::size_t y = *columns_.y;
  const std::size_t z = *columns_.z;
  const std::size_t pdf = columns_.pdf.value_or(x);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double* const row = rows.data() + i * columns_.count;
    samples[i] = {normalised({row[x], row[y], row[z]}), {row[pdf]}};
  }
  if (!(convention_.axes == AxisMap())) {
    for (DumpedSample& sample : samples) sample.direction = convention_.axes(sample.direction);
  }
  if (!columns_.pdf) {
    for (DumpedSample& sample : samples) sample.pdf.value = kNaN;
  } else if (convention_.measure == DensityMeasure::square) {
    for (DumpedSample& sample : samples) {
      sample.pdf = density(sample.direction, sample.pdf.value);
    }
  }
}

SampleWeight SampleRows::weight(std::span<const double> row) const {
  if (columns_.weight) return {row[*columns_.weight], row[*columns_.weight], row[*columns_.weight]};
  return {row[*columns_.red], row[*columns_.green], row[*columns_.blue]};
}

std::size_t SampleRows::numbers_of_position() const { return columns_.are_directions() ? 3 : 2; }

void SampleRows::put_position(Direction direction, std::span<double> position) const {
  const Direction theirs = to_theirs_(direction);
  if (columns_.are_directions()) {
    position[0] = theirs.x;
    position[1] = theirs.y;
    position[2] = theirs.z;
    return;
  }
  const SquarePoint at = image_from_direction(convention_.preset, theirs);
  position[0] = at.s;
  position[1] = columns_.t_is_from_top ? 1.0 - at.t : at.t;
}

PerSteradian SampleRows::density(Direction direction, double value) const {
  if (convention_.measure == DensityMeasure::solid_angle) return {value};
  // Image coordinates name directions in axes of their own.
  const Direction of_image = columns_.are_directions() ? direction : to_theirs_(direction);
  return {value / solid_angle_per_image(convention_.preset, of_image)};
}

}  // namespace lightproof
