#include "lightproof/estimators/texel_directions.h"

#include <algorithm>
#include <array>

#include "lightproof/core/measure.h"

namespace lightproof {

TexelDirections::TexelDirections(CellSize size, double fraction, Extent count) {
  for (int x = 0; x < count.width; ++x) {
    const double phi = kPi - 2.0 * kPi * (x + fraction) * size.s;
    cosine_.push_back(std::cos(phi));
    sine_.push_back(std::sin(phi));
  }
  for (int y = 0; y < count.height; ++y) {
    const double t = std::min(1.0, (y + fraction) * size.t);
    height_.push_back(cos_theta(t));
    radius_.push_back(sin_theta(t));
  }
}

void TexelDirections::reflected(const Material& material, const ShadingPoint& at, int row,
                                std::span<double> k) const {
  constexpr std::size_t kBlock = 256;
  const double z = height_[static_cast<std::size_t>(row)];
  const double radius = radius_[static_cast<std::size_t>(row)];
  std::array<double, kBlock> x;
  std::array<double, kBlock> y;
  std::array<double, kBlock> heights;
  heights.fill(z);
  for (std::size_t first = 0; first < k.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, k.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = radius * cosine_[first + i];
      y[i] = radius * sine_[first + i];
    }
    reflected_cosines(
        material, at,
        {std::span(x).first(count), std::span(y).first(count), std::span(heights).first(count)},
        k.subspan(first, count));
  }
}

}  // namespace lightproof
