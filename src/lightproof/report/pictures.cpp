#include "lightproof/report/pictures.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "lightproof/image/environment_map.h"
#include "lightproof/image/srgb.h"

namespace lightproof {
namespace {

constexpr double kMiddleGrey = 0.18;
constexpr double kLitMean = 0.35;
constexpr double kShareInRange = 0.99;

// The ends of ColorBrewer's RdBu: told apart under the common kinds of colour blindness.
constexpr Rgb kNegative = {0.129F, 0.400F, 0.675F};
constexpr Rgb kNeutral = {1.0F, 1.0F, 1.0F};
constexpr Rgb kPositive = {0.698F, 0.094F, 0.169F};
constexpr Rgb kUndefined = {0.5F, 0.5F, 0.5F};

bool counts(double luminance) { return luminance > 0.0 && std::isfinite(luminance); }

Rgb block_mean(const Grid<Rgb>& picture, Extent corner, int block) {
  const Extent size = picture.extent();
  glm::dvec3 sum(0.0);
  int pixels = 0;
  for (int y = corner.height; y < std::min(corner.height + block, size.height); ++y) {
    for (int x = corner.width; x < std::min(corner.width + block, size.width); ++x, ++pixels) {
      sum += glm::dvec3(picture(x, y));
    }
  }
  return Rgb(sum / static_cast<double>(pixels));
}

double rounded_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * power * (1.0 + 1e-9)) return step * power;
  }
  return 10.0 * power;
}

}  // namespace

double grey_exposure(const Grid<Rgb>& picture) {
  double sum = 0.0;
  double pixels = 0.0;
  for (const Rgb& rgb : picture.values()) {
    const double luminance = luminance_of(rgb);
    if (!counts(luminance)) continue;
    sum += std::log(luminance);
    pixels += 1.0;
  }
  return pixels > 0.0 ? kMiddleGrey / std::exp(sum / pixels) : 1.0;
}

double mean_exposure(const Grid<Rgb>& picture) {
  double sum = 0.0;
  double pixels = 0.0;
  for (const Rgb& rgb : picture.values()) {
    const double luminance = luminance_of(rgb);
    if (!counts(luminance)) continue;
    sum += luminance;
    pixels += 1.0;
  }
  return pixels > 0.0 ? kLitMean * pixels / sum : 1.0;
}

Grid<Rgb> tone_mapped(const Grid<Rgb>& picture, double scale) {
  Grid<Rgb> mapped(picture.extent());
  std::transform(picture.values().begin(), picture.values().end(), mapped.values().begin(),
                 [scale](const Rgb& rgb) {
                   const glm::dvec3 linear = glm::dvec3(rgb) * scale;
                   return Rgb(glm::dvec3(srgb_encoded(linear.r), srgb_encoded(linear.g),
                                         srgb_encoded(linear.b)));
                 });
  return mapped;
}

Grid<Rgb> grey_picture(const Grid<double>& values) {
  Grid<Rgb> picture(values.extent());
  std::transform(values.values().begin(), values.values().end(), picture.values().begin(),
                 [](double value) { return Rgb(static_cast<float>(value)); });
  return picture;
}

Grid<Rgb> shrunk(const Grid<Rgb>& picture, int max_width) {
  const Extent from = picture.extent();
  const int block = (from.width + max_width - 1) / max_width;
  if (block <= 1) return picture;
  Grid<Rgb> small(Extent{(from.width + block - 1) / block, (from.height + block - 1) / block});
  for (int y = 0; y < small.extent().height; ++y) {
    for (int x = 0; x < small.extent().width; ++x) {
      small(x, y) = block_mean(picture, {x * block, y * block}, block);
    }
  }
  return small;
}

Grid<Rgb> unfolded_cube(std::span<const Grid<Rgb>> faces, Rgb background) {
  assert(faces.size() == 6);
  constexpr std::array<Extent, 6> kPlaces = {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
  const int size = faces[0].extent().width;
  Grid<Rgb> cross(Extent{4 * size, 3 * size}, background);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int left = kPlaces[i].width * size;
    const int top = kPlaces[i].height * size;
    for (int y = 0; y < size; ++y) {
      std::ranges::copy(faces[i].row(y), &cross(left, top + y));
    }
  }
  return cross;
}

Rgb diverging_colour(double value, double range) {
  if (!std::isfinite(value)) return kUndefined;
  const double share = std::clamp(value / range, -1.0, 1.0);
  const Rgb end = share < 0.0 ? kNegative : kPositive;
  return kNeutral + (end - kNeutral) * static_cast<float>(std::abs(share));
}

Grid<Rgb> diverging_picture(const Grid<double>& values, double range) {
  Grid<Rgb> picture(values.extent());
  std::transform(values.values().begin(), values.values().end(), picture.values().begin(),
                 [range](double value) { return diverging_colour(value, range); });
  return picture;
}

double common_range(std::span<const Grid<double>* const> pictures) {
  std::vector<double> sizes;
  for (const Grid<double>* picture : pictures) {
    for (const double value : picture->values()) {
      if (std::isfinite(value)) sizes.push_back(std::abs(value));
    }
  }
  if (sizes.empty()) return 1.0;
  const auto median =
      static_cast<std::ptrdiff_t>(kShareInRange * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), sizes.begin() + median, sizes.end());
  const double size = *(sizes.begin() + median);
  return size > 0.0 ? rounded_up(size) : 1.0;
}

}  // namespace lightproof
