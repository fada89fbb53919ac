#include "lightproof/stability/breaking_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/gate/density_check.h"
#include "lightproof/stability/direction_trials.h"
#include "lightproof/stability/hard_maps.h"
#include "lightproof/stability/other_trials.h"
#include "lightproof/stability/prefilter_trials.h"
#include "lightproof/stability/sampler_on_map.h"

namespace lightproof {
namespace {

/// Half way between two values, as the search counts: a whole number, or a geometric mean.
double between(double a, double b, bool is_whole) {
  return is_whole ? std::floor(0.5 * (a + b)) : std::sqrt(a * b);
}

/// A quantity that can be made harder for methods of one kind, and what they must do meanwhile.
template <class Method>
struct Search {
  std::string_view quantity;
  std::string_view criterion;
  SearchRange range;
  bool (*passes)(const Method& method, double value, const TrialOptions& options);
  /// Whether the method has this quantity; null: all of them have.
  bool (*applies)(const Method& method) = nullptr;
};

bool is_right(const Finding& finding) { return finding.outcome == StabilityOutcome::right; }

/// A row, and one more that is as bright as its sky, with a sun of this radiance.
EnvironmentMap sun_and_sky(int width, double sun) {
  EnvironmentMap map = hard_maps::constant({width, 2});
  map.radiance(width / 2, 0) = Rgb(static_cast<float>(sun));
  return map;
}

bool keeps_sky(const SamplerUnderTest& method, double contrast, const TrialOptions& /*options*/) {
  const SamplerOnMap on_map(method, sun_and_sky(1024, contrast));
  return lost_sky(method, on_map) <= 1e-3;
}

bool keeps_weights(const SamplerUnderTest& method, double contrast,
                   const TrialOptions& /*options*/) {
  const SamplerOnMap on_map(method, sun_and_sky(1024, contrast));
  const DensityComparison found =
      compare_density(on_map.sampler(), on_map.exact(), on_map.rounding());
  return found.unreachable_cells == 0 && found.rounding_variance <= 1e-3;
}

bool draws_width(const SamplerUnderTest& method, double width, const TrialOptions& options) {
  // A lognormal row: what a float sum loses depends on what is in it.
  const SamplerOnMap on_map(method,
                            hard_maps::lognormal({static_cast<int>(width), 1}, 1.0, options.seed));
  if (!is_right(check_density(on_map))) return false;
  // The first and the last random number of floats and of doubles.
  constexpr std::array kNumbers = {0x1p-24, 1.0 - 0x1p-24, 1.0 - 0x1p-53};
  std::vector<SquarePoint> points;
  for (const double s : kNumbers) {
    for (const double t : kNumbers) points.push_back({s, t});
  }
  return is_right(check_drawn(on_map, points));
}

bool places_samples(const SamplerUnderTest& method, double width, const TrialOptions& options) {
  const SamplerOnMap on_map(method,
                            hard_maps::lognormal({static_cast<int>(width), 1}, 2.0, options.seed));
  return misplaced_share(on_map, method.resolution) <= 1e-3;
}

/// Whether columns follow each other along u.s, each with the share of the numbers that is its
/// probability.
bool inverts_sums(const SamplerUnderTest& method) {
  return method.resolution > 0.0 && method.target.lookup == Lookup::nearest;
}

bool draws_sparse(const SamplerUnderTest& method, double period, const TrialOptions& /*options*/) {
  constexpr Extent kExtent = {1024, 2};
  EnvironmentMap map = hard_maps::constant(kExtent, 0.0F);
  const int step = static_cast<int>(period);
  for (int x = step - 1; x < kExtent.width; x += step) {
    for (int y = 0; y < kExtent.height; ++y) map.radiance(x, y) = Rgb(1.0F);
  }
  const SamplerOnMap on_map(method, std::move(map));
  std::vector<SquarePoint> points;
  for (const double s : {0.0, 0x1p-24, 0.5, 1.0 - 0x1p-24, 1.0 - 0x1p-53}) {
    for (const double t : {0.0, 0.5, 1.0 - 0x1p-24}) points.push_back({s, t});
  }
  return is_right(worse_of(check_drawn(on_map, points), check_density(on_map)));
}

bool is_white(const PrefilterMethodInfo& method, double roughness,
              const TrialOptions& /*options*/) {
  return white_furnace_error(method, roughness) <= 1e-3;
}

bool keeps_energy(const PrefilterMethodInfo& method, double contrast,
                  const TrialOptions& /*options*/) {
  return energy_error(method, static_cast<float>(contrast), {64, 32}) <= 1e-2;
}

bool draws_lobe(const LobeMethod& method, double roughness, const TrialOptions& /*options*/) {
  return is_right(check_lobe(method, roughness, std::sqrt(0.5)));
}

bool draws_grazing(const LobeMethod& method, double cosine, const TrialOptions& /*options*/) {
  return is_right(check_lobe(method, 0.3, cosine));
}

bool has_roughness(const LobeMethod& method) {
  return !std::holds_alternative<Lambert>(method.of_roughness(0.5));
}

bool is_orthonormal(const FrameMethod& method, double distance, const TrialOptions& /*options*/) {
  for (const double height : {1.0, -1.0}) {
    for (int i = 0; i < 16; ++i) {
      // Half a step aside, so that no normal lies on an axis.
      const double azimuth = 2.0 * kPi * (i + 0.5) / 16.0;
      const double sine = std::sin(distance);
      const Direction normal = {sine * std::cos(azimuth), sine * std::sin(azimuth),
                                height * std::cos(distance)};
      if (!(method.error(normal) <= 16.0 * method.rounding)) return false;
    }
  }
  return true;
}

bool in_table(const BrdfTableMethod& method, double cosine, const TrialOptions& /*options*/) {
  return std::ranges::all_of(std::array{0.1, 0.5, 1.0}, [&](double roughness) {
    return fault_of(method.at(cosine, roughness)).empty();
  });
}

bool rough_in_table(const BrdfTableMethod& method, double roughness,
                    const TrialOptions& /*options*/) {
  return std::ranges::all_of(std::array{0.01, 0.5, 1.0}, [&](double cosine) {
    return fault_of(method.at(cosine, roughness)).empty();
  });
}

bool has_points(const PointSetInfo& method, double index, const TrialOptions& /*options*/) {
  const auto last = static_cast<std::uint64_t>(index);
  const std::uint64_t first = last < kPointWindow ? 0 : last - kPointWindow + 1;
  return is_right(check_points(method, first, last - first + 1));
}

bool keeps_mean(const MeanMethod& method, double thousands, const TrialOptions& /*options*/) {
  const auto count = static_cast<std::uint64_t>(thousands) * 1000;
  return std::abs(method.mean_of_spikes(count) - 1.0) <= 1e-5;
}

constexpr SearchRange kContrast = {.easiest = 1.0, .hardest = 1e12, .resolution = 1.05};
constexpr SearchRange kRoughness = {.easiest = 1.0, .hardest = 1e-4, .resolution = 1.05};
constexpr SearchRange kCosine = {.easiest = 1.0, .hardest = 1e-12, .resolution = 1.05};

constexpr std::array kSamplerSearches = {
    Search<SamplerUnderTest>{
        "contrast",
        "at most 1e-3 of a sky of 1024x2 texels is never drawn beside a sun in "
        "one of them",
        kContrast, keeps_sky},
    Search<SamplerUnderTest>{"contrast",
                             "rounding of probabilities adds at most 1e-3 to the relative variance "
                             "of one radiance, beside a sun in one of 1024x2 texels",
                             kContrast, keeps_weights},
    Search<SamplerUnderTest>{
        "width",
        "a lognormal row has the declared density, and the last random numbers "
        "stay on it",
        {.easiest = 64, .hardest = 32768, .is_whole = true},
        draws_width},
    Search<SamplerUnderTest>{
        "width",
        "at most 1e-3 of the random numbers of a lognormal row (sigma 2) lead to "
        "another texel than the exact one",
        {.easiest = 64, .hardest = 32768, .is_whole = true},
        places_samples,
        inverts_sums},
    Search<SamplerUnderTest>{"zero pattern",
                             "one texel of so many is lit, the last of each group: none without "
                             "light is drawn, whatever the numbers",
                             {.easiest = 1, .hardest = 1024, .is_whole = true},
                             draws_sparse},
};

constexpr std::array kPrefilterSearches = {
    Search<PrefilterMethodInfo>{"contrast",
                                "the light over the sphere of a map with a sun in one of 64x32 "
                                "texels is kept to 1e-2",
                                kContrast, keeps_energy},
    Search<PrefilterMethodInfo>{"roughness", "a white map stays 1 to 1e-3", kRoughness, is_white},
};

constexpr std::array kLobeSearches = {
    Search<LobeMethod>{
        "roughness",
        "unit vectors of positive finite density, which is known to 1e-4, seen at 45 "
        "degrees",
        kRoughness, draws_lobe, has_roughness},
    Search<LobeMethod>{"cosine of the view",
                       "unit vectors of positive finite density, which is known to 1e-4, roughness "
                       "0.3",
                       kCosine, draws_grazing},
};

constexpr std::array kFrameSearches = {
    Search<FrameMethod>{"distance from a pole",
                        "orthonormal to 16 units in the last place",
                        {.easiest = 1.0, .hardest = 1e-12, .resolution = 1.05},
                        is_orthonormal},
};

constexpr std::array kTableSearches = {
    Search<BrdfTableMethod>{"cosine of the view", "finite and in [0, 1], roughness 0.1 to 1",
                            kCosine, in_table},
    Search<BrdfTableMethod>{"roughness", "finite and in [0, 1], cosine 0.01 to 1", kRoughness,
                            rough_in_table},
};

constexpr std::array kPointSearches = {
    Search<PointSetInfo>{"index",
                         "the last 65536 points up to it are different and below 1",
                         {.easiest = 1, .hardest = 0x1p32 - 1, .is_whole = true},
                         has_points},
};

constexpr std::array kMeanSearches = {
    Search<MeanMethod>{"thousands of samples",
                       "the mean of samples, every thousandth 1000 and all others 0, is 1 to 1e-5",
                       {.easiest = 1, .hardest = 65536, .is_whole = true},
                       keeps_mean},
};

/// Searches for the breaking point of one method. A refusal is a failure.
template <class Method>
BreakingPoint point_of(const Search<Method>& search, std::string_view kind, const Method& method,
                       const TrialOptions& options) {
  const Bracket found = find_breaking_point(search.range, [&](double value) {
    try {
      return search.passes(method, value, options);
    } catch (const InputError&) {
      return false;
    }
  });
  return {std::string(search.quantity),
          std::string(search.criterion),
          std::string(kind),
          method_name(method),
          has_known_defects(method),
          search.range.easiest,
          search.range.hardest,
          found.passed,
          found.failed};
}

/// Adds the searches of methods of one kind.
template <class Method, std::size_t kCount>
void add(std::vector<WorkCell<BreakingPoint>>& cells, std::string_view kind,
         const std::array<Search<Method>, kCount>& searches, const std::vector<Method>& methods,
         const StabilityOptions& options) {
  for (std::size_t number = 0; number < searches.size(); ++number) {
    const Search<Method>& search = searches[number];
    for (const Method& method : methods) {
      if (!is_asked_for(method_name(method), options.methods)) continue;
      if (search.applies != nullptr && !search.applies(method)) continue;
      cells.push_back(
          {fmt::format("breaking/{}/{}/{}/{}", kind, number, search.quantity, method_name(method)),
           [&search, &method, kind, trial = options.trial] {
             return point_of(search, kind, method, trial);
           }});
    }
  }
}

}  // namespace

Bracket find_breaking_point(const SearchRange& range,
                            const std::function<bool(double value)>& passes) {
  const bool rises = range.hardest > range.easiest;
  Bracket found;
  for (double value = range.easiest;;) {
    if (!passes(value)) {
      found.failed = value;
      break;
    }
    found.passed = value;
    if (value == range.hardest) return found;
    value = rises ? std::min(2.0 * value, range.hardest) : std::max(0.5 * value, range.hardest);
  }
  if (!found.passed) return found;
  const auto is_resolved = [&] {
    const double low = std::min(*found.passed, *found.failed);
    const double high = std::max(*found.passed, *found.failed);
    return range.is_whole ? high - low <= 1.0 : high <= range.resolution * low;
  };
  while (!is_resolved()) {
    const double middle = between(*found.passed, *found.failed, range.is_whole);
    (passes(middle) ? found.passed : found.failed) = middle;
  }
  return found;
}

std::vector<WorkCell<BreakingPoint>> breaking_point_cells(const StabilityMethods& methods,
                                                          const StabilityOptions& options) {
  std::vector<WorkCell<BreakingPoint>> cells;
  add(cells, "sampler", kSamplerSearches, methods.samplers, options);
  add(cells, "lobe", kLobeSearches, methods.lobes, options);
  add(cells, "frame", kFrameSearches, methods.frames, options);
  add(cells, "prefilter", kPrefilterSearches, methods.prefilters, options);
  add(cells, "BRDF table", kTableSearches, methods.brdf_tables, options);
  add(cells, "mean", kMeanSearches, methods.means, options);
  add(cells, "point set", kPointSearches, methods.point_sets, options);
  return cells;
}

}  // namespace lightproof
