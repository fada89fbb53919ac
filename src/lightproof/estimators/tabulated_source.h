// Sources of directions that make a table for every shading point and draw from it.
#pragma once

#include <memory>

#include "lightproof/estimators/light_samples.h"

namespace lightproof {

/// The samples at one point: those of the table that `kept` makes for it.
template <class Kept>
DrawSamples samples_of_table(const Kept& kept, const Material& material, const ShadingPoint& at) {
  const auto table =
      std::make_shared<const decltype(kept.table(material, at))>(kept.table(material, at));
  return [table, &kept, &material, &at](const BatchPoints& points, LightSamples& samples) {
    draw_each(points, samples, [&](SquarePoint u) { return kept.sample(*table, u); });
    samples.reflect(material, at);
  };
}

/// A source of what a Kept(map) keeps of the map: table(material, at) is set up for every point,
/// and sample(table, u) draws from it.
template <class Kept>
PreparedSource tabulated_source(const EnvironmentMap& map) {
  const auto kept = std::make_shared<const Kept>(map);
  const auto bind = [kept](const Material& material) -> SamplesAt {
    return
        [kept, material](const ShadingPoint& at) { return samples_of_table(*kept, material, at); };
  };
  return {&map, bind, kept->bytes()};
}

}  // namespace lightproof
