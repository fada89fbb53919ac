#include "lightproof/gate/direction_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <variant>

#include "lightproof/gate/alternative_distribution.h"
#include "lightproof/materials/material.h"
#include "lightproof/warp/hemisphere.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

using Lobes = std::vector<reference::CosineLobe>;

constexpr Direction kUp = {0.0, 0.0, 1.0};

DirectionSampler uniform_hemisphere() {
  return {"uniform_hemisphere",
          "uniform over the hemisphere",
          {{kUp, 0.0, 1.0}},
          [](SquarePoint u) {
            const Direction d = uniform_hemisphere_from_square(u);
            return DrawnDirection{d, uniform_hemisphere_pdf(d)};
          },
          uniform_hemisphere_pdf};
}

DirectionSampler cosine_hemisphere() {
  return {"cosine_hemisphere",
          "the cosine over pi",
          {{kUp, 1.0, 1.0}},
          [](SquarePoint u) {
            const Direction d = cosine_hemisphere_from_square(u);
            return DrawnDirection{d, cosine_hemisphere_pdf(d)};
          },
          cosine_hemisphere_pdf};
}

DirectionSampler phong_lobe(double exponent) {
  return {fmt::format("phong_lobe_{}", exponent),
          fmt::format("Phong's lobe around the normal, exponent {}", exponent),
          {{kUp, exponent, 1.0}},
          [exponent](SquarePoint u) {
            const Direction d = phong_lobe_from_square(u, exponent);
            return DrawnDirection{d, phong_lobe_pdf(d.z, exponent)};
          },
          [exponent](Direction d) { return phong_lobe_pdf(d.z, exponent); }};
}

Lobes lobes_of(const Lambert&, Direction /*mirrored*/) { return {{kUp, 1.0, 1.0}}; }

Lobes lobes_of(const ModifiedPhong& phong, Direction mirrored) {
  const double share = phong.diffuse / (phong.diffuse + phong.specular);
  return {{kUp, 1.0, share}, {mirrored, phong.exponent, 1.0 - share}};
}

DirectionSampler seen_from(const MaterialInfo& info, int degrees) {
  const double angle = degrees * kPi / 180.0;
  // Along +x, and the mirrored view along -x; from the normal the mirrored view is +z itself.
  const Direction view = {std::sin(angle), 0.0, std::cos(angle)};
  const ShadingPoint at = {{}, frame_around(kUp), view};
  const Lobes distribution = std::visit(
      [&](const auto& material) {
        return lobes_of(material, {-view.x, 0.0, view.z});
      },
      info.material);
  return {fmt::format("{}_{}", info.name, degrees),
          fmt::format("{}, seen at {} degrees to the normal", info.description, degrees),
          distribution,
          [&info, at](SquarePoint u) {
            const DirectionSample sample =
                std::visit([&](const auto& m) { return m.sample(at, u); }, info.material);
            return DrawnDirection{sample.direction, sample.scattering.pdf};
          },
          [&info, at](Direction d) {
            return std::visit([&](const auto& m) { return m.evaluate(at, d); }, info.material).pdf;
          }};
}

/// Both irradiances of the distribution itself, taken as radiance that is constant in each cell;
/// only where that is at least a tenth of its mean, since light over density grows beyond all
/// bounds where a lobe ends.
void add_estimators(Expectation& expectation, const Lobes& distribution) {
  const auto density = [&distribution](Direction d) { return reference::density(distribution, d); };
  // The horizons of both normals are edges of cells.
  const auto never = [](Direction, double) { return false; };
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    const reference::Kernel cosine = reference::cosine_kernel(kMeanCases[i].normal);
    const reference::Kernel kernel = {[&](Direction d) {
                                        return reference::KernelValue{cosine.at(d).k, density(d)};
                                      },
                                      never};
    const auto moments = reference::light_moments(kernel, {&expectation.luminance, 1});
    expectation.estimators[i] = moments[0][reference::SampledDensity::material];
    expectation.uniform[i] = moments[0][reference::SampledDensity::uniform];
  }
  Grid<double> bright(expectation.luminance.extent());
  for (std::size_t i = 0; i < bright.values().size(); ++i) {
    bright.values()[i] = expectation.luminance.values()[i] > 0.0 ? 1.0 : 0.0;
  }
  const reference::Kernel one = {[&](Direction d) {
                                   return reference::KernelValue{1.0, density(d)};
                                 },
                                 never};
  expectation.inverse_pdf =
      reference::light_moments(one, {&bright, 1})[0][reference::SampledDensity::material];
}

