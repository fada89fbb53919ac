#include "lightproof/dump/sample_dump.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBlock = 1024;
/// By how much a unit vector's length may differ from 1: more than rounding does, half floats' too.
constexpr double kLengthTolerance = 1e-3;

/// The unit vector; not a number if it is none.
Direction normalised(Direction d) {
  const double length = std::sqrt(glm::dot(d, d));
  if (!(std::abs(length - 1.0) <= kLengthTolerance)) return {kNaN, kNaN, kNaN};
  return d / length;
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

SampleDump::SampleDump(NumberTable table, SampleColumns columns, SampleConvention convention)
    : table_(std::move(table)), columns_(columns), convention_(convention) {
  if (columns_.count != table_.columns()) {
    throw InputError(fmt::format("the rows have {} numbers, {} columns are named", table_.columns(),
                                 columns_.count));
  }
}

double SampleDump::rounding() const {
  // Three components of a unit vector, or two coordinates over a turn and half a turn.
  return columns_.are_directions() ? std::sqrt(3.0) * table_.rounding()
                                   : 2.0 * kPi * table_.rounding();
}

DumpedSample SampleDump::sample_of(std::span<const double> row) const {
  DumpedSample sample{{kNaN, kNaN, kNaN}, {kNaN}};
  Direction of_image = sample.direction;  // in the axes of the preset's image coordinates
  if (columns_.are_directions()) {
    sample.direction =
        convention_.axes(normalised({row[*columns_.x], row[*columns_.y], row[*columns_.z]}));
    of_image = sample.direction;
  } else {
    const double s = row[*columns_.s];
    const double t = columns_.t_is_from_top ? 1.0 - row[*columns_.t] : row[*columns_.t];
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) {
      of_image = direction_from_image(convention_.preset, {s, t});
      sample.direction = convention_.axes(of_image);
    }
  }
  if (!columns_.pdf) return sample;
  const double pdf = row[*columns_.pdf];
  sample.pdf.value = convention_.measure == DensityMeasure::solid_angle
                         ? pdf
                         : pdf / solid_angle_per_image(convention_.preset, of_image);
  return sample;
}

void SampleDump::read(std::uint64_t first, std::span<DumpedSample> samples) const {
  const std::size_t columns = table_.columns();
  std::vector<double> numbers(std::min(samples.size(), kBlock) * columns);
  for (std::size_t done = 0; done < samples.size(); done += kBlock) {
    const std::size_t count = std::min(kBlock, samples.size() - done);
    const std::span<double> block = std::span(numbers).first(count * columns);
    table_.read(first + done, block);
    for (std::size_t i = 0; i < count; ++i) {
      samples[done + i] = sample_of(block.subspan(i * columns, columns));
    }
  }
}

}  // namespace lightproof
