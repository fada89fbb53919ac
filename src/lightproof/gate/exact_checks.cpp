#include "lightproof/gate/exact_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lightproof/core/gauss_rule.h"
#include "lightproof/core/parallel.h"
#include "lightproof/gate/draws.h"
#include "lightproof/gate/sampler_rows.h"
#include "reference/mapped_texels.h"

namespace lightproof {
namespace {

/// The rule over s inside a cell, where a density is constant or linear.
const GaussRule<2> kRuleOverS;
/// The rule over t inside a cell, where a density may be a linear function times sin(pi t).
const GaussRule<3> kRuleOverT;
/// Pieces are at most 1/64 high in t. Three nodes leave h^7/2016000 |f^(6)| of a piece of height h
/// in theta (Abramowitz and Stegun 25.4.29 and 30). Of f = (a + b theta) sin(theta) the worst case
/// is a = 0 at a pole, f^(6) = 6 b: of its integral b h^3/3 that is 9 h^4/10^6 = 5e-11 at
/// h = pi/64, whatever the height of the map and wherever its light is.
constexpr int kFewestPieces = 64;
/// Relative difference of two pdfs that are meant to be one.
constexpr double kSamePdf = 1e-5;

/// A position, seen from a sample's on a map of this size, whose pdf may be taken for its own.
struct OtherPosition {
  std::string_view name;
  SquarePoint (*of)(SquarePoint at, Extent map);
};
constexpr std::array<OtherPosition, 6> kOtherPositions = {{
    {"one column to the right",
     [](SquarePoint at, Extent map) {
       return SquarePoint{std::fmod(at.s + 1.0 / map.width, 1.0), at.t};
     }},
    {"one column to the left",
     [](SquarePoint at, Extent map) {
       return SquarePoint{std::fmod(at.s + 1.0 - 1.0 / map.width, 1.0), at.t};
     }},
    {"one row above",
     [](SquarePoint at, Extent map) {
       return SquarePoint{at.s, std::min(at.t + 1.0 / map.height, 1.0 - 0x1p-53)};
     }},
    {"one row below",
     [](SquarePoint at, Extent map) {
       return SquarePoint{at.s, std::max(at.t - 1.0 / map.height, 0.0)};
     }},
    {"mirrored in s",
     [](SquarePoint at, Extent /*map*/) {
       return SquarePoint{std::max(0.0, 1.0 - 0x1p-53 - at.s), at.t};
     }},
    {"mirrored in t",
     [](SquarePoint at, Extent /*map*/) {
       return SquarePoint{at.s, std::max(0.0, 1.0 - 0x1p-53 - at.t)};
     }},
}};

constexpr std::array<double, 5> kCorners = {0.0, 0x1p-24, 0.5, 1.0 - 0x1p-24, 1.0 - 0x1p-53};

/// The cumulative sums of `masses`, normalised, each with its neighbours on either side, in double
/// and in steps of 2^-31 and 2^-24, where samplers of that precision have their own CDF entries.
std::vector<double> around_entries(std::span<const double> masses) {
  std::vector<double> values;
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  double sum = 0.0;
  for (const double mass : masses) {
    sum += mass;
    const double entry = sum / total;
    const auto add = [&](double u) {
      if (u >= 0.0 && u < 1.0) values.push_back(u);
    };
    for (const double u : {std::nextafter(entry, 0.0), entry, std::nextafter(entry, 1.0)}) add(u);
    for (const double step : {0x1p-31, 0x1p-24}) {
      const double coarse = std::round(entry / step) * step;
      for (const double u : {coarse - step, coarse, coarse + step}) add(u);
    }
  }
  return values;
}

/// Points around one CDF entry.
constexpr int kAroundEntry = 9;
/// Points around the CDF entries of all rows that are looked at, about.
constexpr int kEntryPoints = 1 << 18;

/// Not at 0 in the other coordinate, which is an edge of its own.
bool is_next_to_one(SquarePoint u) {
  return std::max(u.s, u.t) >= 1.0 - 0x1p-24 && std::min(u.s, u.t) > 0.0;
}

/// The edges of equal cells and of equal bins over [0,1], each once, ascending.
std::vector<double> edges(int cells, int bins) {
  std::vector<double> all;
  for (int i = 0; i <= cells; ++i) all.push_back(static_cast<double>(i) / cells);
  for (int i = 1; i < bins; ++i) all.push_back(static_cast<double>(i) / bins);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<SquarePoint> random_points(const RandomStream& stream, std::uint64_t count) {
  std::vector<SquarePoint> points;
  points.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) points.push_back(stream.point(i));
  return points;
}

std::vector<TexelSample> samples_at(const BoundSampler& sampler,
                                    const std::vector<SquarePoint>& points) {
  std::vector<TexelSample> samples(points.size());
  sampler.sample(points, samples);
  return samples;
}

std::vector<PerSquare> densities_at(const BoundSampler& sampler,
                                    std::span<const TexelSample> samples) {
  std::vector<SquarePoint> positions;
  for (const TexelSample& sample : samples) positions.push_back(sample.at);
  std::vector<PerSquare> densities(positions.size());
  sampler.pdf_at(positions, densities);
  return densities;
}

/// Equal up to kSamePdf and what rounding makes of b, relative.
bool is_same_pdf(PerSquare a, PerSquare b, double rounding = 0.0) {
  return std::abs(a.value - b.value) <= (kSamePdf + rounding) * std::abs(b.value);
}

/// Fewer points than these that differ say nothing of where their pdf comes from.
constexpr std::size_t kFewestThatDiffer = 8;

std::optional<std::string_view> position_of_returned_pdf(const BoundSampler& sampler, Extent map) {
  // The plane's R2 sequence: points that lie evenly, and on no texel's edge.
  constexpr int kPoints = 1 << 12;
  std::vector<SquarePoint> points;
  for (int i = 1; i <= kPoints; ++i) {
    points.push_back(
        {std::fmod(i * 0.75487766624669276, 1.0), std::fmod(i * 0.56984029099805327, 1.0)});
  }
  std::vector<TexelSample> drawn;
  for (const TexelSample& sample : samples_at(sampler, points)) {
    if (is_on_map(sample, map)) drawn.push_back(sample);
  }
  const std::vector<PerSquare> densities = densities_at(sampler, drawn);
  std::vector<TexelSample> differ;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double rounding = sampler.pdf_rounding ? sampler.pdf_rounding(drawn[i].at) : 0.0;
    if (!is_same_pdf(densities[i], drawn[i].pdf, rounding)) differ.push_back(drawn[i]);
  }
  if (differ.size() < kFewestThatDiffer) return std::nullopt;
  for (const OtherPosition& other : kOtherPositions) {
    const bool all = std::all_of(differ.begin(), differ.end(), [&](const TexelSample& sample) {
      return is_same_pdf(sampler.pdf(other.of(sample.at, map)), sample.pdf);
    });
    if (all) return other.name;
  }
  return std::nullopt;
}

/// A rectangle of the square.
struct Piece {
  double left;
  double right;
  double bottom;
  double top;

