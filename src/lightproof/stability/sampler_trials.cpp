#include "lightproof/stability/sampler_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "lightproof/core/random.h"
#include "lightproof/gate/density_check.h"
#include "lightproof/gate/exact_checks.h"
#include "lightproof/image/look_up.h"
#include "lightproof/image/texel_faults.h"
#include "lightproof/samplers/cdf_lines.h"
#include "lightproof/stability/hard_maps.h"
#include "lightproof/stability/sampler_on_map.h"

namespace lightproof {
namespace {

/// The ends of the random numbers' range, in steps of floats and of doubles, and the middle.
constexpr std::array<double, 6> kEnds = {0.0, 0x1p-60, 0x1p-24, 0.5, 1.0 - 0x1p-24, 1.0 - 0x1p-53};
constexpr double kLast = 1.0 - 0x1p-53;

std::vector<SquarePoint> pairs_of(std::span<const double> s, std::span<const double> t) {
  std::vector<SquarePoint> points;
  for (const double v : t) {
    for (const double u : s) points.push_back({u, v});
  }
  return points;
}

std::vector<SquarePoint> end_points() { return pairs_of(kEnds, kEnds); }

/// Points at the ends, beside the CDF entries, and at random.
std::vector<SquarePoint> hard_points(const SamplerOnMap& on_map, const TrialOptions& options) {
  std::vector<SquarePoint> points = edge_points(on_map.exact());
  const RandomStream stream("stability/points", options.seed);
  constexpr std::uint64_t kRandom = 4096;
  for (std::uint64_t i = 0; i < kRandom; ++i) points.push_back(stream.point(i));
  return points;
}

Finding not_claimed(std::string reason) {
  return {.outcome = StabilityOutcome::not_applicable, .came_out = std::move(reason)};
}

/// A map with values that no radiance can have. Those who claim something claim it of maps, which
/// have none: readers refuse the file.
Finding faulty_texel(const SamplerUnderTest& method, float value) {
  EnvironmentMap map = hard_maps::constant({8, 4});
  map.radiance(5, 2) = Rgb(value);
  if (!method.known_defects) {
    return not_claimed("no map: readers refuse it (" + describe_faults(scan_texels(map.radiance)) +
                       ")");
  }
  const BoundSampler sampler = method.bind(map);
  const std::vector<SquarePoint> points = pairs_of(kEnds, std::array{0.1, 0.3, 0.6, 0.9});
  std::vector<TexelSample> samples(points.size());
  sampler.sample(points, samples);
  Finding found = check_samples(points, samples, map.radiance.extent());
  for (int x = 0; x < 8 && found.outcome == StabilityOutcome::right; ++x) {
    for (int y = 0; y < 4; ++y) {
      const double density = sampler.pdf({(x + 0.5) / 8, (y + 0.5) / 4}).value;
      if (density >= 0.0) continue;
      found = {.outcome = StabilityOutcome::wrong,
               .amount = -density,
               .came_out = fmt::format("density {:.4g} at texel ({}, {})", density, x, y)};
    }
  }
  return found;
}

/// Drawn at all hard points, and its density.
Finding check_all(const SamplerOnMap& on_map, const TrialOptions& options) {
  return worse_of(check_drawn(on_map, hard_points(on_map, options)), check_density(on_map));
}

/// The largest relative difference of two densities over the square, at every cell of the first
/// sampler's map; `other` gives the position of the second one.
template <class Other>
Finding compare_densities(const SamplerOnMap& one, const SamplerOnMap& two, double bound,
                          const Other& other) {
  const Extent cells = one.exact().smooth_cells();
  Finding found{.bound = bound};
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      const SquarePoint at = {(x + 0.5) / cells.width, (y + 0.25) / cells.height};
      const double a = one.sampler().pdf(at).value;
      const double b = two.sampler().pdf(other(at)).value;
      const double off = a == b ? 0.0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b));
      if (off <= found.amount) continue;
      found.amount = off;
      found.came_out =
          fmt::format("densities {:.6g} and {:.6g} at ({:.4g}, {:.4g})", a, b, at.s, at.t);
      if (off > bound) found.outcome = StabilityOutcome::wrong;
      if (std::isnan(off)) return {StabilityOutcome::not_a_number, off, bound, "", found.came_out};
    }
  }
  return found;
}

