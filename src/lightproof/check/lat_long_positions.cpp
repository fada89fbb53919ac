#include "lightproof/check/lat_long_positions.h"

#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/warp/sphere_batch.h"

namespace lightproof {

LatLongPositions::LatLongPositions(std::size_t most) {
  for (std::vector<double>* numbers :
       {&x_, &y_, &z_, &s_, &t_, &near_x_, &near_y_, &near_z_, &near_sine_, &from_axis_}) {
    numbers->resize(most);
  }
}

void LatLongPositions::find(std::span<const DumpedSample> samples) {
  const std::size_t count = samples.size();
  const auto part = [count](std::vector<double>& numbers) {
    return std::span(numbers).first(count);
  };
  for (std::size_t i = 0; i < count; ++i) {
    x_[i] = samples[i].direction.x;
    y_[i] = samples[i].direction.y;
    z_[i] = samples[i].direction.z;
  }
  approximate_positions(part(x_), part(y_), part(z_), {part(s_), part(t_)});
  directions_of_positions(part(s_), part(t_),
                          {part(near_x_), part(near_y_), part(near_z_), part(near_sine_)});
  for (std::size_t i = 0; i < count; ++i) {
    const double from_axis = std::sqrt(x_[i] * x_[i] + y_[i] * y_[i]);
    const double along_parallel =
        (y_[i] * near_x_[i] - x_[i] * near_y_[i]) / (from_axis * near_sine_[i]);
    const double along_meridian = from_axis * near_z_[i] - z_[i] * near_sine_[i];
    const double s = s_[i] - along_parallel / (2.0 * kPi);
    s_[i] = s - std::floor(s);
    t_[i] -= along_meridian / kPi;
    from_axis_[i] = from_axis;
  }
}

}  // namespace lightproof
