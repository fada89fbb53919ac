#include "lightproof/check/recognition.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lightproof/core/parallel.h"
#include "lightproof/dump/sample_convention.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/image/luminance.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/mapping.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

/// Samples by which conventions are told apart.
constexpr std::uint64_t kSamples = std::uint64_t{1} << 17U;
/// p-values of fits: below the first nothing of what is declared is believed, above the second a
/// change of it is.
constexpr double kRejectedLog10P = -10.0;
constexpr double kFittingLog10P = -3.0;
constexpr std::size_t kMostNamed = 3;

std::vector<Direction> some_directions(const SampleDump& dump) {
  const std::uint64_t count = std::min(kSamples, dump.count());
  std::vector<DumpedSample> samples(static_cast<std::size_t>(count));
  dump.read(0, samples);
  std::vector<Direction> directions;
  for (const DumpedSample& sample : samples) {
    if (std::isfinite(sample.direction.x)) directions.push_back(sample.direction);
  }
  return directions;
}

/// A target density on the map as masses, and how well directions fit it.
class Target {
 public:
  Target(const EnvironmentMap& map, TargetDensity target)
      : mapping_(map.mapping),
        masses_(reference::texel_masses(map, target)),
        bins_(serpentine(reference::bin_masses(map, target, kGateBins))) {}

  struct Fit {
    double log10_p;
    double log_likelihood;  ///< mean of the logarithm of the texels' masses per their solid angle
  };
  Fit fit(const std::vector<Direction>& directions, const AxisMap& axes) const {
    Grid<std::uint64_t> counts(kGateBins);
    const Extent extent = masses_.extent();
    double sum = 0.0;
    for (const Direction d : directions) {
      const Direction turned = axes(d);
      const SquarePoint in_bins = square_from_direction(turned);
      ++counts(cell_of(in_bins.s, kGateBins.width), cell_of(in_bins.t, kGateBins.height));
      const SquarePoint at = square_point_of(mapping_, turned);
      const int x = cell_of(at.s, extent.width);
      const int y = cell_of(at.t, extent.height);
      // What lies beside a bright texel by rounding must not decide.
      sum += std::log(std::max(masses_(x, y), 1e-12) / texel_solid_angle(mapping_, extent, x, y));
    }
    return {cressie_read(serpentine(counts), bins_, directions.size()).log10_p,
            sum / static_cast<double>(directions.size())};
  }

 private:
  Mapping mapping_;
  Grid<double> masses_;
  std::vector<double> bins_;
};

/// What a change of axes is called, beside the axes themselves.
std::string words_of(const AxisMap& axes) {
  struct Named {
    const char* axes;
    const char* words;
  };
  constexpr std::array kNamed = {
      Named{"x,y,-z", "if z is negated (t is flipped)"},
      Named{"x,-y,z", "if y is negated (s is mirrored)"},
      Named{"-x,y,z", "if x is negated (s is mirrored, from the other side)"},
      Named{"-x,-y,z", "after half a turn about z (s is shifted by one half)"},
      Named{"-y,x,z", "after a quarter turn about z"},
      Named{"y,-x,z", "after a quarter turn about z, the other way"},
      Named{"x,-z,y", "if y is up instead of z (right-handed axes)"},
      Named{"z,x,y", "if they are in the axes of the presets `mitsuba` and `openexr`, y up"},
      Named{"x,z,y", "if y and z change places (y up, left-handed axes)"},
      Named{"-x,-y,-z", "if every direction is reversed (towards the light or from it)"}};
  const std::string text = axes.text();
  for (const Named& named : kNamed) {
    if (text == named.axes) return named.words;
  }
  return fmt::format("if (x, y, z) are their ({}){}", text,
                     axes.mirrors() ? ", a mirror image" : "");
}

struct Candidate {
  Recognition recognition;
  std::size_t changes;  ///< how many things are said otherwise
  double log_likelihood;
};

/// Adds other axes than those by which the directions were read, which are `named`.
void add_axes(std::vector<Candidate>& found, const Target& declared,
              const std::vector<Direction>& directions, const AxisMap& named) {
  const auto& all = AxisMap::all();
  std::vector<Target::Fit> fits(all.size());
  parallel_for(all.size(), [&](std::size_t i) { fits[i] = declared.fit(directions, all[i]); });
  for (std::size_t i = 1; i < all.size(); ++i) {
    found.push_back({{words_of(all[i]), "--axes=" + all[i].after(named).text(), fits[i].log10_p},
                     1,
                     fits[i].log_likelihood});
  }
}

struct NamedWeights {
  const char* name;
  LuminanceWeights weights;
};
constexpr std::array kWeights = {NamedWeights{"rec709", kRec709},
                                 NamedWeights{"published", kPublishedLuminance},
                                 NamedWeights{"average", {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}}};

void add_densities(std::vector<Candidate>& found, const EnvironmentMap& map, TargetDensity target,
                   const std::vector<Direction>& directions) {
  for (const DensityInfo& density : kDensities) {
    const TargetDensity changed = {density.density_space, target.weights, target.lookup};
    if (!why_not_declared(changed, map.mapping).empty()) continue;
    // Where equal areas are equal solid angles all densities are one.
    if (is_equal_area(map.mapping) && !(changed == target)) continue;
    for (const NamedWeights& weights : kWeights) {
      const bool same_weights = weights.weights == target.weights;
      const bool same_density = density.density_space == target.density_space;
      if (same_weights && same_density) continue;
      const Target other(map, {density.density_space, weights.weights, target.lookup});
      const auto fit = other.fit(directions, AxisMap());
      std::vector<std::string> parts;
      std::vector<std::string> options;
      if (!same_density) {
        parts.push_back(fmt::format("the {} density {}", density.name, density.label));
        options.push_back(fmt::format("--density {}", density.label));
      }
      if (!same_weights) {
        parts.push_back(fmt::format("the luminance `{}`", weights.name));
        options.push_back(fmt::format("--luminance {}", weights.name));
      }
      found.push_back({{fmt::format("if they are drawn by {}", fmt::join(parts, " and ")),
                        fmt::format("{}", fmt::join(options, " ")), fit.log10_p},
                       options.size(),
                       fit.log_likelihood});
    }
  }
}

}  // namespace

std::vector<Recognition> recognise(const SampleDump& dump, const EnvironmentMap& map,
                                   TargetDensity target) {
  const std::vector<Direction> directions = some_directions(dump);
  if (directions.empty()) return {};
  const Target declared(map, target);
  if (declared.fit(directions, AxisMap()).log10_p >= kRejectedLog10P) return {};
  std::vector<Candidate> found;
  add_densities(found, map, target, directions);
  add_axes(found, declared, directions, dump.axes());
  std::erase_if(found, [](const Candidate& candidate) {
    return candidate.recognition.log10_p < kFittingLog10P;
  });
  std::ranges::stable_sort(found, [](const Candidate& a, const Candidate& b) {
    return a.changes != b.changes ? a.changes < b.changes : a.log_likelihood > b.log_likelihood;
  });
  std::vector<Recognition> named;
  for (Candidate& candidate : found) {
    if (named.size() == kMostNamed) break;
    named.push_back(std::move(candidate.recognition));
  }
  return named;
}

}  // namespace lightproof