/// How far apart two densities of maps whose radiance lies between 1 and 2 may be: each is off by
/// the rounding that the sampler declares, of whose terms the row has at most twice W, the share of
/// the row 4 H, the run 64 and the average 2 times the texel's probability; and by floats.
double twice_rounding(const SamplerOnMap& on_map) {
  const MassRounding& r = on_map.rounding();
  const auto [width, height] = on_map.extent();
  return 2.0 * (r.relative + r.of_sums * (2.0 * width + 4.0 * height) + 64.0 * r.of_run +
                2.0 * r.of_average) +
         2e-5;
}

constexpr Extent kSmall = {32, 16};

/// The share of the light of a map, by the other look-up than the sampler's own, at which the
/// sampler's density is 0. Exact: by either look-up light and density are linear inside half
/// texels, and 0 at the middle only if they are 0 throughout.
double lost_by_other_filter(const SamplerOnMap& on_map) {
  const auto [width, height] = on_map.extent();
  const Lookup other =
      on_map.exact().lookup == Lookup::nearest ? Lookup::bilinear : Lookup::nearest;
  double all = 0.0;
  double lost = 0.0;
  for (int y = 0; y < 2 * height; ++y) {
    for (int x = 0; x < 2 * width; ++x) {
      const SquarePoint at = {(x + 0.5) / (2.0 * width), (y + 0.5) / (2.0 * height)};
      const double light = look_up(on_map.exact().luminance, other, at);
      all += light;
      if (!(on_map.sampler().pdf(at).value > 0.0)) lost += light;
    }
  }
  return lost / all;
}

template <class Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

}  // namespace

