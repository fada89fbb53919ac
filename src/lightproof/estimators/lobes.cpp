#include "lightproof/estimators/lobes.h"

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

/// The numbers of a batch's points.
struct Numbers {
  Numbers(const BatchPoints& points, std::size_t all) : count(all) {
    points.fill(0, std::span(s).first(count), std::span(t).first(count));
  }

  std::size_t count;
  std::array<double, LightSamples::kCapacity> s;
  std::array<double, LightSamples::kCapacity> t;
};

/// Draws from a material's lobes, with their densities and k.
void draw_lobes(const Material& material, const ShadingPoint& at, const BatchPoints& points,
                LightSamples& samples) {
  const Numbers u(points, samples.count);
  sample_material(material, at, std::span(u.s).first(u.count), std::span(u.t).first(u.count),
                  {std::span(samples.x).first(u.count), std::span(samples.y).first(u.count),
                   std::span(samples.z).first(u.count), std::span(samples.pdf).first(u.count),
                   std::span(samples.reflected_cosine).first(u.count)});
}

void draw_hemisphere(const ShadingPoint& at, const BatchPoints& points, LightSamples& samples) {
  const Numbers u(points, samples.count);
  for (std::size_t i = 0; i < u.count; ++i) {
    const Direction local = uniform_hemisphere_from_square({u.s[i], u.t[i]});
    samples.set(i, at.frame.to_world(local));
    samples.pdf[i] = uniform_hemisphere_pdf(local).value;
  }
}

SamplesAt lobes_of(const EnvironmentMap& map, const Material& material) {
  return [&map, material](const ShadingPoint& at) -> DrawSamples {
    return [&map, &material, &at](const BatchPoints& points, LightSamples& samples) {
      draw_lobes(material, at, points, samples);
      samples.locate(map.radiance.extent());
    };
  };
}

}  // namespace

PreparedSource hemisphere_source(const EnvironmentMap& map) {
  return {&map, [&map](const Material& material) -> SamplesAt {
            return [&map, material](const ShadingPoint& at) -> DrawSamples {
              return [&map, &material, &at](const BatchPoints& points, LightSamples& samples) {
                draw_hemisphere(at, points, samples);
                samples.locate(map.radiance.extent());
                samples.reflect(material, at);
              };
            };
          }};
}

PreparedSource cosine_source(const EnvironmentMap& map) {
  return {&map, [&map](const Material& material) -> SamplesAt {
            return [&map, material](const ShadingPoint& at) -> DrawSamples {
              return [&map, &material, &at](const BatchPoints& points, LightSamples& samples) {
                draw_lobes(Lambert{1.0}, at, points, samples);
                samples.locate(map.radiance.extent());
                samples.reflect(material, at);
              };
            };
          }};
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

double hemisphere_pdf(const Material& /*material*/, const ShadingPoint& /*at*/,
                      Direction /*direction*/) {
  return 0.5 / kPi;
}

double cosine_pdf(const Material& /*material*/, const ShadingPoint& at, Direction direction) {
  return std::max(0.0, glm::dot(at.frame.normal, direction)) / kPi;
}

double ggx_pdf(MicrofacetSampling sampling, const Material& material, const ShadingPoint& at,
               Direction direction) {
  Ggx ggx = std::get<Ggx>(material);
  ggx.sampling = sampling;
  return ggx.evaluate(at, direction).pdf.value;
}

bool is_ggx(const Material& material) { return std::holds_alternative<Ggx>(material); }

}  // namespace lightproof
