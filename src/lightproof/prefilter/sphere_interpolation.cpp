#include "lightproof/prefilter/sphere_interpolation.h"

#include <array>
#include <cassert>
#include <cmath>

#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr int kPoints = 8;

/// Weights of the points -3, -2, … 4 for a position at a fraction in [0,1) after point 0.
std::array<double, kPoints> lagrange_weights(double fraction) {
  std::array<double, kPoints> weights{};
  for (int i = 0; i < kPoints; ++i) {
    double weight = 1.0;
    for (int j = 0; j < kPoints; ++j) {
      if (j != i) weight *= (fraction + 3.0 - j) / (i - j);
    }
    weights[static_cast<std::size_t>(i)] = weight;
  }
  return weights;
}

}  // namespace

glm::dvec3 interpolate_smooth(const Grid<Rgb>& samples, Direction direction) {
  const auto [width, height] = samples.extent();
  assert(width % 2 == 0);
  const SquarePoint at = square_from_direction(direction);
  const double column = std::floor(at.s * width - 0.5);
  const double row = std::floor(at.t * height - 0.5);
  const auto across = lagrange_weights(at.s * width - 0.5 - column);
  const auto along = lagrange_weights(at.t * height - 0.5 - row);
  glm::dvec3 sum(0.0);
  for (int j = 0; j < kPoints; ++j) {
    // The rows go round the meridian, which has twice as many: the second half of them lies
    // opposite.
    const int wrapped = (static_cast<int>(row) - 3 + j + 4 * height) % (2 * height);
    const bool beyond = wrapped >= height;
    const int y = beyond ? 2 * height - 1 - wrapped : wrapped;
    const int shift = static_cast<int>(column) - 3 + (beyond ? width / 2 : 0);
    glm::dvec3 line(0.0);
    for (int i = 0; i < kPoints; ++i) {
      const int x = ((shift + i) % width + width) % width;
      line += across[static_cast<std::size_t>(i)] * glm::dvec3(samples(x, y));
    }
    sum += along[static_cast<std::size_t>(j)] * line;
  }
  return sum;
}

}  // namespace lightproof