namespace trials {

Finding one_bright_texel(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  constexpr Extent kExtent = {8, 4};
  Finding found;
  for (int y = 0; y < kExtent.height; ++y) {
    for (int x = 0; x < kExtent.width; ++x) {
      const SamplerOnMap on_map(method, hard_maps::one_texel(kExtent, x, y, 1000.0F));
      // A random number of 0 has a case of its own.
      constexpr std::array kInside = {0x1p-24, 0.3, 0.5, 0.9, 1.0 - 0x1p-24};
      const auto drawn = check_drawn(on_map, pairs_of(kInside, kInside));
      Finding here = worse_of(drawn, check_density(on_map));
      if (here.outcome != StabilityOutcome::right && found.outcome == StabilityOutcome::right) {
        here.put_in = fmt::format("one texel at ({}, {}) of {}x{}; {}", x, y, kExtent.width,
                                  kExtent.height, here.put_in);
      }
      found = worse_of(found, here);
    }
  }
  if (found.outcome == StabilityOutcome::right) {
    found.put_in = "one texel of 8x4, at each of 32 positions";
    found.came_out = fmt::format("drawn every time; density at most {:.2g} off", found.amount);
  }
  return found;
}

Finding own_filter(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  const SamplerOnMap on_map(method, hard_maps::one_texel(kSmall, 5, 7));
  Finding found = check_density(on_map);
  const bool is_nearest = on_map.exact().lookup == Lookup::nearest;
  found.put_in =
      fmt::format("one texel in black, looked up {}", is_nearest ? "nearest" : "bilinear");
  found.came_out += fmt::format("; a renderer that looks up {} would lose {:.2f} % of its light",
                                is_nearest ? "bilinearly" : "the nearest texel",
                                100.0 * lost_by_other_filter(on_map));
  return found;
}

Finding black_map(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  const EnvironmentMap map = hard_maps::constant({8, 4}, 0.0F);
  const BoundSampler sampler = method.bind(map);
  const std::vector<SquarePoint> points = end_points();
  std::vector<TexelSample> samples(points.size());
  sampler.sample(points, samples);
  return check_samples(points, samples, map.radiance.extent());
}

Finding nan_texel(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  return faulty_texel(method, std::nanf(""));
}

Finding infinite_texel(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  return faulty_texel(method, HUGE_VALF);
}

Finding negative_texel(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  return faulty_texel(method, -20.0F);
}

Finding constant_map(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  const SamplerOnMap on_map(method, hard_maps::constant(kSmall));
  Finding found = check_density(on_map);
  if (found.outcome != StabilityOutcome::right) return found;
  // Exactly 1 by a density that lies in whole texels; one that follows the sine inside of them is
  // integrated to 1e-10.
  const double integral = integrate_pdf(on_map.sampler(), kSmall).integral;
  // Of the weight f/p of one radiance everywhere.
  const DensityComparison density =
      compare_density(on_map.sampler(), on_map.exact(), on_map.rounding());
  const double bound = twice_rounding(on_map);
  found.amount = std::max(std::abs(integral - 1.0), std::sqrt(density.rounding_variance));
  found.bound = bound;
  found.came_out = fmt::format(
      "integral of the density 1 {:+.2g}, weights' standard deviation "
      "{:.2g} of their mean",
      integral - 1.0, std::sqrt(density.rounding_variance));
  if (!(found.amount <= bound)) found.outcome = StabilityOutcome::wrong;
  return found;
}

Finding leading_zeros_at_zero(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  EnvironmentMap map = hard_maps::constant(kSmall);
  for (int y = 0; y < kSmall.height; ++y) {
    for (int x = 0; x < kSmall.width; ++x) {
      if (y < 3 || x < 5) map.radiance(x, y) = Rgb(0.0F);
    }
  }
  const SamplerOnMap on_map(method, std::move(map));
  constexpr std::array kZero = {0.0};
  Finding found = check_drawn(on_map, pairs_of(kZero, kZero));
  found = worse_of(found, check_drawn(on_map, pairs_of(kZero, kEnds)));
  return worse_of(found, check_drawn(on_map, pairs_of(kEnds, kZero)));
}

Finding numbers_next_to_one(const SamplerUnderTest& method, const TrialOptions& options) {
  constexpr std::array kNumbers = {1.0 - 0x1p-24, kLast, 1.0};
  constexpr std::array kOthers = {0.25, 0.5, 1.0 - 0x1p-24, kLast, 1.0};
  Finding found;
  // Sums of equal powers of two reach 1 exactly; others are rounded at every step.
  const SamplerOnMap even(method, hard_maps::constant(kSmall));
  found = worse_of(check_drawn(even, pairs_of(kNumbers, kOthers)),
                   check_drawn(even, pairs_of(kOthers, kNumbers)));
  for (const Extent extent : {Extent{32, 16}, Extent{33, 17}, Extent{1000, 3}}) {
    const SamplerOnMap on_map(method, hard_maps::lognormal(extent, 1.0, options.seed));
    found = worse_of(found, check_drawn(on_map, pairs_of(kNumbers, kOthers)));
    found = worse_of(found, check_drawn(on_map, pairs_of(kOthers, kNumbers)));
  }
  return found;
}

Finding zero_row_inside(const SamplerUnderTest& method, const TrialOptions& options) {
  EnvironmentMap map = hard_maps::constant(kSmall);
  for (int x = 0; x < kSmall.width; ++x) map.radiance(x, 7) = Rgb(0.0F);
  return check_all(SamplerOnMap(method, std::move(map)), options);
}

Finding trailing_zeros(const SamplerUnderTest& method, const TrialOptions& options) {
  EnvironmentMap map = hard_maps::lognormal({100, 16}, 1.0, options.seed);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 100; ++x) {
      if (y >= 13 || x >= 95) map.radiance(x, y) = Rgb(0.0F);
    }
  }
  const SamplerOnMap on_map(method, std::move(map));
  // Not at 0, which has a case of its own.
  std::vector<SquarePoint> points = hard_points(on_map, options);
  std::erase_if(points, [](SquarePoint u) { return u.s <= 0.0 || u.t <= 0.0; });
  return worse_of(check_drawn(on_map, points), check_density(on_map));
}

Finding wide_constant_map(const SamplerUnderTest& method, const TrialOptions& options) {
  const Extent extent = Extent{options.thorough ? 16384 : 8192, 2};
  const SamplerOnMap on_map(method, hard_maps::constant(extent));
  Finding found = check_density(on_map);
  if (found.outcome != StabilityOutcome::right) return found;
  // The middles of all texels; of all texels counted row by row; and of 32 texels each of all runs
  // counted so: by one of them every texel of a constant map is drawn, whatever the numbers choose.
  const auto texels = static_cast<double>(extent.count());
  std::vector<SquarePoint> points;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const double index = static_cast<double>(y) * extent.width + x;
      points.push_back({(x + 0.5) / extent.width, (y + 0.5) / extent.height});
      points.push_back({(index + 0.5) / texels, 0.5});
      points.push_back({(std::floor(index / kRunTexels) + 0.5) * kRunTexels / texels,
                        (std::fmod(index, kRunTexels) + 0.5) / kRunTexels});
    }
  }
  std::vector<bool> reached(extent.count(), false);
  for (const TexelSample& sample : on_map.at(points)) {
    if (!is_inside(sample, extent)) continue;
    reached[static_cast<std::size_t>(sample.y) * static_cast<std::size_t>(extent.width) +
            static_cast<std::size_t>(sample.x)] = true;
  }
  const auto missed = std::count(reached.begin(), reached.end(), false);
  found.put_in = fmt::format("a constant map of {}x{}", extent.width, extent.height);
  found.amount = static_cast<double>(missed) / static_cast<double>(extent.count());
  if (missed > 0) found.outcome = StabilityOutcome::wrong;
  found.came_out = fmt::format("{} of {} texels never drawn", missed, extent.count());
  return found;
}

