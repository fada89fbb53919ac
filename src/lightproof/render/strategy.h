// From where the directions of the light samples are drawn.
#pragma once

#include <array>
#include <string_view>

namespace lightproof {

enum class Strategy { uniform, material, environment_a, environment_b };

/// Rather than from directions, whose texels have to be found.
constexpr bool draws_from_map(Strategy strategy) {
  return strategy == Strategy::environment_a || strategy == Strategy::environment_b;
}

struct StrategyInfo {
  Strategy strategy;
  std::string_view name;
  std::string_view description;
};

inline constexpr std::array<StrategyInfo, 4> kStrategies = {{
    {Strategy::uniform, "uniform", "uniform over the sphere, density 1/4pi"},
    {Strategy::material, "brdf", "the material's own lobes"},
    {Strategy::environment_a, "environment A",
     "the map, density over (s,t) proportional to luminance"},
    {Strategy::environment_b, "environment B", "the map, density over directions so"},
}};

}  // namespace lightproof
