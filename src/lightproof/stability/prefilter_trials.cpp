#include "lightproof/stability/prefilter_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lightproof/prefilter/specular_chain.h"
#include "lightproof/stability/hard_maps.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr Extent kMap = {64, 32};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Grid<Rgb> prefiltered(const PrefilterMethodInfo& method, const Grid<Rgb>& map, Extent extent,
                      double roughness) {
  const PrefilteredLevel level = {ggx_lobe(roughness), extent};
  return std::move(prefilter(map, {&level, 1}, {.method = method.method}).front());
}

bool all_finite(const Grid<Rgb>& grid) {
  return std::ranges::all_of(grid.values(), [](Rgb v) {
    return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b) && v.r >= 0.0F &&
           v.g >= 0.0F && v.b >= 0.0F;
  });
}

Finding not_finite(std::string put_in) {
  return {.outcome = StabilityOutcome::not_a_number,
          .put_in = std::move(put_in),
          .came_out = "a value that is negative or not finite"};
}

float largest_of(const Grid<Rgb>& grid) {
  float largest = 0.0F;
  for (const Rgb v : grid.values()) largest = std::max({largest, v.r, v.g, v.b});
  return largest;
}

/// The largest difference of two grids of one size, relative to the largest value; `other` gives
/// the texel of the second one.
template <class Other>
double difference(const Grid<Rgb>& a, const Grid<Rgb>& b, const Other& other) {
  double largest = 0.0;
  for (int y = 0; y < a.extent().height; ++y) {
    for (int x = 0; x < a.extent().width; ++x) {
      const auto [i, j] = other(x, y);
      const Rgb off = glm::abs(a(x, y) - b(i, j));
      largest = std::max({largest, static_cast<double>(off.r), static_cast<double>(off.g),
                          static_cast<double>(off.b)});
    }
  }
  return largest / std::max(1e-30, static_cast<double>(largest_of(a)));
}

Finding judged(double amount, double bound, std::string put_in, std::string came_out) {
  Finding found{StabilityOutcome::right, amount, bound, std::move(put_in), std::move(came_out)};
  if (std::isnan(amount)) {
    found.outcome = StabilityOutcome::not_a_number;
  } else if (!(amount <= bound)) {
    found.outcome = StabilityOutcome::wrong;
  }
  return found;
}

/// The mean of a map over the sphere, of its red channel.
double mean_over_sphere(const Grid<Rgb>& map) {
  const Extent extent = map.extent();
  double sum = 0.0;
  for (int y = 0; y < extent.height; ++y) {
    const double solid_angle = texel_solid_angle(extent, y);
    for (int x = 0; x < extent.width; ++x) sum += static_cast<double>(map(x, y).r) * solid_angle;
  }
  return sum / kSphere;
}

/// Roundings of floats, of values and of what they are computed from.
constexpr double kFloats = 1e-5;

}  // namespace

double white_furnace_error(const PrefilterMethodInfo& method, double roughness) {
  const Grid<Rgb> level =
      prefiltered(method, hard_maps::constant(kMap).radiance, {16, 8}, roughness);
  if (!all_finite(level)) return kNaN;
  double largest = 0.0;
  for (const Rgb v : level.values()) {
    largest = std::max(largest, std::abs(static_cast<double>(v.r) - 1.0));
  }
  return largest;
}

double energy_error(const PrefilterMethodInfo& method, float sun, Extent output) {
  EnvironmentMap map = hard_maps::constant(kMap);
  map.radiance(40, 20) = Rgb(sun);
  // A lobe of half a radian, so that a sum over texels of a tenth is as good as an integral.
  const Grid<Rgb> level = prefiltered(method, map.radiance, output, 0.7);
  if (!all_finite(level)) return kNaN;
  return std::abs(mean_over_sphere(level) / mean_over_sphere(map.radiance) - 1.0);
}