Finding sun_over_sky(const SamplerUnderTest& method, const TrialOptions& options) {
  const Extent extent = {options.thorough ? 8192 : 1024, 2};
  Finding found{.bound = 1e-3};
  for (const float sun : {1e5F, 1e6F, 1e7F, 1e8F, 1e9F}) {
    EnvironmentMap map = hard_maps::constant(extent);
    map.radiance(extent.width / 2, 0) = Rgb(sun);
    const SamplerOnMap on_map(method, std::move(map));
    const double lost = lost_sky(method, on_map);
    if (lost <= found.amount) continue;
    found.amount = lost;
    found.put_in =
        fmt::format("a sun of {:g} over a sky of 1, {}x{}", sun, extent.width, extent.height);
    found.came_out = fmt::format("{:.3g} % of the sky is never drawn", 100.0 * lost);
    if (lost > found.bound) found.outcome = StabilityOutcome::wrong;
  }
  if (found.amount == 0.0) found.came_out = "no texel of the sky is lost under any sun";
  return found;
}

Finding pole_rows(const SamplerUnderTest& method, const TrialOptions& options) {
  Finding found;
  for (const int row : {0, kSmall.height - 1}) {
    EnvironmentMap map = hard_maps::constant(kSmall, 0.0F);
    for (int x = 0; x < kSmall.width; ++x) map.radiance(x, row) = Rgb(1.0F);
    const SamplerOnMap on_map(method, std::move(map));
    std::vector<SquarePoint> points = hard_points(on_map, options);
    std::erase_if(points, [](SquarePoint u) { return u.s <= 0.0 || u.t <= 0.0; });
    found = worse_of(found, worse_of(check_drawn(on_map, points), check_density(on_map)));
  }
  return found;
}

Finding exact_poles(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  const SamplerOnMap on_map(method, hard_maps::constant(kSmall));
  Finding found{.came_out = "finite at and beside both poles"};
  for (const double s : {0.0, 0.3, kLast}) {
    for (const double t : {0.0, kLast, 1.0}) {
      const double density = on_map.sampler().pdf({s, t}).value;
      if (std::isfinite(density) && density >= 0.0) continue;
      return {.outcome = StabilityOutcome::not_a_number,
              .put_in = fmt::format("(s, t) = ({:.3g}, {:.17g})", s, t),
              .came_out = fmt::format("density {}", density)};
    }
  }
  const std::vector<SquarePoint> points = end_points();
  const std::vector<TexelSample> samples = on_map.at(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double density = to_solid_angle(samples[i].pdf, samples[i].at).value;
    if (std::isfinite(density)) continue;
    return {
        .outcome = StabilityOutcome::not_a_number,
        .put_in = point_text(points[i]),
        .came_out = fmt::format("{}: density {} per steradian", sample_text(samples[i]), density)};
  }
  return found;
}

Finding round_trip(const SamplerUnderTest& method, const TrialOptions& options) {
  const SamplerOnMap on_map(method, hard_maps::lognormal(kSmall, 1.0, options.seed));
  const std::vector<SquarePoint> points = hard_points(on_map, options);
  const std::vector<TexelSample> samples = on_map.at(points);
  Finding found{.bound = 1e-4};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_inside(samples[i], on_map.extent())) continue;  // cases of their own
    const double asked = on_map.sampler().pdf(samples[i].at).value;
    const double off = std::abs(asked / samples[i].pdf.value - 1.0);
    if (off <= found.amount) continue;
    found.amount = off;
    found.put_in = point_text(points[i]);
    found.came_out = fmt::format("{}; asked for it: {:.6g}", sample_text(samples[i]), asked);
    if (!(off <= found.bound)) found.outcome = StabilityOutcome::wrong;
  }
  return found;
}

