#include "reference/bilinear_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "lightproof/core/error.h"
#include "lightproof/core/gauss_rule.h"
#include "lightproof/core/parallel.h"

namespace lightproof::reference {
namespace {

constexpr double kWidestPiece = 1.0 / 64.0;

/// Over 1/64 of the square the rule is exact to 1e-14 for the product of a linear function and
/// sin(pi t).
const GaussRule<3> kRule;

/// ∫ of a function without edges.
template <class Function>
double integrate(double low, double high, const Function& f) {
  const int pieces = std::max(1, static_cast<int>(std::ceil((high - low) / kWidestPiece)));
  const double width = (high - low) / pieces;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    sum += kRule.integrate(low + i * width, low + (i + 1) * width, f);
  }
  return sum;
}

/// The lower edge of patch k of a line: the centre of texel k - 1, but not beyond [0,1].
double patch_edge(int k, int texels) { return std::clamp((k - 0.5) / texels, 0.0, 1.0); }

int patch_at(double position, int texels) {
  return std::clamp(static_cast<int>(std::floor(position * texels + 0.5)), 0, texels);
}

/// The texels at both ends of a patch.
std::array<int, 2> ends_of(int patch, int texels, bool wraps) {
  if (wraps) return {(patch + texels - 1) % texels, patch % texels};
  return {std::max(patch - 1, 0), std::min(patch, texels - 1)};
}

double weight_at(MapMeasure measure, double t) {
  return measure == MapMeasure::square ? 1.0 : sin_theta(t);
}

std::function<double(double)> weight_function(MapMeasure measure) {
  return [measure](double t) { return weight_at(measure, t); };
}

/// The parts of all tents of a line for each of `cells` equal cells.
std::vector<std::vector<TentPart>> parts_of_cells(int cells, int texels, bool wraps,
                                                  const std::function<double(double)>& weight) {
  std::vector<std::vector<TentPart>> all;
  for (int i = 0; i < cells; ++i) {
    const double low = static_cast<double>(i) / cells;
    all.push_back(tent_parts(low, (i + 1.0) / cells, texels, wraps, weight));
  }
  return all;
}

double one(double /*s*/) { return 1.0; }

/// ∫ of the interpolation around a line of so many texels, whose values are line(x), from the lower
/// edge of a patch to a place in it.
template <class Line>
double since_edge(const Line& line, int texels, int patch, double position) {
  const auto [first, second] = ends_of(patch, texels, true);
  const double low = line(first);
  const double high = line(second);
  const auto value = [&](double at) {
    const double rising = std::clamp(at * texels + 0.5 - patch, 0.0, 1.0);
    return (1.0 - rising) * low + rising * high;
  };
  const double edge = patch_edge(patch, texels);
  return std::max(0.0, position - edge) * 0.5 *
         (value(edge) + value(position));  // exact: it is linear
}

/// 0, then the same from 0 to the upper edge of every patch.
template <class Line>
std::vector<double> sums_over(const Line& line, int texels) {
  std::vector<double> sums = {0.0};
  for (int patch = 0; patch <= texels; ++patch) {
    sums.push_back(sums.back() + since_edge(line, texels, patch, patch_edge(patch + 1, texels)));
  }
  return sums;
}

/// The values of a line of columns.
auto values_of(const std::vector<double>& line) {
  return [&line](int x) { return line[static_cast<std::size_t>(x)]; };
}

/// The values of a row of texels.
auto values_of(const InterpolatedTexels& texels, int y) {
  return [&texels, y](int x) { return texels(x, y); };
}

/// What a texel of row y weighs in a density that weighs texels, up to a constant factor.
double factor_of_row(int y, int height) {
  return height * (cos_theta((y + 1.0) / height) - cos_theta(static_cast<double>(y) / height));
}

}  // namespace

std::vector<TentPart> tent_parts(double low, double high, int texels, bool wraps,
                                 const std::function<double(double)>& weight) {
  std::vector<TentPart> parts;
  const auto add = [&](int texel, double integral) {
    if (!(integral > 0.0)) return;
    const auto same = std::find_if(parts.begin(), parts.end(),
                                   [&](const TentPart& part) { return part.texel == texel; });
    if (same != parts.end()) {
      same->integral += integral;
    } else {
      parts.push_back({texel, integral});
    }
  };
  for (int patch = patch_at(low, texels); patch <= patch_at(high, texels); ++patch) {
    const double from = std::max(low, patch_edge(patch, texels));
    const double to = std::min(high, patch_edge(patch + 1, texels));
    if (!(from < to)) continue;
    const auto [first, second] = ends_of(patch, texels, wraps);
    const auto rising = [&](double position) {
      return std::clamp(position * texels + 0.5 - patch, 0.0, 1.0);
    };
    add(first, integrate(from, to, [&](double x) { return (1.0 - rising(x)) * weight(x); }));
    add(second, integrate(from, to, [&](double x) { return rising(x) * weight(x); }));
  }
  return parts;
}

Grid<double> interpolated_by(DensitySpace density_space, Grid<double> luminance) {
  if (!weighs_texels(density_space)) return luminance;
  const int height = luminance.extent().height;
  for (int y = 0; y < height; ++y) {
    const double factor = factor_of_row(y, height);
    for (double& value : luminance.row(y)) value *= factor;
  }
  return luminance;
}

InterpolatedTexels::InterpolatedTexels(const EnvironmentMap& map, TargetDensity target)
    : luminance_(map, target.weights) {
  if (!weighs_texels(target.density_space)) return;
  const int height = extent().height;
  for (int y = 0; y < height; ++y) factors_.push_back(factor_of_row(y, height));
}