std::string_view fault_of(const ScaleBias& entry) {
  if (!std::isfinite(entry.scale) || !std::isfinite(entry.bias)) return "not finite";
  // A sum over 1024 points, which the least rough surface shifts by one at most, may err beyond 1.
  constexpr double kAbove = 1.0 + 1.0 / 1024.0;
  if (entry.scale < 0.0 || entry.bias < 0.0 || entry.scale + entry.bias > kAbove) {
    return "not in [0, 1]";
  }
  return {};
}

namespace trials {

Finding black_map(const PrefilterMethodInfo& method, const TrialOptions& /*options*/) {
  const Grid<Rgb> black = hard_maps::constant(kMap, 0.0F).radiance;
  for (const double roughness : {0.0, 0.3, 1.0}) {
    const Grid<Rgb> level = prefiltered(method, black, {16, 8}, roughness);
    if (!all_finite(level)) return not_finite(fmt::format("black, roughness {:g}", roughness));
    const double largest = static_cast<double>(largest_of(level));
    if (largest > 0.0) return judged(largest, 0.0, "black", "light");
  }
  return {.came_out = "black"};
}

Finding seam(const PrefilterMethodInfo& method, const TrialOptions& /*options*/) {
  const auto lit_column = [](int column) {
    EnvironmentMap map = hard_maps::constant(kMap, 0.0F);
    for (int y = 0; y < kMap.height; ++y) map.radiance(column, y) = Rgb(1.0F);
    return map;
  };
  const Extent extent = {32, 16};
  const Grid<Rgb> first = prefiltered(method, lit_column(0).radiance, extent, 0.5);
  const Grid<Rgb> last = prefiltered(method, lit_column(kMap.width - 1).radiance, extent, 0.5);
  const double off =
      difference(first, last, [&](int x, int y) { return std::pair(extent.width - 1 - x, y); });
  return judged(off, kFloats, "column 0 lit, then the last one",
                fmt::format("mirrored to {:.2g} of the brightest value", off));
}

Finding exposure(const PrefilterMethodInfo& method, const TrialOptions& options) {
  const EnvironmentMap map = hard_maps::lognormal(kMap, 1.0, options.seed);
  double worst = 0.0;
  const Grid<Rgb> plain = prefiltered(method, map.radiance, {16, 8}, 0.4);
  for (const float factor : {1e9F, 1e-9F}) {
    Grid<Rgb> other = prefiltered(method, hard_maps::scaled(map, factor).radiance, {16, 8}, 0.4);
    for (Rgb& v : other.values()) v /= factor;
    worst = std::max(worst, difference(plain, other, [](int x, int y) { return std::pair(x, y); }));
  }
  return judged(worst, kFloats, "radiances times 1e9 and 1e-9",
                fmt::format("the same to {:.2g} of the brightest value", worst));
}

Finding rotation(const PrefilterMethodInfo& method, const TrialOptions& options) {
  const EnvironmentMap map = hard_maps::lognormal(kMap, 1.0, options.seed);
  const Grid<Rgb> one = prefiltered(method, map.radiance, {32, 16}, 0.4);
  const Grid<Rgb> two = prefiltered(method, hard_maps::turned(map, 10).radiance, {32, 16}, 0.4);
  const double off = difference(one, two, [](int x, int y) { return std::pair((x + 5) % 32, y); });
  return judged(off, kFloats, "the map turned by 10 of 64 columns",
                fmt::format("turned with it to {:.2g} of the brightest value", off));
}

Finding orientation(const PrefilterMethodInfo& method, const TrialOptions& /*options*/) {
  const Grid<Rgb> level = prefiltered(method, hard_maps::orientation(kMap).radiance, {16, 8}, 0.3);
  std::array<double, 4> quarters{};
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      quarters[static_cast<std::size_t>((y >= 4 ? 2 : 0) + (x >= 8 ? 1 : 0))] +=
          static_cast<double>(level(x, y).r) / 32.0;
    }
  }
  // The greys of the quarters rise in this order by steps of a quarter, of which blur leaves most.
  constexpr double kLeastStep = 0.1;
  for (std::size_t i = 1; i < quarters.size(); ++i) {
    const double step = quarters[i] - quarters[i - 1];
    if (step < kLeastStep) {
      return judged(kLeastStep - step, 0.0, "four quarters of different grey",
                    fmt::format("quarters {:.3g}, {:.3g}, {:.3g}, {:.3g}", quarters[0], quarters[1],
                                quarters[2], quarters[3]));
    }
  }
  return {.came_out = "the quarters in their order"};
}