  SquarePoint centre() const { return {0.5 * (left + right), 0.5 * (bottom + top)}; }
};

/// The integral over a piece of density(at).
template <class Density>
double integral_over(const Piece& piece, const Density& density) {
  return kRuleOverT.integrate(piece.bottom, piece.top, [&](double t) {
    return kRuleOverS.integrate(piece.left, piece.right, [&](double s) {
      return density(SquarePoint{s, t});
    });
  });
}

/// Densities at positions that are named first, asked for together, and then taken in the same
/// order.
class DensitiesInOrder {
 public:
  explicit DensitiesInOrder(const BoundSampler& sampler) : sampler_(&sampler) {}

  void name(SquarePoint at) { positions_.push_back(at); }
  void ask() {
    densities_.resize(positions_.size());
    sampler_->pdf_at(positions_, densities_);
    taken_ = 0;
  }
  double take() { return densities_[taken_++].value; }

 private:
  const BoundSampler* sampler_;
  std::vector<SquarePoint> positions_;
  std::vector<PerSquare> densities_;
  std::size_t taken_ = 0;
};

/// Rows of pieces whose masses are held at once.
constexpr std::size_t kRowsAtOnce = 32;

/// The masses of the pieces between these edges in s, and between two edges in t.
std::vector<double> masses_of_row(const BoundSampler& sampler, std::span<const double> across,
                                  double bottom, double top) {
  const auto piece_at = [&](std::size_t i) { return Piece{across[i], across[i + 1], bottom, top}; };
  DensitiesInOrder densities(sampler);
  for (std::size_t i = 0; i + 1 < across.size(); ++i) {
    integral_over(piece_at(i), [&](SquarePoint at) {
      densities.name(at);
      return 0.0;
    });
  }
  densities.ask();
  std::vector<double> masses;
  for (std::size_t i = 0; i + 1 < across.size(); ++i) {
    masses.push_back(
        integral_over(piece_at(i), [&](SquarePoint /*at*/) { return densities.take(); }));
  }
  return masses;
}

}  // namespace

