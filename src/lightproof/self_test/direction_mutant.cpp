#include "lightproof/self_test/direction_mutant.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "lightproof/core/error.h"
#include "lightproof/materials/material.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {
namespace {

constexpr Direction kUp = {0.0, 0.0, 1.0};

/// The sampler of the registry that a mutant claims to be.
DirectionSamplerInfo correct_sampler(std::string_view name) {
  std::vector<DirectionSamplerInfo> all = all_direction_samplers();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
  if (found == all.end())
    throw InputError("no sampler of directions is called " + std::string(name));
  return *found;
}

using Sample = std::function<DrawnDirection(SquarePoint)>;
using Pdf = std::function<PerSteradian(Direction)>;

struct Description {
  std::string name;
  std::string defect;
  std::string_view claims;  ///< to be this sampler
  std::string_view diagnosis;
  Oracle oracle;
};

/// The sampler that it claims to be, with the parts that are not empty in its place.
DirectionMutant mutant(Description what, Sample sample, Pdf pdf = {}) {
  DirectionSamplerInfo sampler = correct_sampler(what.claims);
  sampler.name = std::move(what.name);
  sampler.description = std::string(what.claims) + ": " + std::move(what.defect);
  if (sample) sampler.sample = std::move(sample);
  if (pdf) sampler.pdf = std::move(pdf);
  return {std::move(sampler), what.diagnosis, what.oracle};
}

/// Draws by `direction` and returns what `pdf` says of it.
template <class Place, class Density>
Sample drawn(const Place& direction, const Density& pdf) {
  return [direction, pdf](SquarePoint u) {
    const Direction d = direction(u);
    return DrawnDirection{d, pdf(d)};
  };
}

/// Samples of a correct sampler with their density times `factor`.
Sample scaled(const DirectionSamplerInfo& sampler, double factor) {
  return [sample = sampler.sample, factor](SquarePoint u) {
    const DrawnDirection drawn = sample(u);
    return DrawnDirection{drawn.direction, {factor * drawn.pdf.value}};
  };
}

Pdf scaled_pdf(const DirectionSamplerInfo& sampler, double factor) {
  return [pdf = sampler.pdf, factor](Direction d) { return PerSteradian{factor * pdf(d).value}; };
}

void add_warps(std::vector<DirectionMutant>& all) {
  all.push_back(mutant({"cosine-without-root", "height 1-u instead of its square root",
                        "cosine_hemisphere", "hemisphere", Oracle::reference},
                       drawn(uniform_hemisphere_from_square, cosine_hemisphere_pdf)));
  const DirectionSamplerInfo cosine = correct_sampler("cosine_hemisphere");
  all.push_back(mutant({"cosine-without-pi", "the density not divided by pi", "cosine_hemisphere",
                        "pdf-scaled", Oracle::check},
                       scaled(cosine, kPi), scaled_pdf(cosine, kPi)));
  const auto projected = [](Direction d) { return PerSteradian{d.z > 0.0 ? 1.0 / kPi : 0.0}; };
  all.push_back(mutant({"cosine-per-projected-angle", "a density per projected solid angle",
                        "cosine_hemisphere", "pdf-of-another-measure", Oracle::check},
                       drawn(cosine_hemisphere_from_square, projected), projected));
  all.push_back(
      mutant({"angle-uniform", "the angle to the normal drawn uniformly", "cosine_hemisphere",
              "rows-alike", Oracle::reference},
             drawn([](SquarePoint u) { return direction_around_z(std::cos(0.5 * kPi * u.t), u.s); },
                   cosine_hemisphere_pdf)));
  all.push_back(mutant({"half-azimuth", "the azimuth drawn over pi instead of 2 pi",
                        "cosine_hemisphere", "half-circle", Oracle::reference},
                       drawn(
                           [](SquarePoint u) {
                             return cosine_hemisphere_from_square({0.5 * u.s, u.t});
                           },
                           cosine_hemisphere_pdf)));
  all.push_back(mutant({"azimuth-of-height", "one random number for azimuth and height",
                        "cosine_hemisphere", "same-number", Oracle::reference},
                       drawn(
                           [](SquarePoint u) {
                             return cosine_hemisphere_from_square({u.t, u.t});
                           },
                           cosine_hemisphere_pdf)));
  all.push_back(mutant({"leak-below-horizon", "one sample in a hundred mirrored below the horizon",
                        "cosine_hemisphere", "below-horizon", Oracle::reference},
                       [](SquarePoint u) {
                         Direction d = cosine_hemisphere_from_square(u);
                         const PerSteradian pdf = cosine_hemisphere_pdf(d);
                         // Chosen by the number's later digits, at any height.
                         if (1000.0 * u.t - std::floor(1000.0 * u.t) < 0.01) d.z = -d.z;
                         return DrawnDirection{d, pdf};
                       }));
  all.push_back(mutant({"whole-sphere", "the lower half drawn as well", "uniform_hemisphere",
                        "sphere", Oracle::reference},
                       drawn([](SquarePoint u) { return direction_around_z(1.0 - 2.0 * u.t, u.s); },
                             [](Direction) { return PerSteradian{1.0 / kSphere}; }),
                       [](Direction) { return PerSteradian{1.0 / kSphere}; }));
}

void add_phong_lobes(std::vector<DirectionMutant>& all) {
  const DirectionSamplerInfo lobe = correct_sampler("phong_lobe_50");
  const double n = std::get<CosineLobes>(lobe.distribution).front().exponent;
  const auto with_exponent = [](double exponent) {
    return [exponent](SquarePoint u) { return phong_lobe_from_square(u, exponent); };
  };
  const auto density = [](double exponent) {
    return [exponent](Direction d) { return phong_lobe_pdf(d.z, exponent); };
  };
  all.push_back(mutant({"phong-root-of-n", "the n-th root of u instead of the (n+1)-th",
                        "phong_lobe_50", "exponent-one-less", Oracle::reference},
                       drawn(with_exponent(n - 1.0), density(n))));
  all.push_back(
      mutant({"phong-for-brdf", "sample and density of cos^(n+1), the BRDF times the cosine",
              "phong_lobe_50", "exponent-one-more", Oracle::reference},
             drawn(with_exponent(n + 1.0), density(n + 1.0)), density(n + 1.0)));
  const double brdf = (n + 2.0) / (n + 1.0);
  all.push_back(mutant({"phong-normalised-as-brdf", "(n+2)/2pi where (n+1)/2pi belongs",
                        "phong_lobe_50", "pdf-scaled", Oracle::check},
                       scaled(lobe, brdf), scaled_pdf(lobe, brdf)));
}

/// What the mutants of the two-lobed material need of it.
struct TwoLobes {
  double share;  ///< of the diffuse lobe
  double exponent;
  Frame mirrored;
  DirectionSamplerInfo sampler;