Finding white_furnace(const PrefilterMethodInfo& method, const TrialOptions& /*options*/) {
  double worst = 0.0;
  double where = 0.0;
  for (const double roughness : {0.0, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0}) {
    const double off = white_furnace_error(method, roughness);
    if (off <= worst) continue;
    worst = off;
    where = roughness;
    if (std::isnan(off)) break;
  }
  return judged(worst, 1e-3, fmt::format("white, roughness {:g} the worst of 0 to 1", where),
                fmt::format("1 to {:.2g}", worst));
}

Finding roughness_zero(const PrefilterMethodInfo& method, const TrialOptions& options) {
  const Grid<Rgb> map = hard_maps::lognormal(kMap, 1.0, options.seed).radiance;
  const double off = difference(map, prefiltered(method, map, kMap, 0.0),
                                [](int x, int y) { return std::pair(x, y); });
  return judged(off, kFloats, "roughness 0 at the size of the map",
                fmt::format("the map itself to {:.2g}", off));
}

Finding little_roughness(const PrefilterMethodInfo& method, const TrialOptions& /*options*/) {
  const EnvironmentMap map = hard_maps::one_texel(kMap, 40, 20);
  double before = HUGE_VAL;
  for (const double roughness : {1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0}) {
    const Grid<Rgb> level = prefiltered(method, map.radiance, kMap, roughness);
    if (!all_finite(level)) return not_finite(fmt::format("one texel, roughness {:g}", roughness));
    const auto peak = static_cast<double>(level(40, 20).r);
    // Of 1024 samples one more or less falls into the texel.
    if (peak > before + 2e-3) {
      return judged(peak - before, 2e-3, fmt::format("one texel, roughness {:g}", roughness),
                    fmt::format("{:.4g} in the lit texel, {:.4g} before", peak, before));
    }
    if (roughness < 0.02 && !(peak > 0.0)) {
      return judged(1.0, 0.0, fmt::format("one texel, roughness {:g}", roughness),
                    "black where the mirror shows the lit texel");
    }
    before = peak;
  }
  return {.came_out = "the rougher, the darker the lit texel, at every step"};
}

Finding sun_energy(const PrefilterMethodInfo& method, const TrialOptions& /*options*/) {
  const double off = energy_error(method, 1e5F, {128, 64});
  return judged(off, 1e-3, "a sun of 1e5 in one texel of 64x32 over a sky of 1, roughness 0.7",
                fmt::format("light over the sphere off by {:.2g}", off));
}

Finding output_sizes(const PrefilterMethodInfo& method, const TrialOptions& options) {
  const Grid<Rgb> map = hard_maps::lognormal(kMap, 1.0, options.seed).radiance;
  // The exponent of the cosine: what is prefiltered is irradiance, over pi.
  const auto level_of = [&](int width) {
    const PrefilteredLevel level = {PhongLobe{1.0}, {width, width / 2}};
    return std::move(prefilter(map, {&level, 1}, {.method = method.method}).front());
  };
  // The centre of a texel is that of the middle one of 3 x 3, 5 x 5, … smaller ones.
  const Grid<Rgb> smallest = level_of(32);
  double worst = 0.0;
  for (const int factor : {3, options.thorough ? 15 : 5}) {
    worst = std::max(worst, difference(smallest, level_of(32 * factor), [&](int x, int y) {
                       return std::pair(factor * x + factor / 2, factor * y + factor / 2);
                     }));
  }
  return judged(worst, 1e-4, "irradiance at 32x16 and at 3 times and more of that",
                fmt::format("the same to {:.2g} of the brightest value", worst));
}