namespace {

/// Masses of bins, given the parts that lie in them.
Grid<double> bins_of_parts(const BoundSampler& sampler,
                           std::span<const reference::BinnedPart> parts) {
  DensitiesInOrder densities(sampler);
  for (const reference::BinnedPart& part : parts) densities.name(part.centre);
  densities.ask();
  Grid<double> bins(kGateBins);
  for (const reference::BinnedPart& part : parts) {
    bins(part.column, part.row) += part.area * densities.take();
  }
  return bins;
}

/// Masses of bins that are cut out of the cells of a square.
Grid<double> mapped_bins(const BoundSampler& sampler, Extent cells, const Mapping& mapping) {
  const int depth = reference::depth_of_parts(mapping, cells);
  std::vector<Grid<double>> rows(static_cast<std::size_t>(cells.height), Grid<double>(kGateBins));
  parallel_for(rows.size(), [&](std::size_t row) {
    std::vector<reference::BinnedPart> parts;
    for (int x = 0; x < cells.width; ++x) {
      reference::visit_binned_parts(
          mapping, texel_cell(cells, x, static_cast<int>(row)), depth, kGateBins,
          [&](const reference::BinnedPart& part) { parts.push_back(part); });
    }
    rows[row] = bins_of_parts(sampler, parts);
  });
  Grid<double> bins(kGateBins);
  for (const Grid<double>& row : rows) {
    for (std::size_t i = 0; i < bins.values().size(); ++i) bins.values()[i] += row.values()[i];
  }
  return bins;
}

}  // namespace

OwnDensity integrate_pdf(const BoundSampler& sampler, Extent cells, const Mapping& mapping,
                         const std::vector<reference::BinnedPart>* parts) {
  const std::vector<double> across = edges(cells.width, kGateBins.width);
  const int pieces = (kFewestPieces + cells.height - 1) / cells.height;
  const std::vector<double> along = edges(cells.height * pieces, kGateBins.height);
  OwnDensity own{0.0, Grid<double>(kGateBins)};
  const std::size_t rows = along.size() - 1;
  std::array<std::vector<double>, kRowsAtOnce> masses;
  for (std::size_t first = 0; first < rows; first += kRowsAtOnce) {
    const std::size_t count = std::min(kRowsAtOnce, rows - first);
    for_rows(count, [&](std::size_t row) {
      masses[row] = masses_of_row(sampler, across, along[first + row], along[first + row + 1]);
    });
    for (std::size_t row = 0; row < count; ++row) {
      for (std::size_t i = 0; i + 1 < across.size(); ++i) {
        const double mass = masses[row][i];
        own.integral += mass;
        const auto [s, t] =
            Piece{across[i], across[i + 1], along[first + row], along[first + row + 1]}.centre();
        own.bins(cell_of(s, kGateBins.width), cell_of(t, kGateBins.height)) += mass;
      }
    }
  }
  if (!is_plain(mapping)) {
    own.bins =
        parts != nullptr ? bins_of_parts(sampler, *parts) : mapped_bins(sampler, cells, mapping);
  }
  for (double& mass : own.bins.values()) mass /= own.integral;
  return own;
}