Finding inside_the_texel(const SamplerUnderTest& method, const TrialOptions& options) {
  const SamplerOnMap on_map(method, hard_maps::lognormal({512, 4}, 1.0, options.seed));
  const auto [width, height] = on_map.extent();
  std::vector<SquarePoint> points = hard_points(on_map, options);
  std::erase_if(points, [](SquarePoint u) { return u.s <= 0.0 || u.t <= 0.0; });
  const std::vector<TexelSample> samples = on_map.at(points);
  SampleTally tally(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TexelSample& sample = samples[i];
    if (!is_inside(sample, on_map.extent())) continue;  // cases of their own
    const bool stays =
        cell_of(sample.at.s, width) == sample.x && cell_of(sample.at.t, height) == sample.y;
    if (!stays) tally.add(StabilityOutcome::wrong, i, sample, "a position in another texel");
  }
  return std::move(tally).finding();
}

Finding seam(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  const auto lit_column = [&](int column) {
    EnvironmentMap map = hard_maps::constant(kSmall, 0.0F);
    for (int y = 0; y < kSmall.height; ++y) {
      map.radiance(column, y) = Rgb(1.0F + static_cast<float>(y) / kSmall.height);
    }
    return map;
  };
  const SamplerOnMap first(method, lit_column(0));
  const SamplerOnMap last(method, lit_column(kSmall.width - 1));
  Finding found = compare_densities(first, last, twice_rounding(first), [](SquarePoint at) {
    return SquarePoint{1.0 - at.s, at.t};
  });
  constexpr std::array kInside = {0x1p-24, 0.3, 0.7, 1.0 - 0x1p-24};
  for (const SamplerOnMap* on_map : {&first, &last}) {
    found = worse_of(found, check_drawn(*on_map, pairs_of(kInside, kInside)));
    if (on_map->exact().lookup == Lookup::nearest) continue;
    const double left = on_map->sampler().pdf({0.0, 0.4}).value;
    const double right = on_map->sampler().pdf({kLast, 0.4}).value;
    const double jump = std::abs(left - right) / std::max(left, right);
    if (!(jump <= 1e-6)) {
      found = worse_of(found, {StabilityOutcome::wrong, jump, 1e-6, "the density at the seam",
                               fmt::format("{:.6g} and {:.6g}", left, right)});
    }
  }
  return found;
}

Finding exposure(const SamplerUnderTest& method, const TrialOptions& options) {
  const EnvironmentMap map = hard_maps::lognormal(kSmall, 1.0, options.seed);
  const SamplerOnMap as_it_is(method, map);
  Finding found;
  for (const float factor : {1e9F, 1e-9F}) {
    const SamplerOnMap other(method, hard_maps::scaled(map, factor));
    // Radiances are rounded to floats anew. Whole numbers of masses may then be rounded otherwise.
    const double bound = 4.0 * twice_rounding(as_it_is);
    found = worse_of(found,
                     compare_densities(as_it_is, other, bound, [](SquarePoint at) { return at; }));
  }
  return found;
}

Finding rotation(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  const EnvironmentMap map = hard_maps::orientation(kSmall);
  constexpr int kColumns = 5;
  const SamplerOnMap one(method, map);
  const SamplerOnMap two(method, hard_maps::turned(map, kColumns));
  return compare_densities(one, two, twice_rounding(one), [](SquarePoint at) {
    const double s = at.s + static_cast<double>(kColumns) / kSmall.width;
    return SquarePoint{s >= 1.0 ? s - 1.0 : s, at.t};
  });
}