  Direction diffuse(SquarePoint u) const { return cosine_hemisphere_from_square(u); }
  Direction glossy(SquarePoint u) const {
    return mirrored.to_world(phong_lobe_from_square(u, exponent));
  }
};

TwoLobes two_lobes() {
  const DirectionSamplerInfo sampler = correct_sampler("phong_45");
  const auto& lobes = std::get<CosineLobes>(sampler.distribution);
  return {lobes[0].share, lobes[1].exponent, frame_around(lobes[1].axis), sampler};
}

/// The material with its lobe on another axis, in sample and pdf.
DirectionMutant moved_lobe(std::string name, std::string defect, std::string_view diagnosis,
                           Direction axis) {
  TwoLobes moved = two_lobes();
  moved.mirrored = frame_around(axis);
  const auto pdf = [moved](Direction d) {
    const double glossy = phong_lobe_pdf(glm::dot(moved.mirrored.normal, d), moved.exponent).value;
    return PerSteradian{moved.share * cosine_hemisphere_pdf(d).value +
                        (1.0 - moved.share) * glossy};
  };
  const auto direction = [moved](SquarePoint u) {
    if (u.s < moved.share) return moved.diffuse({u.s / moved.share, u.t});
    return moved.glossy({(u.s - moved.share) / (1.0 - moved.share), u.t});
  };
  return mutant({std::move(name), std::move(defect), "phong_45", diagnosis, Oracle::reference},
                drawn(direction, pdf), pdf);
}

void add_materials(std::vector<DirectionMutant>& all) {
  const TwoLobes lobes = two_lobes();
  const Direction axis = lobes.mirrored.normal;
  all.push_back(
      moved_lobe("lobe-around-normal", "the lobe stands on the normal", "lobe-around-normal", kUp));
  all.push_back(moved_lobe("lobe-around-view", "the view not mirrored", "lobe-around-view",
                           {-axis.x, axis.y, axis.z}));
  all.push_back(
      mutant({"lobes-chosen-alike", "both lobes drawn equally often, whatever they reflect",
              "phong_45", "lobes-alike", Oracle::reference},
             drawn(
                 [lobes](SquarePoint u) {
                   return u.s < 0.5 ? lobes.diffuse({2.0 * u.s, u.t})
                                    : lobes.glossy({2.0 * u.s - 1.0, u.t});
                 },
                 lobes.sampler.pdf)));
  all.push_back(mutant(
      {"number-not-stretched", "the number that chose the lobe used again as it is", "phong_45",
       "unknown", Oracle::reference},
      drawn(
          [lobes](SquarePoint u) { return u.s < lobes.share ? lobes.diffuse(u) : lobes.glossy(u); },
          lobes.sampler.pdf)));
  all.push_back(mutant({"density-of-one-lobe", "the density of the chosen lobe alone is returned",
                        "phong_45", "pdf-mismatch", Oracle::check},
                       [lobes](SquarePoint u) {
                         const DrawnDirection drawn = lobes.sampler.sample(u);
                         const double cosine = glm::dot(lobes.mirrored.normal, drawn.direction);
                         const PerSteradian own = u.s < lobes.share
                                                      ? cosine_hemisphere_pdf(drawn.direction)
                                                      : phong_lobe_pdf(cosine, lobes.exponent);
                         return DrawnDirection{drawn.direction, own};
                       }));
}

/// A material's sample and density as a mutant of microfacets seen at 45 degrees.
struct Seen {
  Material material;
  ShadingPoint at = {{}, frame_around(kUp), {std::sqrt(0.5), 0.0, std::sqrt(0.5)}};

