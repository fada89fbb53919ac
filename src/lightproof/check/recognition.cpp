#include "lightproof/check/recognition.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "lightproof/check/dump_sampler.h"
#include "lightproof/core/parallel.h"
#include "lightproof/dump/sample_convention.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/image/largest_channel.h"
#include "lightproof/image/luminance.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/mapping.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

/// Samples by which conventions are told apart.
constexpr std::uint64_t kSamples = std::uint64_t{1} << 17U;
/// How many of these samples tell axes apart where a density takes long to compute.
constexpr std::size_t kOfDirections = std::size_t{1} << 15U;
/// How many samples' densities are compared with others.
constexpr std::size_t kOfDensities = std::size_t{1} << 13U;
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

/// How well directions fit a distribution.
struct Fit {
  double log10_p;
  double log_likelihood;  ///< mean of the logarithm of the density, per steradian
};

/// What lies beside all light, by rounding or by a defect, must not decide alone.
constexpr double kLeastDensity = 1e-12;

/// A target density on the map as masses, and how well directions fit it.
class MapTarget {
 public:
  MapTarget(const EnvironmentMap& map, TargetDensity target)
      : mapping_(map.mapping),
        masses_(reference::texel_masses(map, target)),
        bins_(serpentine(reference::bin_masses(map, target, kGateBins))) {}

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
      sum += log_density(x, y);
    }
    return {cressie_read(serpentine(counts), bins_, directions.size()).log10_p,
            sum / static_cast<double>(directions.size())};
  }

  /// Directions on the square, each moved by a part of a texel, counted in the texels.
  Fit shifted_fit(const std::vector<Direction>& directions, SquarePoint by_texels) const {
    const Extent extent = masses_.extent();
    Grid<std::uint64_t> counts(extent);
    double sum = 0.0;
    for (const Direction d : directions) {
      const SquarePoint at = square_point_of(mapping_, d);
      double s = at.s + by_texels.s / extent.width;
      s -= std::floor(s);
      const double t = std::clamp(at.t + by_texels.t / extent.height, 0.0, 1.0);
      const int x = cell_of(s, extent.width);
      const int y = cell_of(t, extent.height);
      ++counts(x, y);
      sum += log_density(x, y);
    }
    return {cressie_read(serpentine(counts), serpentine(masses_), directions.size()).log10_p,
            sum / static_cast<double>(directions.size())};
  }

 private:
  double log_density(int x, int y) const {
    return std::log(std::max(masses_(x, y), kLeastDensity) /
                    texel_solid_angle(mapping_, masses_.extent(), x, y));
  }

  Mapping mapping_;
  Grid<double> masses_;
  std::vector<double> bins_;
};

/// A distribution over directions, and how well directions fit it.
class DirectionFit {
 public:
  explicit DirectionFit(const DirectionTarget& target)
      : distribution_(&target.distribution),
        expectation_(
            std::visit([](const auto& of) { return expectation_of(of); }, target.distribution)),
        bins_(serpentine(expectation_->bins)) {}

  Fit fit(const std::vector<Direction>& directions, const AxisMap& axes) const {
    /// Directions that rounding has moved beyond the edge.
    constexpr double kStrayed = 1e-4;
    Grid<std::uint64_t> counts(kGateBins);
    double sum = 0.0;
    std::size_t beside = 0;
    for (const Direction d : directions) {
      const Direction turned = axes(d);
      const double density = density_of(*distribution_, turned);
      sum += std::log(std::max(density, kLeastDensity));
      const SquarePoint at = std::visit(
          [&](const auto& of) {
            return sample_of(of, expectation_->masses.extent(), {turned, {density}}).at;
          },
          *distribution_);
      if (density <= 0.0 || !std::isfinite(at.s)) {
        ++beside;
      } else {
        ++counts(cell_of(at.s, kGateBins.width), cell_of(at.t, kGateBins.height));
      }
    }
    const auto all = static_cast<double>(directions.size());
    if (static_cast<double>(beside) > kStrayed * all) {
      return {-std::numeric_limits<double>::infinity(), sum / all};
    }
    return {cressie_read(serpentine(counts), bins_, directions.size() - beside).log10_p, sum / all};
  }