Expectation expectation_of(const Lobes& distribution) {
  Expectation expectation;
  expectation.masses = reference::cell_masses(distribution, reference::cells_for(distribution));
  const Extent cells = expectation.masses.extent();
  expectation.bins =
      reference::bin_masses(expectation.masses, expectation.density_space, kGateBins);
  expectation.rows = reference::row_marginal(expectation.masses);
  expectation.columns = reference::column_marginal(expectation.masses);
  if (reference::is_around_z(distribution)) {
    expectation.transform = [distribution](std::span<const TexelSample> samples,
                                           std::span<const double> /*cosines*/,
                                           std::span<reference::RosenblattPoint> points) {
      for (std::size_t i = 0; i < samples.size(); ++i) {
        points[i] = reference::rosenblatt_point(distribution, samples[i].at);
      }
    };
  }
  expectation.density = [distribution](SquarePoint at) {
    return to_square({reference::density(distribution, direction_from_square(at))}, at).value;
  };
  expectation.luminance = Grid<double>(cells);
  double sum = 0.0;
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      expectation.luminance(x, y) = expectation.masses(x, y) / texel_solid_angle(cells, y);
      sum += expectation.luminance(x, y);
    }
  }
  expectation.mean_luminance = sum / static_cast<double>(cells.count());
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      if (!expectation.is_bright(expectation.luminance(x, y))) expectation.luminance(x, y) = 0.0;
    }
  }
  expectation.set_flags();
  add_estimators(expectation, distribution);
  return expectation;
}

struct OtherLobes {
  std::string_view name;
  std::string_view diagnosis;
  Lobes (*change)(Lobes);
};

template <class Change>
Lobes each(Lobes lobes, const Change& change) {
  for (reference::CosineLobe& lobe : lobes) change(lobe);
  return lobes;
}

constexpr OtherLobes kOtherLobes[] = {
    {"cosine-lobe", "the cosine's own lobe whatever the exponent",
     [](Lobes) {
       return Lobes{{kUp, 1.0, 1.0}};
     }},
    {"hemisphere", "uniform over the hemisphere: a missing square root or power",
     [](Lobes) {
       return Lobes{{kUp, 0.0, 1.0}};
     }},
    {"sphere", "uniform over the whole sphere",
     [](Lobes) {
       return Lobes{{kUp, 0.0, 0.5}, {-kUp, 0.0, 0.5}};
     }},
    {"exponent-one-less", "an exponent of n where n + 1 belongs: the lobe is that of n - 1",
     [](Lobes lobes) {
       return each(std::move(lobes),
                   [](auto& lobe) { lobe.exponent = std::max(0.0, lobe.exponent - 1.0); });
     }},
    {"exponent-one-more", "an exponent of n + 2 where n + 1 belongs: the lobe is that of n + 1",
     [](Lobes lobes) { return each(std::move(lobes), [](auto& lobe) { lobe.exponent += 1.0; }); }},
    {"below-horizon", "some samples are mirrored below the horizon",
     [](Lobes lobes) {
       const std::size_t count = lobes.size();
       for (std::size_t i = 0; i < count; ++i) {
         const reference::CosineLobe lobe = lobes[i];
         lobes.push_back(
             {{lobe.axis.x, lobe.axis.y, -lobe.axis.z}, lobe.exponent, 0.01 * lobe.share});
         lobes[i].share *= 0.99;
       }
       return lobes;
     }},
    {"lobe-around-normal", "the lobe stands on the normal instead of the mirrored view",
     [](Lobes lobes) { return each(std::move(lobes), [](auto& lobe) { lobe.axis = kUp; }); }},
    {"lobe-around-view", "the lobe stands on the view instead of the mirrored one",
     [](Lobes lobes) {
       return each(std::move(lobes), [](auto& lobe) { lobe.axis.x = -lobe.axis.x; });
     }},
    {"lobes-exchanged", "the lobes chosen with each other's probability",
     [](Lobes lobes) {
       if (lobes.size() == 2) std::swap(lobes[0].share, lobes[1].share);
       return lobes;
     }},
    {"lobes-alike", "all lobes chosen equally often, whatever they reflect",
     [](Lobes lobes) {
       const double share = 1.0 / static_cast<double>(lobes.size());
       return each(std::move(lobes), [share](auto& lobe) { lobe.share = share; });
     }},
};

