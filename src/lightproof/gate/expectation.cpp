#include "lightproof/gate/expectation.h"

#include <memory>
#include <utility>

#include "lightproof/image/look_up.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/warp/lat_long.h"
#include "reference/bilinear_distribution.h"
#include "reference/bilinear_moments.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

/// The most texels of a map whose parts are kept: those of a cube take some 30 MB then.
constexpr std::size_t kMostKeptTexels = std::size_t{1} << 16U;

/// ∫ sin^2(theta) ds dt over one texel of row y.
double squared_sine_area(Extent extent, int y) {
  const auto primitive = [](double theta) { return 0.5 * theta - 0.25 * std::sin(2.0 * theta); };
  const double low = kPi * y / extent.height;
  const double high = kPi * (y + 1.0) / extent.height;
  return (primitive(high) - primitive(low)) / (kPi * extent.width);
}

/// Moments of 1/p(omega) under p where texels are no rows of latitude and longitude: it is the
/// Jacobian times the texel's area over its mass, and the density that it is averaged by takes one
/// of them back.
reference::EstimatorMoments mapped_inverse_pdf_moments(const Expectation& expectation) {
  const Extent extent = expectation.masses.extent();
  reference::EstimatorMoments moments;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      if (!expectation.is_bright(expectation.luminance(x, y))) continue;
      const SquareCell texel = texel_cell(extent, x, y);
      const double per_density = texel.area() / expectation.masses(x, y);
      const double jacobian = reference::largest_jacobian(expectation.mapping, extent, texel);
      moments.raw[0] += reference::cell_solid_angle(expectation.mapping, texel);
      moments.raw[1] +=
          per_density * reference::jacobian_integral(expectation.mapping, extent, texel);
      moments.largest = std::max(moments.largest, per_density * jacobian);
    }
  }
  return moments;
}

/// The largest sin(theta) in a row: at its edge towards the equator, or on it.
double largest_sine(Extent extent, int y) {
  if (2 * y < extent.height && extent.height < 2 * (y + 1)) return 1.0;
  return std::max(sin_theta(static_cast<double>(y) / extent.height),
                  sin_theta((y + 1.0) / extent.height));
}

/// First and second moment of 1/p(omega) over the bright texels. Under A and C the density over
/// (s,t) is constant in a texel and 1/p(omega) = 2 pi^2 sin(theta) / p(s,t); under B p(omega) is.
reference::EstimatorMoments inverse_pdf_moments(const Expectation& expectation,
                                                const Grid<double>& luminance) {
  if (expectation.lookup == Lookup::bilinear) {
    return reference::bilinear_inverse_pdf(
        luminance, expectation.density_space,
        [&](double radiance) { return expectation.is_bright(radiance); });
  }
  if (expectation.mapping.kind != MappingKind::lat_long) {
    return mapped_inverse_pdf_moments(expectation);
  }
  const Extent extent = expectation.masses.extent();
  const bool is_flat = expectation.positions() == MapMeasure::square;
  reference::EstimatorMoments moments;
  for (int y = 0; y < extent.height; ++y) {
    const double solid_angle = texel_solid_angle(extent, y);
    const double square = 4.0 * kPi * kPi * kPi * kPi * squared_sine_area(extent, y) /
                          static_cast<double>(extent.count());
    for (int x = 0; x < extent.width; ++x) {
      if (!expectation.is_bright(luminance(x, y))) continue;
      const double mass = expectation.masses(x, y);
      moments.raw[0] += solid_angle;
      const double flat =
          2.0 * kPi * kPi * largest_sine(extent, y) / static_cast<double>(extent.count());
      moments.largest = std::max(moments.largest, (is_flat ? flat : solid_angle) / mass);
      moments.raw[1] += is_flat ? square / mass : solid_angle * solid_angle / mass;
    }
  }
  return moments;
}

/// The moments of the estimators with a cosine kernel.
reference::LightMoments light_moments(const Expectation& expectation, const Grid<double>& luminance,
                                      Direction normal) {
  const reference::Kernel kernel = reference::cosine_kernel(normal);
  return expectation.lookup == Lookup::bilinear
             ? reference::bilinear_light_moments(kernel, luminance)
             : reference::light_moments(kernel, {&luminance, 1}, expectation.mapping)[0];
}

double mean_of(const TexelLuminance& luminance) {
  const Extent extent = luminance.extent();
  double sum = 0.0;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) sum += luminance(x, y);
  }
  return sum / static_cast<double>(extent.count());
}

void set_transform(Expectation& expectation, const EnvironmentMap& map, TargetDensity target) {
  if (target.lookup == Lookup::nearest) {
    const auto transform = std::make_shared<const reference::RosenblattTransform>(
        expectation.masses, expectation.positions());
    expectation.transform = [transform](std::span<const TexelSample> samples,
                                        std::span<const double> cosines,
                                        std::span<reference::RosenblattPoint> points) {
      for (std::size_t i = 0; i < samples.size(); ++i) {
        points[i] = (*transform)(samples[i].at, cosines[i], samples[i].x, samples[i].y);
      }
    };
    set_smooth_rows(expectation, expectation.rows);
    return;
  }
  // Shared: an expectation is copied, and this holds sums for every texel.
  const auto transform = std::make_shared<const reference::BilinearTransform>(map, target);
  expectation.transform = [transform](std::span<const TexelSample> samples,
                                      std::span<const double> /*cosines*/,
                                      std::span<reference::RosenblattPoint> points) {
    for (std::size_t i = 0; i < samples.size(); ++i) points[i] = (*transform)(samples[i].at);
  };
  set_smooth_rows(expectation, transform->rows());
  const MapMeasure measure = position_measure(target.density_space);
  expectation.density = [interpolated = reference::InterpolatedTexels(map, target),
                         total = transform->total(), measure](SquarePoint at) {
    const double weight = measure == MapMeasure::square ? 1.0 : sin_theta(at.t);
    return look_up_bilinear(interpolated, at) * weight / total;
  };
}

}  // namespace

