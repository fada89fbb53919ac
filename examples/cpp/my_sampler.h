// A sampler of an environment map as a renderer may have it: one table of sums over all texels.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/environment_map.h"

/// Draws texels in proportion to luminance times solid angle, and positions uniformly inside them.
class MySampler {
 public:
  struct Sample {
    lightproof::Direction direction;  ///< a unit vector, z up
    lightproof::PerSteradian pdf;
  };

  explicit MySampler(const lightproof::EnvironmentMap& map)
      : width_(map.radiance.extent().width), height_(map.radiance.extent().height) {
    sums_.push_back(0.0);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const lightproof::Rgb rgb = map.radiance(x, y);
        const double luminance = 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
        sums_.push_back(sums_.back() + luminance * row_weight(y));
      }
    }
  }

  Sample sample(lightproof::SquarePoint u) const {
    // Two random numbers for three: what u.s says beyond the texel is uniform again.
    const double target = u.s * sums_.back();
    const auto above = std::upper_bound(sums_.begin(), sums_.end() - 1, target);
    const int texel = static_cast<int>(above - sums_.begin()) - 1;
    const double inside = (target - sums_[texel]) / mass(texel);
    const double s = (texel % width_ + std::min(inside, kBelowOne)) / width_;
    const double t = (texel / width_ + std::min(u.t, kBelowOne)) / height_;
    const double phi = kPi * (1.0 - 2.0 * s);
    const double theta = kPi * (1.0 - t);
    return {{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
            density(texel, std::sin(theta))};
  }

  lightproof::PerSteradian pdf(lightproof::Direction direction) const {
    const double s = 0.5 - std::atan2(direction.y, direction.x) / (2.0 * kPi);
    const double t = std::acos(std::clamp(-direction.z, -1.0, 1.0)) / kPi;
    const int x = std::clamp(static_cast<int>(s * width_), 0, width_ - 1);
    const int y = std::clamp(static_cast<int>(t * height_), 0, height_ - 1);
    return density(y * width_ + x, std::hypot(direction.x, direction.y));
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;
  /// Positions in a texel end before its edge, which rounding would give to the neighbour.
  static constexpr double kBelowOne = 1.0 - 1e-9;

  double row_weight(int y) const {
#ifdef FORGET_SINE
    static_cast<void>(y);
    return 1.0;
#else
    return std::sin(kPi * (y + 0.5) / height_);
#endif
  }

  double mass(int texel) const { return sums_[texel + 1] - sums_[texel]; }

  /// d(omega) = 2 pi^2 sin(theta) ds dt.
  lightproof::PerSteradian density(int texel, double sine) const {
    const double per_square = mass(texel) / sums_.back() * width_ * height_;
    return {per_square / (2.0 * kPi * kPi * sine)};
  }

  int width_;
  int height_;
  std::vector<double> sums_;  ///< of the texels before each, and of all
};