  Sample sample() const {
    return [*this](SquarePoint u) {
      const DirectionSample drawn =
          std::visit([&](const auto& m) { return m.sample(at, u); }, material);
      return DrawnDirection{drawn.direction, drawn.scattering.pdf};
    };
  }
  Pdf pdf() const {
    return [*this](Direction d) {
      return std::visit([&](const auto& m) { return m.evaluate(at, d).pdf; }, material);
    };
  }
};

Seen seen_ggx(double roughness, MicrofacetSampling sampling) {
  return {Ggx{roughness, 1.0, SmithMasking::height_correlated, sampling}};
}

Direction turned_around_normal(Direction d) { return {-d.x, -d.y, d.z}; }

void add_ggx(std::vector<DirectionMutant>& all) {
  constexpr double kRoughness = 0.6;
  constexpr std::string_view kVisible = "ggx_visible_0.6_45";
  const auto add = [&](std::string_view claims, std::string name, std::string defect,
                       std::string_view diagnosis, Oracle oracle, Sample sample, Pdf pdf) {
    all.push_back(mutant({std::move(name), std::move(defect), claims, diagnosis, oracle},
                         std::move(sample), std::move(pdf)));
  };
  const Seen visible = seen_ggx(kRoughness, MicrofacetSampling::visible_normals);
  // alpha is the square of what stands here.
  const Seen rougher = seen_ggx(std::sqrt(kRoughness), MicrofacetSampling::visible_normals);
  add(kVisible, "ggx-roughness-for-alpha", "alpha is the roughness itself", "roughness-for-alpha",
      Oracle::reference, rougher.sample(), rougher.pdf());
  const Seen smoother = seen_ggx(kRoughness * kRoughness, MicrofacetSampling::visible_normals);
  add(kVisible, "ggx-alpha-squared", "alpha squared in the sampler and its density",
      "alpha-squared", Oracle::reference, smoother.sample(), smoother.pdf());
  const auto of_normal = [pdf = visible.pdf(), view = visible.at.view](Direction d) {
    return PerSteradian{pdf(d).value * 2.0 * glm::length(view + d)};
  };
  add(
      kVisible, "ggx-density-of-normal", "1/(4 v.h) missing from the density",
      "pdf-of-another-measure", Oracle::check,
      [sample = visible.sample(), of_normal](SquarePoint u) {
        const Direction d = sample(u).direction;
        return DrawnDirection{d, of_normal(d)};
      },
      of_normal);
  add(
      kVisible, "ggx-wrong-frame", "the light on the side of the view", "lobe-around-view",
      Oracle::reference,
      [sample = visible.sample()](SquarePoint u) {
        const DrawnDirection drawn = sample(u);
        return DrawnDirection{turned_around_normal(drawn.direction), drawn.pdf};
      },
      [pdf = visible.pdf()](Direction d) { return pdf(turned_around_normal(d)); });
  // Some of these normals face away from the view: no visible one reflects light to there.
  add(kVisible, "ggx-normals-as-visible", "all normals drawn, the density that of visible ones",
      "off-the-map", Oracle::check, seen_ggx(kRoughness, MicrofacetSampling::normals).sample(), {});
  add("ggx_bounded_1_45", "ggx-without-bound",
      "the whole cap drawn with the density of the bounded", "off-the-map", Oracle::check,
      seen_ggx(1.0, MicrofacetSampling::spherical_caps).sample(), {});
}

void add_blinn(std::vector<DirectionMutant>& all) {
  constexpr double kRoughness = 0.6;
  constexpr std::string_view kBlinn = "blinn_0.6_45";
  const Seen blinn = {BlinnMicrofacet{kRoughness, 1.0}};
  const double shininess = blinn_shininess(kRoughness);
  all.push_back(mutant({"blinn-lobe-exponent", "the root of S + 1 instead of S + 2", kBlinn,
                        "exponent-one-less", Oracle::reference},
                       [=, pdf = blinn.pdf()](SquarePoint u) {
                         const Direction d =
                             reflect_about(blinn.at.view, blinn_lobe_from_square(shininess, u));
                         return DrawnDirection{d, pdf(d)};
                       }));
  const DirectionSamplerInfo right = correct_sampler(kBlinn);
  all.push_back(mutant({"blinn-without-two-pi", "a density of the height instead of the direction",
                        kBlinn, "pdf-scaled", Oracle::check},
                       scaled(right, 2.0 * kPi), scaled_pdf(right, 2.0 * kPi)));
}

}  // namespace

std::vector<DirectionMutant> direction_mutants() {
  std::vector<DirectionMutant> all;
  add_warps(all);
  add_phong_lobes(all);
  add_materials(all);
  add_ggx(all);
  add_blinn(all);
  return all;
}

std::vector<DirectionSamplerInfo> direction_mutant_samplers() {
  std::vector<DirectionSamplerInfo> samplers;
  for (DirectionMutant& mutant : direction_mutants()) samplers.push_back(std::move(mutant.sampler));
  return samplers;
}

}  // namespace lightproof
