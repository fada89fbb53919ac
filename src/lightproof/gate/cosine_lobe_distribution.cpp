// Sums of cosine lobes, on cells of latitude and longitude.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lightproof/gate/alternative_distribution.h"
#include "lightproof/gate/direction_distribution.h"
#include "lightproof/samplers/texel_positions.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

constexpr Direction kUp = {0.0, 0.0, 1.0};

/// Both irradiances of the distribution itself, taken as radiance that is constant in each cell;
/// only where that is at least a tenth of its mean, since light over density grows beyond all
/// bounds where a lobe ends.
void add_estimators(Expectation& expectation, const Grid<double>& radiance,
                    const CosineLobes& distribution) {
  const auto density = [&distribution](Direction d) { return reference::density(distribution, d); };
  // The horizons of both normals are edges of cells.
  const auto never = [](Direction, double) { return false; };
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    const reference::Kernel cosine = reference::cosine_kernel(kMeanCases[i].normal);
    const reference::Kernel kernel = {[&](Direction d) {
                                        return reference::KernelValue{cosine.at(d).k, density(d)};
                                      },
                                      never};
    const auto moments = reference::light_moments(kernel, {&radiance, 1});
    expectation.estimators[i] = moments[0][reference::SampledDensity::material];
    expectation.uniform[i] = moments[0][reference::SampledDensity::uniform];
  }
  Grid<double> bright(radiance.extent());
  for (std::size_t i = 0; i < bright.values().size(); ++i) {
    bright.values()[i] = radiance.values()[i] > 0.0 ? 1.0 : 0.0;
  }
  const reference::Kernel one = {[&](Direction d) {
                                   return reference::KernelValue{1.0, density(d)};
                                 },
                                 never};
  expectation.inverse_pdf =
      reference::light_moments(one, {&bright, 1})[0][reference::SampledDensity::material];
}

struct OtherLobes {
  std::string_view name;
  std::string_view diagnosis;
  CosineLobes (*change)(CosineLobes);
};

template <class Change>
CosineLobes each(CosineLobes lobes, const Change& change) {
  for (reference::CosineLobe& lobe : lobes) change(lobe);
  return lobes;
}

constexpr OtherLobes kOtherLobes[] = {
    {"cosine-lobe", "the cosine's own lobe whatever the exponent",
     [](CosineLobes) {
       return CosineLobes{{kUp, 1.0, 1.0}};
     }},
    {"hemisphere", "uniform over the hemisphere: a missing square root or power",
     [](CosineLobes) {
       return CosineLobes{{kUp, 0.0, 1.0}};
     }},
    {"sphere", "uniform over the whole sphere",
     [](CosineLobes) {
       return CosineLobes{{kUp, 0.0, 0.5}, {-kUp, 0.0, 0.5}};
     }},
    {"exponent-one-less", "an exponent of n where n + 1 belongs: the lobe is that of n - 1",
     [](CosineLobes lobes) {
       return each(std::move(lobes),
                   [](auto& lobe) { lobe.exponent = std::max(0.0, lobe.exponent - 1.0); });
     }},
    {"exponent-one-more", "an exponent of n + 2 where n + 1 belongs: the lobe is that of n + 1",
     [](CosineLobes lobes) {
       return each(std::move(lobes), [](auto& lobe) { lobe.exponent += 1.0; });
     }},
    {"below-horizon", "some samples are mirrored below the horizon",
     [](CosineLobes lobes) {
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
     [](CosineLobes lobes) { return each(std::move(lobes), [](auto& lobe) { lobe.axis = kUp; }); }},
    {"lobe-around-view", "the lobe stands on the view instead of the mirrored one",
     [](CosineLobes lobes) {
       return each(std::move(lobes), [](auto& lobe) { lobe.axis.x = -lobe.axis.x; });
     }},
    {"lobes-exchanged", "the lobes chosen with each other's probability",
     [](CosineLobes lobes) {
       if (lobes.size() == 2) std::swap(lobes[0].share, lobes[1].share);
       return lobes;
     }},
    {"lobes-alike", "all lobes chosen equally often, whatever they reflect",
     [](CosineLobes lobes) {
       const double share = 1.0 / static_cast<double>(lobes.size());
       return each(std::move(lobes), [share](auto& lobe) { lobe.share = share; });
     }},
};

/// The nearest point of the square that is inside a cell.
SquarePoint off_the_poles(SquarePoint at, Extent cells) {
  const double margin = kCellMargin / cells.height;
  return {at.s, std::clamp(at.t, margin, 1.0 - margin)};
}

}  // namespace

Extent cells_of(const CosineLobes& lobes) { return reference::cells_for(lobes); }

PlacedDirection direction_at(const CosineLobes& /*lobes*/, SquarePoint at) {
  return {direction_from_square(at), solid_angle_per_square(at.t)};
}

TexelSample sample_of(const CosineLobes& /*lobes*/, Extent cells, const DrawnDirection& drawn) {
  const SquarePoint at = off_the_poles(square_from_direction(drawn.direction), cells);
  return {at, cell_of(at.s, cells.width), cell_of(at.t, cells.height), to_square(drawn.pdf, at)};
}

std::shared_ptr<const Expectation> expectation_of(const CosineLobes& distribution) {
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
  Grid<double> radiance(cells);
  double sum = 0.0;
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      radiance(x, y) = expectation.masses(x, y) / texel_solid_angle(cells, y);
      sum += radiance(x, y);
    }
  }
  expectation.mean_luminance = sum / static_cast<double>(cells.count());
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      if (!expectation.is_bright(radiance(x, y))) radiance(x, y) = 0.0;
    }
  }
  expectation.luminance = radiance;
  expectation.set_flags();
  add_estimators(expectation, radiance, distribution);
  return std::make_shared<const Expectation>(std::move(expectation));
}

std::vector<Alternative> alternatives_to(const CosineLobes& distribution) {
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

}  // namespace lightproof
