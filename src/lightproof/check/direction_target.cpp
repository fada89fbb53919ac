#include "lightproof/check/direction_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/gate/material_distribution.h"

namespace lightproof {
namespace {

constexpr Direction kUp = {0.0, 0.0, 1.0};
/// A view closer to the surface leaves lobes that no float can follow.
constexpr double kMostDegrees = 89.9;
/// Cells of latitude and longitude grow with the exponent: narrower lobes have coordinates of their
/// own.
constexpr double kMostInCells = 1000.0;

MistakenDensity mistaken(std::string_view name, std::string_view diagnosis,
                         std::function<double(Direction)> density) {
  return {name, diagnosis, std::move(density)};
}

DirectionDistribution uniform(double /*parameter*/, Direction /*view*/) {
  return ChartedDensity{
      reference::henyey_greenstein_chart(0.0),
      {mistaken("hemisphere", "uniform over the upper hemisphere alone",
                [](Direction d) { return d.z >= 0.0 ? 1.0 : 0.0; }),
       mistaken("cosine-lobe", "the cosine's own lobe, over the upper hemisphere",
                [](Direction d) { return std::max(0.0, d.z); }),
       mistaken("cube-projected", "points uniform in a cube, normalised: denser in its corners",
                [](Direction d) {
                  const double most = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
                  return 1.0 / (most * most * most);
                })}};
}

/// In closed form: its density is infinite at the poles. The square's t is (1 + z) / 2.
std::vector<Alternative> uniform_polar_angle() {
  return {{"polar-angle-uniform", "a polar angle that is uniform: a missing sin(theta)", [] {
             const Extent cells = cells_of(ChartedDensity{});
             Grid<double> masses(cells);
             const auto below = [&](int y) {
               return std::acos(1.0 - 2.0 * y / cells.height) / kPi;
             };
             for (int y = 0; y < cells.height; ++y) {
               std::ranges::fill(masses.row(y), (below(y + 1) - below(y)) / cells.width);
             }
             return masses;
           }}};
}

DirectionDistribution uniform_hemisphere(double /*parameter*/, Direction /*view*/) {
  return CosineLobes{{kUp, 0.0, 1.0}};
}

DirectionDistribution cosine(double /*parameter*/, Direction /*view*/) {
  return CosineLobes{{kUp, 1.0, 1.0}};
}

DirectionDistribution phong(double exponent, Direction view) {
  if (view == kUp && exponent <= kMostInCells) return CosineLobes{{kUp, exponent, 1.0}};
  const Direction axis = {-view.x, -view.y, view.z};
  const auto lobe = [](Direction around, double n) {
    return [chart = reference::cosine_lobe_chart(around, n)](Direction d) {
      return chart.pdf(d).value;
    };
  };
  return ChartedDensity{
      reference::cosine_lobe_chart(axis, exponent),
      {mistaken("lobe-around-normal", "the lobe stands on the normal instead of the mirrored view",
                lobe(kUp, exponent)),
       mistaken("lobe-around-view", "the lobe stands on the view instead of the mirrored one",
                lobe(view, exponent)),
       mistaken("exponent-one-less",
                "an exponent of n where n + 1 belongs: the lobe is that of n - 1",
                lobe(axis, std::max(0.0, exponent - 1.0))),
       mistaken("exponent-one-more",
                "an exponent of n + 2 where n + 1 belongs: the lobe is that of n + 1",
                lobe(axis, exponent + 1.0))}};
}

template <MicrofacetSampling kSampling>
DirectionDistribution ggx(double roughness, Direction view) {
  return distribution_of(Ggx{roughness, 1.0, SmithMasking::height_correlated, kSampling}, view);
}

DirectionDistribution blinn(double roughness, Direction view) {
  return distribution_of(BlinnMicrofacet{roughness, 1.0}, view);
}

DirectionDistribution henyey_greenstein(double g, Direction /*view*/) {
  const auto of = [](double other) {
    return [chart = reference::henyey_greenstein_chart(other)](Direction d) {
      return chart.pdf(d).value;
    };
  };
  return ChartedDensity{
      reference::henyey_greenstein_chart(g),
      {mistaken("backwards", "backwards: the sign of g, or of the direction, is the other one",
                of(-g)),
       mistaken("isotropic", "uniform over the sphere, whatever g", of(0.0)),
       mistaken("g-squared", "g squared where g belongs", of(g * g)),
       mistaken("g-halved", "half of g", of(0.5 * g))}};
}

constexpr double kLeastRoughness = 0.01;

constexpr std::array kTargets = {
    DirectionTargetInfo{.name = "uniform",
                        .form = "uniform",
                        .description = "uniform over the sphere",
                        .make = uniform,
                        .mistakes = uniform_polar_angle},
    DirectionTargetInfo{.name = "uniform-hemisphere",
                        .form = "uniform-hemisphere",
                        .description = "uniform over the hemisphere around +z",
                        .make = uniform_hemisphere},
    DirectionTargetInfo{.name = "cosine",
                        .form = "cosine",
                        .description = "the cosine over pi, around +z",
                        .make = cosine},
    DirectionTargetInfo{.name = "phong",
                        .form = "phong:N[@DEG]",
                        .description = "(n+1)/2pi cos^n around the mirrored view, n from 0 to 1e6; "
                                       "what lies below the surface is part of it",
                        .has_parameter = true,
                        .least = 0.0,
                        .most = 1e6,
                        .has_view = true,
                        .make = phong},
    DirectionTargetInfo{.name = "ggx",
                        .form = "ggx:R[@DEG]",
                        .description = "the view mirrored at GGX's visible normals, alpha = R^2, R "
                                       "from 0.01 to 1; what lies below the surface is part of it",
                        .has_parameter = true,
                        .least = kLeastRoughness,
                        .most = 1.0,
                        .has_view = true,
                        .make = ggx<MicrofacetSampling::visible_normals>},
    DirectionTargetInfo{.name = "ggx-normals",
                        .form = "ggx-normals:R[@DEG]",
                        .description = "the view mirrored at all of GGX's normals, D(h) (n.h)",
                        .has_parameter = true,
                        .least = kLeastRoughness,
                        .most = 1.0,
                        .has_view = true,
                        .make = ggx<MicrofacetSampling::normals>},
    DirectionTargetInfo{.name = "ggx-bounded",
                        .form = "ggx-bounded:R[@DEG]",
                        .description = "the view mirrored at bounded visible normals (Tokuyoshi & "
                                       "Eto 2023)",
                        .has_parameter = true,
                        .least = kLeastRoughness,
                        .most = 1.0,
                        .has_view = true,
                        .make = ggx<MicrofacetSampling::bounded_caps>},
    DirectionTargetInfo{.name = "blinn",
                        .form = "blinn:R[@DEG]",
                        .description = "the view mirrored at Blinn's normals, exponent 2/R^4 - 2",
                        .has_parameter = true,
                        .least = kLeastRoughness,
                        .most = 1.0,
                        .has_view = true,
                        .make = blinn},
    DirectionTargetInfo{.name = "henyey-greenstein",
                        .form = "henyey-greenstein:G",
                        .description = "the phase function, g from -0.99 to 0.99; light travels on "
                                       "along +z",
                        .has_parameter = true,
                        .least = -0.99,
                        .most = 0.99,
                        .make = henyey_greenstein},
};

[[noreturn]] void refuse(const DirectionTargetInfo& info, std::string_view text,
                         std::string_view reason) {
  throw InputError(fmt::format("target \"{}\": {}; it is written {}: {}", terminal_text(text),
                               reason, info.form, info.description));
}

std::optional<double> number_in(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

double number_from(const DirectionTargetInfo& info, std::string_view text, std::string_view part,
                   double least, double most) {
  const auto number = number_in(part);
  if (!number || !(*number >= least && *number <= most)) {
    refuse(info, text,
           fmt::format("\"{}\" is no number from {} to {}", terminal_text(part), least, most));
  }
  return *number;
}

/// Takes what stands behind a sign off the end of a text.
std::optional<std::string_view> take_behind(std::string_view& text, char sign) {
  const std::size_t at = text.find(sign);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view behind = text.substr(at + 1);
  text = text.substr(0, at);
  return behind;
}

}  // namespace

std::span<const DirectionTargetInfo> direction_targets() { return kTargets; }

std::optional<DirectionTarget> direction_target(std::string_view text) {
  std::string_view rest = text;
  const auto degrees = take_behind(rest, '@');
  const auto parameter = take_behind(rest, ':');
  const auto* const info = std::find_if(kTargets.begin(), kTargets.end(),
                                        [&](const auto& target) { return target.name == rest; });
  if (info == kTargets.end()) return std::nullopt;
  if (parameter && !info->has_parameter) refuse(*info, text, "it has no parameter");
  if (!parameter && info->has_parameter) refuse(*info, text, "its parameter is missing");
  if (degrees && !info->has_view) refuse(*info, text, "it depends on no view");
  const double value =
      parameter ? number_from(*info, text, *parameter, info->least, info->most) : 0.0;
  const double angle =
      degrees ? number_from(*info, text, *degrees, 0.0, kMostDegrees) * kPi / 180.0 : 0.0;
  const Direction view = {std::sin(angle), 0.0, std::cos(angle)};
  return DirectionTarget{std::string(text), info->make(value, view),
                         info->mistakes != nullptr ? info->mistakes() : std::vector<Alternative>()};
}

double density_of(const DirectionDistribution& distribution, Direction d) {
  if (const auto* charted = std::get_if<ChartedDensity>(&distribution)) {
    return charted->chart.pdf(d).value;
  }
  return reference::density(std::get<CosineLobes>(distribution), d);
}

}  // namespace lightproof
