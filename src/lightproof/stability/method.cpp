#include "lightproof/stability/method.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>

#include "lightproof/estimators/registry.h"
#include "lightproof/materials/material.h"
#include "lightproof/prefilter/lobe.h"
#include "lightproof/prefilter/progressive.h"

namespace lightproof {
namespace {

/// A published sampler as it is listed: point by point, whatever the map and the point.
BoundSampler bound_as_listed(AnySampler any) {
  auto sampler = std::make_shared<const AnySampler>(std::move(any));
  return {[sampler](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
            std::visit(
                [&](const auto& made) {
                  for (std::size_t i = 0; i < points.size(); ++i) {
                    samples[i] = made.sample(points[i]);
                  }
                },
                *sampler);
          },
          [sampler](SquarePoint at) {
            return std::visit([at](const auto& made) { return made.pdf(at); }, *sampler);
          }};
}

SamplerUnderTest method_of(const SamplerInfo& info, DensitySpace density_space) {
  SamplerUnderTest method = sampler_under_test(info, density_space);
  if (info.make_as_listed != nullptr) {
    method.bind = [make = info.make_as_listed, density_space](const EnvironmentMap& map) {
      return bound_as_listed(make(map, density_space));
    };
  }
  return method;
}

std::vector<SamplerUnderTest> map_samplers() {
  std::vector<SamplerUnderTest> methods;
  for (const SamplerInfo& info : samplers()) {
    for (const DensitySpace density_space : kDensitySpaces) {
      methods.push_back(method_of(info, density_space));
    }
  }
  return methods;
}

/// A material of the registry with its roughness or its exponent replaced; what has neither stays.
Material at_roughness(Material material, double roughness) {
  if (auto* ggx = std::get_if<Ggx>(&material)) ggx->roughness = roughness;
  if (auto* blinn = std::get_if<BlinnMicrofacet>(&material)) blinn->roughness = roughness;
  if (auto* phong = std::get_if<ModifiedPhong>(&material)) {
    phong->exponent = half_vector_shininess(roughness);
  }
  return material;
}

std::vector<LobeMethod> lobe_methods() {
  std::vector<LobeMethod> methods;
  for (const MaterialInfo& info : materials()) {
    const bool is_rough_mirror = std::holds_alternative<Ggx>(info.material) ||
                                 std::holds_alternative<BlinnMicrofacet>(info.material);
    // Their ways to draw are rows of their own.
    if (is_rough_mirror) continue;
    methods.push_back(
        {std::string(info.name),
         [material = info.material](double roughness) { return at_roughness(material, roughness); },
         std::holds_alternative<ModifiedPhong>(info.material) ? "phong:" : ""});
  }
  for (const MicrofacetInfo& info : microfacets()) {
    const bool is_ggx = std::holds_alternative<Ggx>(info.of_roughness(0.5));
    methods.push_back({std::string(info.name), info.of_roughness, is_ggx ? "ggx:" : ""});
  }
  return methods;
}

template <class T>
FrameMethod frame_method(const FrameConstruction& info, std::string_view precision,
                         FrameOf<T> (*construct)(UnitVector<T>)) {
  return {fmt::format("{}, {}", info.name, precision), !info.defect.empty(),
          static_cast<double>(std::numeric_limits<T>::epsilon()), [construct](Direction normal) {
            return orthonormality_error(construct(UnitVector<T>(normal)));
          }};
}

std::vector<FrameMethod> frame_methods() {
  std::vector<FrameMethod> methods;
  for (const FrameConstruction& info : frame_constructions()) {
    methods.push_back(frame_method(info, "float", info.in_float));
    methods.push_back(frame_method(info, "double", info.in_double));
  }
  return methods;
}

/// MeanMethod::mean_of_spikes of this mean.
template <class Mean, class Value>
double mean_of_spikes(std::uint64_t count) {
  Mean mean;
  for (std::uint64_t i = 1; i <= count; ++i) mean.add(i % 1000 == 0 ? Value(1000) : Value(0), 1);
  return static_cast<double>(mean.mean());
}

std::vector<MeanMethod> mean_methods() {
  return {{"running mean", false, mean_of_spikes<RunningMean<double>, double>},
          {"blended in float, published", true, mean_of_spikes<PublishedBlend, float>},
          {"swapped weights, published", true, mean_of_spikes<SwappedBlend, double>}};
}

std::vector<BrdfTableMethod> brdf_table_methods() {
  constexpr std::array<std::pair<std::string_view, Masking>, 3> kMaskings = {
      {{"karis", Masking::karis},
       {"separable", Masking::separable},
       {"height-correlated", Masking::height_correlated}}};
  std::vector<BrdfTableMethod> methods;
  for (const auto& [name, masking] : kMaskings) {
    methods.push_back(
        {fmt::format("{}, quadrature", name), false,
         [masking = masking](double mu, double r) { return integrate_brdf(mu, r, masking); }});
    methods.push_back(
        {fmt::format("{}, sum, published", name), true, [masking = masking](double mu, double r) {
           return integrate_brdf(mu, r, masking, HammersleyRange::published(1024));
         }});
  }
  return methods;
}

template <class Row>
std::vector<Row> copied(std::span<const Row> rows) {
  return {rows.begin(), rows.end()};
}

}  // namespace

StabilityMethods all_stability_methods() {
  return {.samplers = map_samplers(),
          .warps = warp_samplers(),
          .lobes = lobe_methods(),
          .frames = frame_methods(),
          .prefilters = copied(prefilter_methods()),
          .reflectivities = {{"half-vectors, published", true, ReflectivityForm::published},
                             {"half-vectors, per draw", false, ReflectivityForm::per_draw},
                             {"half-vectors, normalised", false, ReflectivityForm::normalised}},
          .brdf_tables = brdf_table_methods(),
          .means = mean_methods(),
          .estimators = copied(estimators()),
          .point_sets = copied(point_sets()),
          .formats = copied(map_formats())};
}

std::string method_name(const SamplerUnderTest& sampler) {
  return fmt::format("{}/{}", sampler.name, to_string(sampler.target.density_space));
}

bool is_method(std::string_view method, std::string_view name) {
  return method == name || (method.size() == name.size() + 2 && method.starts_with(name) &&
                            method[name.size()] == '/');
}

bool is_asked_for(std::string_view method, const std::vector<std::string>& names) {
  return names.empty() || std::ranges::any_of(names, [&](const std::string& name) {
           return is_method(method, name);
         });
}

}  // namespace lightproof