CheckResult check_pdf_integral(const OwnDensity& own) {
  const double error = std::abs(own.integral - 1.0);
  const bool passed = error <= 1e-6;  // false for NaN
  return {TestId::pdf_integral, passed, error,
          passed ? "" : fmt::format("the pdf integrates to {:.9g}", own.integral)};
}

CheckResult check_returned_pdf(const BoundSampler& sampler, const RandomStream& stream,
                               std::uint64_t count) {
  CheckResult result{TestId::returned_pdf, true, 0.0, ""};
  const std::vector<SquarePoint> points = random_points(stream, count);
  const std::vector<TexelSample> samples = samples_at(sampler, points);
  DensitiesInOrder densities(sampler);
  // Invalid samples are counted by another test.
  const auto is_valid = [](const TexelSample& sample) { return sample.pdf.value > 0.0; };
  for (const TexelSample& sample : samples) {
    if (is_valid(sample)) densities.name(sample.at);
  }
  densities.ask();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SquarePoint u = points[i];
    const TexelSample& sample = samples[i];
    if (!is_valid(sample)) continue;
    const double error = std::abs(densities.take() / sample.pdf.value - 1.0);
    const double rounding = sampler.pdf_rounding ? sampler.pdf_rounding(sample.at) : 0.0;
    if (error - rounding <= result.worst) continue;
    result.worst = error - rounding;
    if (error <= kSamePdf + rounding) continue;
    result.passed = false;
    result.detail = fmt::format(
        "at u = ({:.17g}, {:.17g}) pdf() differs from the returned pdf by {:.3g}", u.s, u.t, error);
  }
  return result;
}

namespace {

CheckResult check_points(TestId test, const BoundSampler& sampler, const Expectation& expectation,
                         const std::vector<SquarePoint>& points) {
  const Extent extent = expectation.masses.extent();
  CheckResult result{test, true, 0.0, ""};
  std::uint64_t failures = 0;
  const std::vector<TexelSample> samples = samples_at(sampler, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SquarePoint u = points[i];
    const TexelSample& sample = samples[i];
    const bool correct = is_on_map(sample, extent) &&
                         cell_of(sample.at.s, extent.width) == sample.x &&
                         cell_of(sample.at.t, extent.height) == sample.y &&
                         expectation.masses(sample.x, sample.y) > 0.0;
    if (correct) continue;
    if (failures++ == 0) {
      result.detail =
          fmt::format("u = ({:.17g}, {:.17g}) gives texel ({}, {}) at ({:.9g}, {:.9g}), pdf {:.3g}",
                      u.s, u.t, sample.x, sample.y, sample.at.s, sample.at.t, sample.pdf.value);
    }
  }
  result.passed = failures == 0;
  result.worst = static_cast<double>(failures) / static_cast<double>(points.size());
  if (failures > 0) {
    result.detail =
        fmt::format("{} of {} edge points leave the map or reach a texel without light; first: {}",
                    failures, points.size(), result.detail);
  }
  return result;
}

}  // namespace

std::array<CheckResult, 2> check_edges(const BoundSampler& sampler,
                                       const Expectation& expectation) {
  std::vector<SquarePoint> points = edge_points(expectation);
  const auto last = std::stable_partition(points.begin(), points.end(), is_next_to_one);
  const std::vector<SquarePoint> others(last, points.end());
  points.erase(last, points.end());
  return {check_points(TestId::next_to_one, sampler, expectation, points),
          check_points(TestId::edge_points, sampler, expectation, others)};
}