std::vector<Alternative> alternatives_to(const Lobes& distribution) {
  const auto declared = std::make_shared<const Grid<double>>(
      reference::cell_masses(distribution, reference::cells_for(distribution)));
  std::vector<Alternative> alternatives;
  for (const OtherLobes& other : kOtherLobes) {
    alternatives.push_back({other.name, other.diagnosis, [declared, distribution, &other] {
                              return reference::cell_masses(other.change(distribution),
                                                            declared->extent());
                            }});
  }
  for (const AlternativeDistribution& other : alternative_distributions()) {
    if (other.reads_map || other.is_example) continue;
    alternatives.push_back({other.name, other.diagnosis,
                            [declared, &other] { return other.masses({declared.get()}); }});
  }
  return alternatives;
}

/// The nearest point of the square that is inside a cell.
SquarePoint off_the_poles(SquarePoint at, Extent cells) {
  const double margin = kCellMargin / cells.height;
  return {at.s, std::clamp(at.t, margin, 1.0 - margin)};
}

}  // namespace

std::vector<DirectionSampler> direction_samplers() {
  std::vector<DirectionSampler> samplers = {uniform_hemisphere(), cosine_hemisphere(),
                                            phong_lobe(1.0), phong_lobe(50.0), phong_lobe(1000.0)};
  for (const MaterialInfo& info : materials()) {
    for (const int degrees : {0, 45, 80}) samplers.push_back(seen_from(info, degrees));
  }
  return samplers;
}

BoundSampler bound_directions(const DirectionSampler& sampler, Extent cells) {
  return {[sample = sampler.sample, cells](std::span<const SquarePoint> points,
                                           std::span<TexelSample> samples) {
            for (std::size_t i = 0; i < points.size(); ++i) {
              const DrawnDirection drawn = sample(points[i]);
              const SquarePoint at = off_the_poles(square_from_direction(drawn.direction), cells);
              samples[i] = {at, cell_of(at.s, cells.width), cell_of(at.t, cells.height),
                            to_square(drawn.pdf, at)};
            }
          },
          [pdf = sampler.pdf](SquarePoint at) {
            return to_square(pdf(direction_from_square(at)), at);
          }};
}

std::vector<TestCase> test_cases_of(std::span<const DirectionSampler> samplers) {
  std::vector<TestCase> test_cases;
  for (const DirectionSampler& sampler : samplers) {
    const SamplerInstance instance = {sampler.name, false, [sampler] {
                                        return bound_directions(
                                            sampler, reference::cells_for(sampler.distribution));
                                      }};
    test_cases.push_back(
        {std::string(kDirections),
         "",
         "",
         [distribution = sampler.distribution] {
           return std::make_shared<const Expectation>(expectation_of(distribution));
         },
         [distribution = sampler.distribution] { return alternatives_to(distribution); },
         {instance}});
  }
  return test_cases;
}

std::vector<TestCase> test_cases_of(std::span<const EnvironmentMap> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test,
                                    std::span<const DirectionSampler> samplers) {
  std::vector<TestCase> test_cases = test_cases_of(maps, samplers_under_test);
  for (TestCase& test_case : test_cases_of(samplers)) test_cases.push_back(std::move(test_case));
  return test_cases;
}

}  // namespace lightproof