Finding odd_sizes(const PrefilterMethodInfo& method, const TrialOptions& /*options*/) {
  double worst = 0.0;
  std::string where;
  for (const Extent map :
       {Extent{1, 1}, Extent{1, 7}, Extent{7, 1}, Extent{2, 1}, Extent{33, 17}}) {
    for (const Extent level : {Extent{1, 1}, Extent{5, 3}}) {
      const Grid<Rgb> found = prefiltered(method, hard_maps::constant(map).radiance, level, 0.5);
      if (!all_finite(found)) return not_finite(fmt::format("{}x{}", map.width, map.height));
      for (const Rgb v : found.values()) {
        const double off = std::abs(static_cast<double>(v.r) - 1.0);
        if (off <= worst) continue;
        worst = off;
        where = fmt::format("a white map of {}x{} at {}x{}", map.width, map.height, level.width,
                            level.height);
      }
    }
  }
  return judged(worst, 1e-3, where, fmt::format("1 to {:.2g}", worst));
}

Finding pure_colours(const PrefilterMethodInfo& method, const TrialOptions& options) {
  const EnvironmentMap grey = hard_maps::lognormal(kMap, 1.0, options.seed);
  const Grid<Rgb> all = prefiltered(method, grey.radiance, {16, 8}, 0.4);
  for (int channel = 0; channel < 3; ++channel) {
    EnvironmentMap pure = grey;
    for (Rgb& v : pure.radiance.values()) {
      for (int other = 0; other < 3; ++other) v[other] = other == channel ? v[other] : 0.0F;
    }
    const Grid<Rgb> one = prefiltered(method, pure.radiance, {16, 8}, 0.4);
    for (std::size_t i = 0; i < one.values().size(); ++i) {
      for (int other = 0; other < 3; ++other) {
        const float expected = other == channel ? all.values()[i][other] : 0.0F;
        const auto off = static_cast<double>(std::abs(one.values()[i][other] - expected));
        if (off <= kFloats * static_cast<double>(largest_of(all))) continue;
        return judged(off, 0.0, fmt::format("pure channel {}", channel),
                      fmt::format("{:.4g} in channel {}, {:.4g} expected", one.values()[i][other],
                                  other, expected));
      }
    }
  }
  return {.came_out = "each channel as of a grey map, the others black"};
}

Finding denormal_map(const PrefilterMethodInfo& method, const TrialOptions& /*options*/) {
  const Grid<Rgb> level =
      prefiltered(method, hard_maps::constant(kMap, 1e-39F).radiance, {16, 8}, 0.4);
  if (!all_finite(level)) return not_finite("1e-39 everywhere");
  // As black, or as it is; denormal numbers have few digits.
  const auto largest = static_cast<double>(largest_of(level));
  return judged(largest, 2e-39, "1e-39 everywhere", fmt::format("{:.3g}", largest));
}

Finding two_maps(const PrefilterMethodInfo& method, const TrialOptions& options) {
  const Grid<Rgb> large = hard_maps::lognormal(kMap, 1.0, options.seed).radiance;
  const Grid<Rgb> small = hard_maps::lognormal({33, 17}, 1.0, options.seed).radiance;
  const Grid<Rgb> before = prefiltered(method, large, {16, 8}, 0.4);
  const Grid<Rgb> other = prefiltered(method, small, {17, 9}, 0.2);
  if (!all_finite(other)) return not_finite("the second map");
  const Grid<Rgb> after = prefiltered(method, large, {16, 8}, 0.4);
  const double off = difference(before, after, [](int x, int y) { return std::pair(x, y); });
  return judged(off, 0.0, "a map of 64x32, then one of 33x17, then the first again",
                off > 0.0 ? "other values than before" : "the same bits before and after");
}