 private:
  const DirectionDistribution* distribution_;
  std::shared_ptr<const Expectation> expectation_;
  std::vector<double> bins_;
};

struct NamedAxes {
  const char* axes;
  const char* words;
};
constexpr std::array kNamedAxes = {
    NamedAxes{"x,y,-z", "if z is negated (t is flipped)"},
    NamedAxes{"x,-y,z", "if y is negated (s is mirrored)"},
    NamedAxes{"-x,y,z", "if x is negated (s is mirrored, from the other side)"},
    NamedAxes{"-x,-y,z", "after half a turn about z (s is shifted by one half)"},
    NamedAxes{"-y,x,z", "after a quarter turn about z"},
    NamedAxes{"y,-x,z", "after a quarter turn about z, the other way"},
    NamedAxes{"x,-z,y", "if y is up instead of z (right-handed axes)"},
    NamedAxes{"z,x,y", "if they are in the axes of the presets `mitsuba` and `openexr`, y up"},
    NamedAxes{"x,z,y", "if y and z change places (y up, left-handed axes)"},
    NamedAxes{"-x,-y,-z", "if every direction is reversed (towards the light or from it)"}};

/// In which order axes that make no difference are named: rotations with words of their own, mirror
/// images with such words, all others.
int rank_of(const AxisMap& axes) {
  const bool is_named = std::ranges::any_of(
      kNamedAxes, [&](const NamedAxes& named) { return axes.text() == named.axes; });
  if (!is_named) return 2;
  return axes.mirrors() ? 1 : 0;
}

/// What a change of axes is called, beside the axes themselves.
std::string words_of(const AxisMap& axes) {
  const std::string text = axes.text();
  for (const NamedAxes& named : kNamedAxes) {
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

/// Adds other axes than those by which the directions were read, which are `named`. Of axes that
/// make no difference to the distribution the first ones stay, by rank_of().
template <class Target>
void add_axes(std::vector<Candidate>& found, const Target& declared,
              const std::vector<Direction>& directions, const AxisMap& named) {
  const auto& all = AxisMap::all();
  std::vector<Fit> fits(all.size());
  parallel_for(all.size(), [&](std::size_t i) { fits[i] = declared.fit(directions, all[i]); });
  std::vector<std::size_t> order(all.size() - 1);
  std::iota(order.begin(), order.end(), std::size_t{1});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rank_of(all[i]); });
  const auto makes_no_difference = [&](const Candidate& other, std::size_t i) {
    return std::abs(other.log_likelihood - fits[i].log_likelihood) <= 1e-9;
  };
  for (const std::size_t i : order) {
    if (std::ranges::any_of(found, [&](const Candidate& c) { return makes_no_difference(c, i); })) {
      continue;
    }
    found.push_back({{words_of(all[i]), "--axes=" + all[i].after(named).text(), fits[i].log10_p},
                     1,
                     fits[i].log_likelihood});
  }
}

/// A luminance that samplers draw by: weights, or the largest channel.
struct NamedLuminance {
  const char* name;
  LuminanceWeights weights;
  bool is_largest = false;
};
constexpr std::array kLuminances = {
    NamedLuminance{"rec709", kRec709}, NamedLuminance{"published", kPublishedLuminance},
    NamedLuminance{"average", kAverageLuminance}, NamedLuminance{"max", kRec709, true}};

