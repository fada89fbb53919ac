// Points on both sides of where a sampler changes its texel.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "lightproof/cases/adversarial_points.h"
#include "lightproof/samplers/sampler.h"
#include "tests/samplers/parts.h"

namespace lightproof::test {

/// On both sides of where a sampler's texel changes, along many lines through the square: of each
/// of `count` columns and, at some heights, from one end of each to the other.
template <class Sampler>
std::vector<SquarePoint> points_beside_changes(const Sampler& sampler, std::size_t count) {
  const auto texel = [&](SquarePoint u) {
    const TexelSample sample = sampler.sample(u);
    return std::pair(sample.x, sample.y);
  };
  std::vector<SquarePoint> points;
  for (std::size_t column = 0; column < count; ++column) {
    const double s = (static_cast<double>(column) + 0.5) / static_cast<double>(count);
    for_parts(
        0.0, 1.0,
        [&](double t) {
          return texel({s, t});
        },
        [&](const Part& part) {
          for (const double t : {part.first, part.last}) points.push_back({s, t});
        });
    const double left = static_cast<double>(column) / static_cast<double>(count);
    const double right = static_cast<double>(column + 1) / static_cast<double>(count);
    for (const double t : {0.0, 0.3, 0.7, kLastBelowOne}) {
      for_parts(
          left, right,
          [&](double u) {
            return texel({u, t});
          },
          [&](const Part& part) {
            for (const double u : {part.first, part.last}) points.push_back({u, t});
          });
    }
  }
  return points;
}

}  // namespace lightproof::test