CheckResult check_support(const DensityComparison& density) {
  CheckResult result{TestId::pdf_support,
                     density.undeclared_unreachable_cells == 0 && density.unlit_cells == 0,
                     density.unreachable_mass, ""};
  if (density.unlit_cells > 0) {
    const ComparedCell& cell = *density.first_unlit;
    result.detail = fmt::format(
        "{} cells where none is declared have a pdf, the first {:.3g} in "
        "texel ({}, {})",
        density.unlit_cells, cell.pdf, cell.x, cell.y);
  }
  if (density.unreachable_cells > 0) {
    const ComparedCell& cell = *density.first_unreachable;
    result.detail += fmt::format(
        "{}{} cells with {:.3g} of the light have the pdf 0, the first in texel ({}, {})",
        result.detail.empty() ? "" : "; ", density.unreachable_cells, density.unreachable_mass,
        cell.x, cell.y);
  }
  return result;
}

CheckResult check_declared_density(const DensityComparison& density) {
  CheckResult result{TestId::declared_density, density.cells_off == 0, density.largest_error, ""};
  if (!density.worst) return result;
  const ComparedCell& cell = *density.worst;
  result.detail =
      fmt::format("{} {} are off, the worst in texel ({}, {}): pdf {:.6g} where {:.6g} is declared",
                  density.cells_off, density.compared, cell.x, cell.y, cell.pdf, cell.declared);
  return result;
}

Inspection inspect(const BoundSampler& sampler, const Expectation& expectation,
                   const MassRounding& rounding) {
  Inspection found{.own = {std::nan(""), Grid<double>(kGateBins, std::nan(""))},
                   .density = {},
                   .edges = {},
                   .returned_pdf_of = {},
                   .has_pdf = sampler.has_pdf(),
                   .has_weights = sampler.has_weights,
                   .takes_points = sampler.takes_points()};
  if (found.has_pdf) {
    found.own = integrate_pdf(sampler, expectation.smooth_cells(), expectation.mapping,
                              expectation.parts.get());
    found.density = compare_density(sampler, expectation, rounding);
  }
  if (found.takes_points) found.edges = check_edges(sampler, expectation);
  if (found.takes_points && found.has_pdf && found.has_weights) {
    found.returned_pdf_of = position_of_returned_pdf(sampler, expectation.masses.extent());
  }
  return found;
}

CheckResult check_same_texel(const BoundSampler& sampler, const BoundSampler& other,
                             const Expectation& expectation, const RandomStream& stream,
                             std::uint64_t count) {
  CheckResult result{TestId::same_texel, true, 0.0, ""};
  std::vector<SquarePoint> points = edge_points(expectation);
  const std::vector<SquarePoint> random = random_points(stream, count);
  points.insert(points.end(), random.begin(), random.end());
  const std::vector<TexelSample> samples = samples_at(sampler, points);
  const std::vector<TexelSample> expected = samples_at(other, points);
  std::uint64_t failures = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SquarePoint u = points[i];
    const TexelSample& a = samples[i];
    const TexelSample& b = expected[i];
    if (a.x == b.x && a.y == b.y) continue;
    if (failures++ == 0) {
      result.detail = fmt::format("u = ({:.17g}, {:.17g}): texel ({}, {}) instead of ({}, {})", u.s,
                                  u.t, a.x, a.y, b.x, b.y);
    }
  }
  result.passed = failures == 0;
  result.worst = static_cast<double>(failures) / static_cast<double>(points.size());
  return result;
}

std::vector<SquarePoint> edge_points(const Expectation& expectation) {
  std::vector<SquarePoint> points;
  for (const double s : kCorners) {
    for (const double t : kCorners) points.push_back({s, t});
  }
  for (const double t : around_entries(expectation.rows)) points.push_back({0.5, t});

  const auto [width, height] = expectation.masses.extent();
  const int visits = std::max(16, kEntryPoints / (kAroundEntry * width));
  double below = 0.0;
  int visited = 0;
  for (int y = 0; y < height; ++y) {
    const double mass = expectation.rows[static_cast<std::size_t>(y)];
    if (mass > 0.0 && y * visits >= visited * height) {
      ++visited;
      for (const double s : around_entries(expectation.masses.row(y))) {
        points.push_back({s, below + 0.5 * mass});
      }
    }
    below += mass;
  }
  return points;
}

}  // namespace lightproof