void add_densities(std::vector<Candidate>& found, const DeclaredMap& declared,
                   const std::vector<Direction>& directions) {
  const EnvironmentMap& colours = declared.colours != nullptr ? *declared.colours : *declared.map;
  const bool declares_largest = declared.colours != nullptr;
  const EnvironmentMap largest = map_of_largest_channel(colours);
  const TargetDensity target = declared.target;
  for (const DensityInfo& density : kDensities) {
    const TargetDensity changed = {density.density_space, target.weights, target.lookup};
    if (!why_not_declared(changed, colours.mapping).empty()) continue;
    // Where equal areas are equal solid angles all densities are one.
    if (is_equal_area(colours.mapping) && !(changed == target)) continue;
    for (const NamedLuminance& luminance : kLuminances) {
      const bool same_luminance = luminance.is_largest
                                      ? declares_largest
                                      : !declares_largest && luminance.weights == target.weights;
      const bool same_density = density.density_space == target.density_space;
      if (same_luminance && same_density) continue;
      const MapTarget other(luminance.is_largest ? largest : colours,
                            {density.density_space, luminance.weights, target.lookup});
      const Fit fit = other.fit(directions, AxisMap());
      std::vector<std::string> parts;
      std::vector<std::string> options;
      if (!same_density) {
        parts.push_back(fmt::format("the {} density {}", density.name, density.label));
        options.push_back(fmt::format("--density {}", density.label));
      }
      if (!same_luminance) {
        parts.push_back(fmt::format("the luminance `{}`", luminance.name));
        options.push_back(fmt::format("--luminance {}", luminance.name));
      }
      found.push_back({{fmt::format("if they are drawn by {}", fmt::join(parts, " and ")),
                        fmt::format("{}", fmt::join(options, " ")), fit.log10_p},
                       options.size(),
                       fit.log_likelihood});
    }
  }
}

std::string words_of_shift(SquarePoint by) {
  const auto part = [](const char* coordinate, double shift) {
    return shift == 0.0 ? std::string()
                        : fmt::format("{} {} by half a texel", coordinate,
                                      shift < 0.0 ? "decreases" : "increases");
  };
  const std::string along = part("s", by.s);
  const std::string up = part("t", by.t);
  return fmt::format("if {}{}{}", along, along.empty() || up.empty() ? "" : " and ", up);
}

/// Adds the shift by half a texel, along either or both sides of the square, under which the
/// directions are likeliest, if they are a million times likelier under it than as declared: bins
/// are too large to show it.
void add_shifts(std::vector<Candidate>& found, const MapTarget& declared,
                const std::vector<Direction>& directions) {
  const double million = std::log(1e6) / static_cast<double>(directions.size());
  double most = declared.shifted_fit(directions, {0.0, 0.0}).log_likelihood + million;
  std::optional<Candidate> likeliest;
  for (const double s : {-0.5, 0.0, 0.5}) {
    for (const double t : {-0.5, 0.0, 0.5}) {
      if (s == 0.0 && t == 0.0) continue;
      const Fit fit = declared.shifted_fit(directions, {s, t});
      if (fit.log_likelihood <= most) continue;
      most = fit.log_likelihood;
      likeliest = Candidate{{words_of_shift({s, t}), "", fit.log10_p}, 1, fit.log_likelihood};
    }
  }
  if (likeliest) found.push_back(*std::move(likeliest));
}

/// A factor between the density that came with a sample and the declared one.
struct DensityFactor {
  const char* words;
  const char* options;  ///< that say so; empty if none do
  std::function<double(SquarePoint)> at;
};

/// What densities over directions or over the square are mistaken for each other by.
std::vector<DensityFactor> factors_of(const Mapping& mapping, Extent texels,
                                      DensityMeasure measure) {
  const auto jacobian = [mapping](SquarePoint at) { return solid_angle_per_square(mapping, at); };
  const bool per_steradian = measure == DensityMeasure::solid_angle;
  std::vector<DensityFactor> factors = {
      {"if the pdf is one over the unit square: its Jacobian d(omega)/(ds dt) is forgotten",
       per_steradian ? "--measure square" : "", jacobian},
      {per_steradian ? "if the pdf is divided by the Jacobian d(omega)/(ds dt) once, not twice"
                     : "if the pdf is one per steradian",
       per_steradian ? "" : "--measure solid-angle",
       [=](SquarePoint at) { return 1.0 / jacobian(at); }},
      {"if the pdf is divided by the Jacobian d(omega)/(ds dt), by which it is multiplied", "",
       [=](SquarePoint at) { return jacobian(at) * jacobian(at); }},
      {"if the pdf is the probability of the texel: it is to be divided by its solid angle", "",
       [=, count = static_cast<double>(texels.count())](SquarePoint at) {
         return jacobian(at) / count;
       }}};
  if (mapping.kind != MappingKind::lat_long) return factors;
  factors.push_back({"if the pdf is divided by sin(theta), which is forgotten", "",
                     [](SquarePoint at) { return sin_theta(at.t); }});
  factors.push_back({"if the pdf is multiplied by sin(theta), by which it is divided", "",
                     [](SquarePoint at) { return 1.0 / sin_theta(at.t); }});
  factors.push_back({"if the pdf is divided by 2 pi^2, which is forgotten", "",
                     [](SquarePoint) { return 2.0 * kPi * kPi; }});
  return factors;
}

