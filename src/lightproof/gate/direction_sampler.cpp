#include "lightproof/gate/direction_sampler.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "lightproof/gate/material_distribution.h"
#include "lightproof/warp/hemisphere.h"
#include "lightproof/warp/hemisphere_around.h"

namespace lightproof {
namespace {

constexpr Direction kUp = {0.0, 0.0, 1.0};
/// A normal below the horizon, where frames take their other branch.
constexpr Direction kOblique = {0.48, -0.6, -0.64};

DirectionSamplerInfo uniform_hemisphere() {
  return {"uniform_hemisphere", "uniform over the hemisphere", CosineLobes{{kUp, 0.0, 1.0}},
          [](SquarePoint u) {
            const Direction d = uniform_hemisphere_from_square(u);
            return DrawnDirection{d, uniform_hemisphere_pdf(d)};
          },
          uniform_hemisphere_pdf};
}

DirectionSamplerInfo cosine_hemisphere() {
  return {"cosine_hemisphere", "the cosine over pi", CosineLobes{{kUp, 1.0, 1.0}},
          [](SquarePoint u) {
            const Direction d = cosine_hemisphere_from_square(u);
            return DrawnDirection{d, cosine_hemisphere_pdf(d)};
          },
          cosine_hemisphere_pdf};
}

DirectionSamplerInfo phong_lobe(double exponent) {
  return {fmt::format("phong_lobe_{}", exponent),
          fmt::format("Phong's lobe around the normal, exponent {}", exponent),
          CosineLobes{{kUp, exponent, 1.0}},
          [exponent](SquarePoint u) {
            const Direction d = phong_lobe_from_square(u, exponent);
            return DrawnDirection{d, phong_lobe_pdf(d.z, exponent)};
          },
          [exponent](Direction d) { return phong_lobe_pdf(d.z, exponent); }};
}

/// A warp of the hemisphere around the oblique normal.
DirectionSamplerInfo oblique(std::string name, std::string description, double exponent,
                             Direction (*draw)(Direction normal, SquarePoint u)) {
  const auto pdf = [exponent](Direction d) {
    return phong_lobe_pdf(glm::dot(kOblique, d), exponent);
  };
  return {std::move(name), std::move(description),
          ChartedDensity{reference::cosine_lobe_chart(kOblique, exponent), {}},
          [draw, pdf](SquarePoint u) {
            const Direction d = draw(kOblique, u);
            return DrawnDirection{d, pdf(d)};
          },
          pdf};
}

std::vector<DirectionSamplerInfo> warps() {
  return {
      uniform_hemisphere(),
      cosine_hemisphere(),
      phong_lobe(1.0),
      phong_lobe(50.0),
      phong_lobe(1000.0),
      oblique("uniform_oblique", "uniform around an oblique normal", 0.0,
              uniform_hemisphere_around),
      oblique("cosine_tangent_frame",
              "the cosine over pi around an oblique normal, by its tangent frame", 1.0,
              cosine_hemisphere_by_tangent_frame),
      oblique("cosine_quaternion",
              "the cosine over pi around an oblique normal, by the quaternion that rotates to it",
              1.0, cosine_hemisphere_by_quaternion)};
}

/// A material at one roughness, if it has one.
struct NamedMaterial {
  std::string name;
  std::string description;
  Material material;
};

constexpr std::array kDegrees = {0.0, 45.0, 80.0, 89.9};

DirectionSamplerInfo seen_from(const NamedMaterial& named, double degrees) {
  const double angle = degrees * kPi / 180.0;
  // Along +x, and the mirrored view along -x; from the normal the mirrored view is +z itself.
  const Direction view = {std::sin(angle), 0.0, std::cos(angle)};
  const ShadingPoint at = {{}, frame_around(kUp), view};
  const Material& material = named.material;
  return {fmt::format("{}_{}", named.name, degrees),
          fmt::format("{}, seen at {} degrees to the normal", named.description, degrees),
          distribution_of(material, view),
          [material, at](SquarePoint u) {
            const DirectionSample sample =
                std::visit([&](const auto& m) { return m.sample(at, u); }, material);
            return DrawnDirection{sample.direction, sample.scattering.pdf};
          },
          [material, at](Direction d) {
            return std::visit([&](const auto& m) { return m.evaluate(at, d); }, material).pdf;
          }};
}

constexpr std::array kRoughnesses = {0.01, 0.1, 0.3, 0.6, 1.0};

template <MicrofacetSampling kSampling>
Material ggx_of(double roughness) {
  return Ggx{roughness, 1.0, SmithMasking::height_correlated, kSampling};
}

constexpr std::array<MicrofacetInfo, 5> kMicrofacets = {{
    {"ggx_normals", "GGX's normals", ggx_of<MicrofacetSampling::normals>},
    {"ggx_visible", "GGX's visible normals by the projected hemisphere",
     ggx_of<MicrofacetSampling::visible_normals>},
    {"ggx_caps", "GGX's visible normals by spherical caps",
     ggx_of<MicrofacetSampling::spherical_caps>},
    {"ggx_bounded", "GGX's visible normals by bounded spherical caps",
     ggx_of<MicrofacetSampling::bounded_caps>},
    {"blinn", "Blinn's half-vector lobe",
     [](double roughness) -> Material {
       return BlinnMicrofacet{roughness, 1.0};
     }},
}};

NamedMaterial at_roughness(const MicrofacetInfo& info, double roughness) {
  return {fmt::format("{}_{}", info.name, roughness),
          fmt::format("{}, roughness {}", info.description, roughness),
          info.of_roughness(roughness)};
}

/// Every angle at every roughness, or at one each: another one for each angle of a way to draw, and
/// for each way to draw of an angle.
void add_microfacets(std::vector<DirectionSamplerInfo>& samplers, bool all_roughnesses) {
  for (std::size_t i = 0; i < kMicrofacets.size(); ++i) {
    for (std::size_t j = 0; j < kDegrees.size(); ++j) {
      for (std::size_t k = 0; k < kRoughnesses.size(); ++k) {
        if (!all_roughnesses && k != (i + 2 * j) % kRoughnesses.size()) continue;
        samplers.push_back(seen_from(at_roughness(kMicrofacets[i], kRoughnesses[k]), kDegrees[j]));
      }
    }
  }
}

/// Adds the materials that have no roughness, seen from every angle.
void add_smooth_lobes(std::vector<DirectionSamplerInfo>& samplers) {
  for (const std::string_view name : {"lambert", "phong"}) {
    const MaterialInfo& info = material_by_name(name);
    for (const double degrees : kDegrees) {
      samplers.push_back(seen_from(
          {std::string(info.name), std::string(info.description), info.material}, degrees));
    }
  }
}

std::vector<DirectionSamplerInfo> samplers_of(bool all_roughnesses) {
  std::vector<DirectionSamplerInfo> samplers = warps();
  add_smooth_lobes(samplers);
  add_microfacets(samplers, all_roughnesses);
  return samplers;
}

}  // namespace

std::vector<DirectionSamplerInfo> warp_samplers() { return warps(); }

std::span<const MicrofacetInfo> microfacets() { return kMicrofacets; }

std::vector<DirectionSamplerInfo> direction_samplers() { return samplers_of(false); }

std::vector<DirectionSamplerInfo> all_direction_samplers() { return samplers_of(true); }

BoundSampler bound_directions(const DirectionSamplerInfo& sampler) {
  return std::visit(
      [&](const auto& distribution) -> BoundSampler {
        const Extent cells = cells_of(distribution);
        return {[distribution, cells, sample = sampler.sample](std::span<const SquarePoint> points,
                                                               std::span<TexelSample> samples) {
                  for (std::size_t i = 0; i < points.size(); ++i) {
                    samples[i] = sample_of(distribution, cells, sample(points[i]));
                  }
                },
                [distribution, pdf = sampler.pdf](SquarePoint at) {
                  const PlacedDirection placed = direction_at(distribution, at);
                  return PerSquare{pdf(placed.direction).value * placed.solid_angle_per_area};
                }};
      },
      sampler.distribution);
}

std::vector<TestCase> test_cases_of(std::span<const DirectionSamplerInfo> samplers) {
  std::vector<TestCase> test_cases;
  for (const DirectionSamplerInfo& sampler : samplers) {
    const SamplerInstance instance = {sampler.name, false,
                                      [sampler] { return bound_directions(sampler); }};
    const auto claimed = [distribution = sampler.distribution](const auto& function) {
      return std::visit(function, distribution);
    };
    test_cases.push_back(
        {std::string(kDirections),
         "",
         "",
         [claimed] { return claimed([](const auto& d) { return expectation_of(d); }); },
         [claimed] { return claimed([](const auto& d) { return alternatives_to(d); }); },
         {instance}});
  }
  return test_cases;
}

std::vector<TestCase> test_cases_of(std::span<const EnvironmentMap> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test,
                                    std::span<const DirectionSamplerInfo> samplers) {
  return test_cases_of(sources_of(maps), samplers_under_test, samplers);
}

std::vector<TestCase> test_cases_of(std::span<const MapSource> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test,
                                    std::span<const DirectionSamplerInfo> samplers) {
  std::vector<TestCase> test_cases = test_cases_of(maps, samplers_under_test);
  for (TestCase& test_case : test_cases_of(samplers)) test_cases.push_back(std::move(test_case));
  return test_cases;
}

}  // namespace lightproof