const std::array<MeanCase, kMeanCaseCount> kMeanCases = {{
    {"irradiance, normal +z", {0.0, 0.0, 1.0}},
    {"irradiance, normal +x", {1.0, 0.0, 0.0}},
}};

Grid<double> Expectation::bins_of(const Grid<double>& texel_masses) const {
  if (shares) return shares->masses(texel_masses);
  return mapping.shift == 0.0
             ? reference::bin_masses(texel_masses, density_space, kGateBins)
             : reference::turned_bin_masses(texel_masses, mapping.shift, kGateBins);
}

void Expectation::set_flags() {
  const Extent extent = masses.extent();
  flags = Grid<std::uint8_t>(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const int of_mass = masses(x, y) > 0.0 ? has_mass : 0;
      const int of_radiance = is_bright(luminance(x, y)) ? counts_as_bright : 0;
      flags(x, y) = static_cast<std::uint8_t>(of_mass + of_radiance);
    }
  }
}

Extent Expectation::smooth_cells() const {
  const Extent texels = masses.extent();
  return lookup == Lookup::nearest ? texels : Extent{2 * texels.width, 2 * texels.height};
}

Expectation texel_expectation_of(const EnvironmentMap& map, TargetDensity target) {
  Expectation expectation;
  expectation.density_space = target.density_space;
  expectation.mapping = map.mapping;
  expectation.lookup = target.lookup;
  expectation.luminance = TexelLuminance(map, target.weights);
  expectation.masses = reference::texel_masses(map, target);
  expectation.rows = reference::row_marginal(expectation.masses);
  expectation.columns = reference::column_marginal(expectation.masses);
  set_transform(expectation, map, target);
  expectation.mean_luminance = mean_of(expectation.luminance);
  expectation.is_summed = true;
  expectation.set_flags();
  return expectation;
}

Expectation expectation_of(const EnvironmentMap& map, TargetDensity target) {
  Expectation expectation = texel_expectation_of(map, target);
  if (!is_plain(map.mapping) && expectation.positions() == MapMeasure::square) {
    expectation.shares =
        std::make_shared<const reference::BinShares>(map.mapping, map.radiance.extent(), kGateBins);
  }
  if (!is_plain(map.mapping) && map.radiance.extent().count() <= kMostKeptTexels) {
    expectation.parts = std::make_shared<const std::vector<reference::BinnedPart>>(
        reference::binned_parts(map.mapping, map.radiance.extent(), kGateBins));
  }
  expectation.bins = target.lookup == Lookup::bilinear
                         ? reference::bin_masses(map, target, kGateBins)
                         : expectation.bins_of(expectation.masses);
  const Grid<double> luminance = luminance_of(map, target.weights);
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    const auto moments = light_moments(expectation, luminance, kMeanCases[i].normal);
    expectation.estimators[i] = moments[reference::sampled_density(target.density_space)];
    expectation.uniform[i] = moments[reference::SampledDensity::uniform];
  }
  expectation.inverse_pdf = inverse_pdf_moments(expectation, luminance);
  return expectation;
}

std::shared_ptr<const Expectation> shared_expectation_of(std::shared_ptr<const EnvironmentMap> map,
                                                         TargetDensity target) {
  struct OnMap {
    std::shared_ptr<const EnvironmentMap> map;
    Expectation expectation;
  };
  Expectation expectation = expectation_of(*map, target);
  const auto both = std::make_shared<const OnMap>(std::move(map), std::move(expectation));
  return {both, &both->expectation};
}

void set_smooth_rows(Expectation& expectation, std::vector<double> masses) {
  expectation.smooth_rows = std::move(masses);
  expectation.bands = row_bands(expectation.smooth_rows);
  for (std::size_t band = 0; band < expectation.bands.size(); ++band) {
    const RowBand& rows = expectation.bands[band];
    expectation.band_of_row.insert(expectation.band_of_row.end(),
                                   static_cast<std::size_t>(rows.last - rows.first + 1),
                                   static_cast<std::uint8_t>(band));
  }
}

// A CDF entry that is rounded is off by a variance of 1/12, a share between two CDF entries of 1/6.
// So w^2 = sum (q-p)^2 / p has 1/6 sum 1/row from the marginal and, from each row's own sums, 1/6
// of row^2 sum 1/pool.
RoundingEffect rounding_effect(const Expectation& expectation, std::uint64_t samples) {
  if (!expectation.is_summed) return {};
  const double least = kPooledExpectation / static_cast<double>(samples);
  double of_rows = 0.0;
  double within_rows = 0.0;
  double row_pool = 0.0;
  for (int y = 0; y < expectation.masses.extent().height; ++y) {
    const double row = expectation.rows[static_cast<std::size_t>(y)];
    if (row <= 0.0) continue;
    row_pool += row;
    if (row_pool >= least) {
      of_rows += 1.0 / row_pool;
      row_pool = 0.0;
    }
    double pool = 0.0;
    for (const double mass : expectation.masses.row(y)) {
      pool += mass;
      if (pool < least) continue;
      within_rows += row * row / pool;
      pool = 0.0;
    }
  }
  return {std::sqrt((of_rows + within_rows) / 6.0), std::sqrt(of_rows / 6.0)};
}

}  // namespace lightproof