/// Whether all but one in a thousand of the ratios are the factor, to a thousandth.
template <class FactorAt>
bool explains(std::span<const ComparedCell> cells, const FactorAt& factor_at) {
  const auto fitting = std::ranges::count_if(cells, [&](const ComparedCell& cell) {
    return std::abs(cell.pdf / cell.declared / factor_at(cell.at) - 1.0) <= 1e-3;
  });
  return static_cast<std::size_t>(fitting) * 1000 >= cells.size() * 999;
}

/// Adds what makes the densities that came with samples the declared ones, if they are not. The
/// p-value is of no test: densities fit or do not.
void add_density_factor(std::vector<Recognition>& named, std::span<const ComparedCell> cells,
                        const std::vector<DensityFactor>& factors) {
  constexpr std::size_t kFewest = 100;
  if (cells.size() < kFewest || explains(cells, [](SquarePoint) { return 1.0; })) return;
  for (const DensityFactor& factor : factors) {
    if (!explains(cells, factor.at)) continue;
    named.push_back({factor.words, factor.options, 0.0});
    return;
  }
  std::vector<double> ratios;
  for (const ComparedCell& cell : cells) ratios.push_back(cell.pdf / cell.declared);
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::ranges::nth_element(ratios, middle);
  const double factor = *middle;
  if (!(factor > 0.0) || !explains(cells, [factor](SquarePoint) { return factor; })) return;
  named.push_back({fmt::format("if the pdf is divided by {:.6g}", factor), "", 0.0});
}

/// The candidates that fit, the likeliest first.
std::vector<Recognition> fitting(std::vector<Candidate> found) {
  std::erase_if(found, [](const Candidate& candidate) {
    return !(candidate.recognition.log10_p >= kFittingLog10P);
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

}  // namespace

std::vector<Recognition> recognise(const SampleDump& dump, const DeclaredMap& declared) {
  const std::vector<Direction> directions = some_directions(dump);
  if (directions.empty()) return {};
  const EnvironmentMap& map = *declared.map;
  const MapTarget target(map, declared.target);
  std::vector<Candidate> found;
  const bool is_far_off = target.fit(directions, AxisMap()).log10_p < kRejectedLog10P;
  if (is_far_off) {
    add_densities(found, declared, directions);
    add_axes(found, target, directions, dump.axes());
  }
  if (map.mapping.kind == MappingKind::lat_long) add_shifts(found, target, directions);
  std::vector<Recognition> named = fitting(std::move(found));
  if (named.empty() && !is_far_off && dump.has_pdf()) {
    const Expectation expectation = texel_expectation_of(map, declared.target);
    add_density_factor(named, some_densities(dump, expectation, kOfDensities),
                       factors_of(map.mapping, map.radiance.extent(), dump.measure()));
  }
  return named;
}

std::vector<Recognition> recognise(const SampleDump& dump, const DirectionTarget& target) {
  std::vector<Direction> directions = some_directions(dump);
  if (directions.size() > kOfDirections) directions.resize(kOfDirections);
  if (directions.empty()) return {};
  const DirectionFit declared(target);
  if (declared.fit(directions, AxisMap()).log10_p < kRejectedLog10P) {
    std::vector<Candidate> found;
    add_axes(found, declared, directions, dump.axes());
    return fitting(std::move(found));
  }
  std::vector<Recognition> named;
  if (!dump.has_pdf()) return named;
  std::vector<DumpedSample> samples(
      static_cast<std::size_t>(std::min<std::uint64_t>(kOfDensities, dump.count())));
  dump.read(0, samples);
  std::vector<ComparedCell> cells;
  for (const DumpedSample& sample : samples) {
    if (!std::isfinite(sample.direction.x)) continue;
    const double density = density_of(target.distribution, sample.direction);
    if (density > 0.0) cells.push_back({0, 0, {}, sample.pdf.value, density});
  }
  add_density_factor(named, cells, {});
  return named;
}

}  // namespace lightproof
