#include "lightproof/gate/material_distribution.h"

#include <cmath>

namespace lightproof {
namespace {

using reference::NormalDistribution;
using reference::UniformChart;

constexpr Direction kUp = {0.0, 0.0, 1.0};

DirectionDistribution distribution_of(const Lambert& /*lambert*/, Direction /*view*/) {
  return CosineLobes{{kUp, 1.0, 1.0}};
}

DirectionDistribution distribution_of(const ModifiedPhong& phong, Direction view) {
  const double share = phong.diffuse / (phong.diffuse + phong.specular);
  return CosineLobes{{kUp, 1.0, share}, {{-view.x, -view.y, view.z}, phong.exponent, 1.0 - share}};
}

/// Another density, by its chart.
MistakenDensity mistaken(std::string_view name, std::string_view diagnosis,
                         const UniformChart& other) {
  return {name, diagnosis, [pdf = other.pdf](Direction d) { return pdf(d).value; }};
}

/// The light on the side of the view.
MistakenDensity not_mirrored(const UniformChart& claimed) {
  return {"lobe-around-view", "the lobe stands on the side of the view instead of the mirrored one",
          [pdf = claimed.pdf](Direction d) {
            return pdf({-d.x, -d.y, d.z}).value;
          }};
}

/// The density that no factor 1/(4 v.h) was applied to, v.h being half the length of the sum.
MistakenDensity without_jacobian(const UniformChart& claimed, Direction view) {
  return {"density-of-normals",
          "the density of the microfacet normal instead of the direction's: 1/(4 v.h) is missing",
          [pdf = claimed.pdf, view](Direction d) {
            return pdf(d).value * 2.0 * glm::length(view + d);
          }};
}

UniformChart chart_of(MicrofacetSampling sampling, double alpha, Direction view) {
  switch (sampling) {
    case MicrofacetSampling::normals:
      return reference::mirrored_at_normals({NormalDistribution::Kind::ggx, alpha}, view);
    case MicrofacetSampling::visible_normals:
    case MicrofacetSampling::spherical_caps:
      return reference::mirrored_at_visible_normals(alpha, view);
    case MicrofacetSampling::bounded_caps:
      break;
  }
  return reference::mirrored_at_bounded_normals(alpha, view);
}

DirectionDistribution distribution_of(const Ggx& ggx, Direction view) {
  const double alpha = ggx.roughness * ggx.roughness;
  const auto with_alpha = [&](double other) { return chart_of(ggx.sampling, other, view); };
  const UniformChart claimed = with_alpha(alpha);
  return ChartedDensity{
      claimed,
      {mistaken("roughness-for-alpha", "alpha is the roughness instead of its square",
                with_alpha(ggx.roughness)),
       mistaken("alpha-squared", "alpha is squared once too often", with_alpha(alpha * alpha)),
       not_mirrored(claimed), without_jacobian(claimed, view)}};
}

DirectionDistribution distribution_of(const BlinnMicrofacet& blinn, Direction view) {
  const double shininess = 2.0 / std::pow(blinn.roughness, 4) - 2.0;
  const auto with_power = [&](double power) {
    return reference::mirrored_at_normals({NormalDistribution::Kind::blinn, power}, view);
  };
  const UniformChart claimed = with_power(shininess);
  return ChartedDensity{claimed,
                        {mistaken("exponent-one-less",
                                  "an exponent of n where n + 1 belongs: the lobe is that of n - 1",
                                  with_power(shininess - 1.0)),
                         not_mirrored(claimed), without_jacobian(claimed, view)}};
}

}  // namespace

DirectionDistribution distribution_of(const Material& material, Direction view) {
  return std::visit([&](const auto& surface) { return distribution_of(surface, view); }, material);
}

}  // namespace lightproof
