#include "lightproof/estimators/lobes.h"

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

/// Draws local directions around the normal, one by one.
template <class Warp, class Pdf>
PreparedSource warp_source(const EnvironmentMap& map, Warp warp, Pdf pdf) {
  const auto bind = [&map, warp, pdf](const Material& material) -> SamplesAt {
    return [&map, warp, pdf, material](const ShadingPoint& at) -> DrawSamples {
      return [&map, warp, pdf, &material, &at](const BatchPoints& points, LightSamples& samples) {
        std::array<double, LightSamples::kCapacity> s;
        std::array<double, LightSamples::kCapacity> t;
        points.fill(0, std::span(s).first(samples.count), std::span(t).first(samples.count));
        for (std::size_t i = 0; i < samples.count; ++i) {
          const Direction local = warp(SquarePoint{s[i], t[i]});
          samples.set(i, at.frame.to_world(local));
          samples.pdf[i] = pdf(local).value;
        }
        samples.locate(map.radiance.extent());
        samples.reflect(material, at);
      };
    };
  };
  return {&map, bind};
}

SamplesAt lobes_of(const EnvironmentMap& map, const Material& material) {
  return [&map, material](const ShadingPoint& at) -> DrawSamples {
    return [&map, &material, &at](const BatchPoints& points, LightSamples& samples) {
      const std::size_t count = samples.count;
      std::array<double, LightSamples::kCapacity> s;
      std::array<double, LightSamples::kCapacity> t;
      points.fill(0, std::span(s).first(count), std::span(t).first(count));
      sample_material(material, at, std::span(s).first(count), std::span(t).first(count),
                      {std::span(samples.x).first(count), std::span(samples.y).first(count),
                       std::span(samples.z).first(count), std::span(samples.pdf).first(count),
                       std::span(samples.reflected_cosine).first(count)});
      samples.locate(map.radiance.extent());
    };
  };
}

}  // namespace

PreparedSource hemisphere_source(const EnvironmentMap& map) {
  return warp_source(map, uniform_hemisphere_from_square, uniform_hemisphere_pdf);
}

PreparedSource cosine_source(const EnvironmentMap& map) {
  return warp_source(map, cosine_hemisphere_from_square, cosine_hemisphere_pdf);
}

PreparedSource material_source(const EnvironmentMap& map) {
  return {&map, [&map](const Material& material) { return lobes_of(map, material); }};
}

PreparedSource ggx_source(const EnvironmentMap& map, MicrofacetSampling sampling) {
  return {&map, [&map, sampling](const Material& material) {
            const Ggx* ggx = std::get_if<Ggx>(&material);
            if (ggx == nullptr) {
              throw InputError("normals of GGX cannot be drawn for a material without them");
            }
            Ggx other = *ggx;
            other.sampling = sampling;
            return lobes_of(map, other);
          }};
}

bool is_ggx(const Material& material) { return std::holds_alternative<Ggx>(material); }

}  // namespace lightproof