Finding black_map(const ReflectivityMethod& method, const TrialOptions& options) {
  const Grid<Rgb> black = hard_maps::constant(kMap, 0.0F).radiance;
  ReflectivityAccumulation accumulation(black, {4, 2}, 0.5, method.form,
                                        RandomStream("stability/reflectivity", options.seed));
  accumulation.add_frame(16);
  const Grid<Rgb> mean = accumulation.mean();
  if (!all_finite(mean)) return not_finite("black");
  return judged(static_cast<double>(largest_of(mean)), 0.0, "black", "black");
}

Finding white_furnace(const ReflectivityMethod& method, const TrialOptions& options) {
  const Grid<Rgb> white = hard_maps::constant({8, 4}).radiance;
  constexpr int kTexels = 32;
  constexpr int kSamples = 4096;
  double worst = 0.0;
  double bound = 1e-3;
  double where = 0.0;
  for (const double roughness : {0.1, 0.5, 1.0}) {
    ReflectivityAccumulation accumulation(white, {8, 4}, roughness, method.form,
                                          RandomStream("stability/reflectivity", options.seed));
    accumulation.add_frame(kSamples);
    const Grid<Rgb> level = accumulation.mean();
    double mean = 0.0;
    for (const Rgb v : level.values()) mean += static_cast<double>(v.r) / kTexels;
    const double off = std::abs(mean - 1.0);
    if (off <= worst) continue;
    worst = off;
    where = roughness;
    // Five standard errors of the mean weight: its variance is at most 1/3.
    bound = std::max(1e-3, 5.0 * std::sqrt(1.0 / 3.0 / (kTexels * kSamples)));
  }
  return judged(worst, bound,
                fmt::format("white, roughness {:g} the worst of 0.1, 0.5 and 1", where),
                fmt::format("off by {:.3g}", worst));
}

Finding roughness_zero(const ReflectivityMethod& method, const TrialOptions& options) {
  const Grid<Rgb> white = hard_maps::constant({8, 4}).radiance;
  ReflectivityAccumulation accumulation(white, {4, 2}, 0.0, method.form,
                                        RandomStream("stability/reflectivity", options.seed));
  accumulation.add_frame(16);
  if (!all_finite(accumulation.mean())) return not_finite("roughness 0");
  return {.came_out = "finite"};
}

Finding grazing_view(const BrdfTableMethod& method, const TrialOptions& /*options*/) {
  for (const double cosine : {1.0, 0.5, 0.1, 1e-4, 1e-12, 0.0}) {
    for (const double roughness : {1.0, 0.5, 0.1, 0.05, 1e-4, 0.0}) {
      const ScaleBias entry = method.at(cosine, roughness);
      const std::string_view fault = fault_of(entry);
      if (fault.empty()) continue;
      return {
          .outcome =
              fault == "not finite" ? StabilityOutcome::not_a_number : StabilityOutcome::wrong,
          .put_in = fmt::format("cosine {:g}, roughness {:g}", cosine, roughness),
          .came_out = fmt::format("scale {:.4g}, bias {:.4g}: {}", entry.scale, entry.bias, fault)};
    }
  }
  return {.came_out = "finite and in [0, 1] for cosines and roughnesses from 1 to 0"};
}

Finding many_samples(const MeanMethod& method, const TrialOptions& options) {
  const std::uint64_t count = options.thorough ? 1'000'000'000 : 100'000'000;
  const double mean = method.mean_of_spikes(count);
  return judged(std::abs(mean - 1.0), 1e-5,
                fmt::format("{:g} samples, every thousandth 1000", static_cast<double>(count)),
                fmt::format("{:.7g} for a mean of 1", mean));
}

}  // namespace trials
}  // namespace lightproof