Grid<double> bilinear_masses(const EnvironmentMap& map, TargetDensity target, Extent cells) {
  const Extent extent = map.radiance.extent();
  const InterpolatedTexels luminance(map, target);
  const auto across = parts_of_cells(cells.width, extent.width, true, one);
  const auto along = parts_of_cells(cells.height, extent.height, false,
                                    weight_function(position_measure(target.density_space)));
  Grid<double> folded({cells.width, extent.height});
  parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < cells.width; ++x) {
      for (const TentPart& part : across[static_cast<std::size_t>(x)]) {
        folded(x, y) += part.integral * luminance(part.texel, y);
      }
    }
  });
  Grid<double> masses(cells);
  parallel_for(static_cast<std::size_t>(cells.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (const TentPart& part : along[row]) {
      for (int x = 0; x < cells.width; ++x) {
        masses(x, y) += part.integral * folded(x, part.texel);
      }
    }
  });
  const auto values = masses.values();
  const double total = std::accumulate(values.begin(), values.end(), 0.0);
  if (!(total > 0.0)) throw InputError(map.name + ": the map is black");
  for (double& mass : values) mass /= total;
  return masses;
}

BilinearTransform::BilinearTransform(const EnvironmentMap& map, TargetDensity target)
    : extent_(map.radiance.extent()),
      measure_(position_measure(target.density_space)),
      luminance_(map, target),
      row_means_(static_cast<std::size_t>(extent_.height)),
      columns_(static_cast<std::size_t>(extent_.width)),
      sums_({extent_.width / kStep + 1, extent_.height}) {
  parallel_for(static_cast<std::size_t>(extent_.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const std::vector<double> sums = sums_over(values_of(luminance_, y), extent_.width);
    for (int patch = 0; patch <= extent_.width; patch += kStep) {
      sums_(patch / kStep, y) = sums[static_cast<std::size_t>(patch)];
    }
    row_means_[row] = sums.back();
  });
  marginal_.push_back(0.0);
  for (int row = 0; row <= extent_.height; ++row) {
    const double low = patch_edge(row, extent_.height);
    marginal_.push_back(marginal_.back() + marginal_mass(low, patch_edge(row + 1, extent_.height)));
  }
  total_ = marginal_.back();
  for (const TentPart& part :
       tent_parts(0.0, 1.0, extent_.height, false, weight_function(measure_))) {
    for (int x = 0; x < extent_.width; ++x) {
      columns_[static_cast<std::size_t>(x)] += part.integral * luminance_(x, part.texel);
    }
  }
  column_sums_ = sums_over(values_of(columns_), extent_.width);
}

BilinearTransform::SumsAt BilinearTransform::sums_at(int y, double s) const {
  const int width = extent_.width;
  const auto line = values_of(luminance_, y);
  const auto upper_edge = [width](int patch) { return patch_edge(patch + 1, width); };
  const int patch = patch_at(s, width);
  double left = sums_(patch / kStep, y);
  for (int before = patch - patch % kStep; before < patch; ++before) {
    left += since_edge(line, width, before, upper_edge(before));
  }
  return {left, left + since_edge(line, width, patch, s),
          left + since_edge(line, width, patch, upper_edge(patch))};
}

double BilinearTransform::marginal_mass(double low, double high) const {
  const int row = patch_at(0.5 * (low + high), extent_.height);
  const auto [first, second] = ends_of(row, extent_.height, false);
  const double from = row_means_[static_cast<std::size_t>(first)];
  const double to = row_means_[static_cast<std::size_t>(second)];
  return integrate(low, high, [&](double t) {
    const double rising = std::clamp(t * extent_.height + 0.5 - row, 0.0, 1.0);
    return (from + rising * (to - from)) * weight_at(measure_, t);
  });
}

std::vector<double> BilinearTransform::rows() const {
  std::vector<double> masses;
  for (std::size_t row = 0; row + 1 < marginal_.size(); ++row) {
    masses.push_back((marginal_[row + 1] - marginal_[row]) / total_);
  }
  return masses;
}

RosenblattPoint BilinearTransform::operator()(SquarePoint at) const {
  const int row = patch_at(at.t, extent_.height);
  const auto [first, second] = ends_of(row, extent_.height, false);
  const double rising = std::clamp(at.t * extent_.height + 0.5 - row, 0.0, 1.0);
  const auto low = static_cast<std::size_t>(first);
  const auto high = static_cast<std::size_t>(second);
  const auto index = static_cast<std::size_t>(row);
  const double before = marginal_mass(patch_edge(row, extent_.height), at.t);
  const double marginal = (marginal_[index] + before) / total_;
  const auto mix = [&](double a, double b) { return (1.0 - rising) * a + rising * b; };
  const double whole = mix(row_means_[low], row_means_[high]);
  const SumsAt of_low = sums_at(first, at.s);
  const SumsAt of_high = sums_at(second, at.s);
  const double left = mix(of_low.below, of_high.below);
  const double patch_left = mix(of_low.patch_left, of_high.patch_left);
  const double patch_right = mix(of_low.patch_right, of_high.patch_right);
  const int patch = patch_at(at.s, extent_.width);
  const double below = column_sums_[static_cast<std::size_t>(patch)] +
                       since_edge(values_of(columns_), extent_.width, patch, at.s);
  const auto share = [](double part, double of) {
    return of > 0.0 ? std::clamp(part / of, 0.0, 1.0) : 0.0;
  };
  return {std::min(marginal, 1.0),
          share(left, whole),
          share(below, column_sums_.back()),
          row,
          share(before, marginal_[index + 1] - marginal_[index]),
          share(left - patch_left, patch_right - patch_left)};
}

}  // namespace lightproof::reference