Finding orientation(const SamplerUnderTest& method, const TrialOptions& options) {
  const SamplerOnMap on_map(method, hard_maps::orientation(kSmall));
  Finding found = check_density(on_map);
  // What is drawn, in quarters of the map, against what is declared: within four standard errors.
  constexpr std::uint64_t kPoints = 1 << 16;
  const RandomStream stream("stability/orientation", options.seed);
  std::vector<SquarePoint> points;
  for (std::uint64_t i = 0; i < kPoints; ++i) points.push_back(stream.point(i));
  std::array<double, 4> drawn{};
  std::array<double, 4> declared{};
  const auto quarter = [](int x, int y) {
    return static_cast<std::size_t>((2 * y >= kSmall.height ? 2 : 0) +
                                    (2 * x >= kSmall.width ? 1 : 0));
  };
  for (const TexelSample& sample : on_map.at(points)) {
    if (!is_inside(sample, kSmall)) continue;
    drawn[quarter(cell_of(sample.at.s, kSmall.width), cell_of(sample.at.t, kSmall.height))] += 1.0;
  }
  for (int y = 0; y < kSmall.height; ++y) {
    for (int x = 0; x < kSmall.width; ++x) declared[quarter(x, y)] += on_map.exact().masses(x, y);
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double expected = declared[i];
    const double error = std::sqrt(expected * (1.0 - expected) / kPoints);
    const double off = std::abs(drawn[i] / kPoints - expected) / error;
    if (off <= 5.0) continue;
    found = worse_of(found, {StabilityOutcome::wrong, off, 5.0, "four quarters of different grey",
                             fmt::format("{:.4g} of all samples in quarter {} for {:.4g}",
                                         drawn[i] / kPoints, i, expected)});
  }
  return found;
}

Finding odd_sizes(const SamplerUnderTest& method, const TrialOptions& options) {
  Finding found;
  for (const Extent extent : {Extent{1, 1}, Extent{1, 7}, Extent{7, 1}, Extent{2, 1}, Extent{1, 2},
                              Extent{3, 5}, Extent{33, 17}}) {
    const SamplerOnMap on_map(method, hard_maps::lognormal(extent, 1.0, options.seed));
    std::vector<SquarePoint> points = hard_points(on_map, options);
    // Where nothing is black, only numbers next to 1 are hard, and have a case of their own.
    std::erase_if(points, [](SquarePoint u) { return std::max(u.s, u.t) >= 1.0 - 0x1p-20; });
    Finding here = worse_of(check_drawn(on_map, points), check_density(on_map));
    here.put_in = fmt::format("a map of {}x{}; {}", extent.width, extent.height, here.put_in);
    found = worse_of(found, here);
  }
  return found;
}

Finding pure_colours(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  return check_density(SamplerOnMap(method, hard_maps::pure_colours({30, 16})));
}

Finding denormal_map(const SamplerUnderTest& method, const TrialOptions& /*options*/) {
  const SamplerOnMap on_map(method, hard_maps::constant(kSmall, 1e-39F));
  return worse_of(check_drawn(on_map, end_points()), check_density(on_map));
}

Finding rebuilt_probabilities(const SamplerUnderTest& method, const TrialOptions& options) {
  const SamplerOnMap on_map(method, hard_maps::lognormal({64, 32}, 2.0, options.seed));
  Finding found = check_density(on_map);
  const double integral = integrate_pdf(on_map.sampler(), on_map.extent()).integral;
  if (found.outcome == StabilityOutcome::right && !(std::abs(integral - 1.0) <= 1e-6)) {
    found = {StabilityOutcome::wrong, std::abs(integral - 1.0), 1e-6, "",
             fmt::format("probabilities sum to 1 {:+.3g}", integral - 1.0)};
  }
  return found;
}

Finding two_maps(const SamplerUnderTest& method, const TrialOptions& options) {
  const EnvironmentMap large = hard_maps::lognormal({64, 32}, 1.0, options.seed);
  const EnvironmentMap small = hard_maps::lognormal({33, 17}, 1.0, options.seed + 1);
  const SamplerOnMap first(method, large);
  std::vector<SquarePoint> points;
  const RandomStream stream("stability/two-maps", options.seed);
  for (std::uint64_t i = 0; i < 1024; ++i) points.push_back(stream.point(i));
  const std::vector<TexelSample> before = first.at(points);
  const SamplerOnMap other(method, small);
  const Finding on_other = check_density(other);
  const bool same = same_bits(before, first.at(points)) &&
                    same_bits(before, SamplerOnMap(method, large).at(points));
  Finding found{.put_in = "a map of 64x32, then one of 33x17, then the first again",
                .came_out = "the same bits before and after"};
  if (!same) {
    found.outcome = StabilityOutcome::wrong;
    found.came_out = "other samples than before the second map";
  }
  return worse_of(found, on_other);
}

}  // namespace trials
}  // namespace lightproof
