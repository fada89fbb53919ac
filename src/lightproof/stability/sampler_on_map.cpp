#include "lightproof/stability/sampler_on_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lightproof/gate/density_check.h"

namespace lightproof {
namespace {

constexpr double kLast = 1.0 - 0x1p-53;

bool has_nan(const TexelSample& sample) {
  return std::isnan(sample.at.s) || std::isnan(sample.at.t) || std::isnan(sample.pdf.value);
}

int severity(StabilityOutcome outcome) {
  switch (outcome) {
    case StabilityOutcome::not_a_number:
      return 4;
    case StabilityOutcome::out_of_range:
      return 3;
    case StabilityOutcome::wrong:
      return 2;
    case StabilityOutcome::refused:
      return 1;
    default:
      return 0;
  }
}

/// Adds a sample if it is no number or does not exist; whether it did.
bool add_if_broken(SampleTally& tally, std::size_t i, const TexelSample& sample, Extent extent) {
  if (has_nan(sample)) {
    tally.add(StabilityOutcome::not_a_number, i, sample, "not a number");
    return true;
  }
  if (is_inside(sample, extent)) {
    if (std::isfinite(sample.pdf.value)) return false;
    tally.add(StabilityOutcome::not_a_number, i, sample, "no finite density");
    return true;
  }
  tally.add(StabilityOutcome::out_of_range, i, sample,
            fmt::format("off the map of {}x{}", extent.width, extent.height));
  return true;
}

/// A u.t that leads to a row: in the middle of its mass or, if that is so small that rounding moves
/// it, at an end.
std::optional<double> number_of_row(const SamplerOnMap& on_map, int row) {
  double below = 0.0;
  for (int y = 0; y < row; ++y) below += on_map.exact().rows[static_cast<std::size_t>(y)];
  const double mass = on_map.exact().rows[static_cast<std::size_t>(row)];
  for (const double t : {below + 0.5 * mass, below + 0.75 * mass, 0x1p-24, 1.0 - 0x1p-24, kLast}) {
    const SquarePoint point = {0.5, std::min(t, kLast)};
    if (on_map.at({&point, 1}).front().y == row) return point.t;
  }
  return std::nullopt;
}

}  // namespace

bool is_inside(const TexelSample& sample, Extent extent) {
  return sample.x >= 0 && sample.x < extent.width && sample.y >= 0 && sample.y < extent.height &&
         sample.at.s >= 0.0 && sample.at.s < 1.0 && sample.at.t >= 0.0 && sample.at.t < 1.0;
}

std::string point_text(SquarePoint u) { return fmt::format("u = ({:.9g}, {:.9g})", u.s, u.t); }

std::string sample_text(const TexelSample& sample) {
  return fmt::format("texel ({}, {}) at ({:.9g}, {:.9g}), density {:.4g}", sample.x, sample.y,
                     sample.at.s, sample.at.t, sample.pdf.value);
}

void SampleTally::add(StabilityOutcome outcome, std::size_t i, const TexelSample& sample,
                      std::string_view what) {
  ++failed_;
  if (severity(outcome) <= severity(finding_.outcome)) return;
  finding_.outcome = outcome;
  finding_.put_in = point_text(points_[i]);
  finding_.came_out = fmt::format("{}: {}", sample_text(sample), what);
}

Finding SampleTally::finding() && {
  finding_.amount = static_cast<double>(failed_) / static_cast<double>(points_.size());
  if (failed_ == 0) finding_.came_out = fmt::format("right at all of {} points", points_.size());
  if (failed_ > 1) finding_.came_out += fmt::format("; {} of {} points", failed_, points_.size());
  return std::move(finding_);
}

SamplerOnMap::SamplerOnMap(const SamplerUnderTest& method, EnvironmentMap map)
    : map_(std::move(map)),
      sampler_(method.bind(map_)),
      exact_(texel_expectation_of(map_, on_map(method.target, map_))),
      rounding_(method.rounding != nullptr ? method.rounding(map_.radiance.extent())
                                           : MassRounding{}) {}

std::vector<TexelSample> SamplerOnMap::at(std::span<const SquarePoint> points) const {
  std::vector<TexelSample> samples(points.size());
  sampler_.sample(points, samples);
  return samples;
}

bool SamplerOnMap::is_lit(const TexelSample& sample) const {
  if (exact_.density) return exact_.density(sample.at) > 0.0;
  return exact_.masses(sample.x, sample.y) > 0.0;
}

Finding check_samples(std::span<const SquarePoint> points, std::span<const TexelSample> samples,
                      Extent extent) {
  SampleTally tally(points);
  for (std::size_t i = 0; i < points.size(); ++i) add_if_broken(tally, i, samples[i], extent);
  return std::move(tally).finding();
}

Finding check_drawn(const SamplerOnMap& on_map, std::span<const SquarePoint> points) {
  const std::vector<TexelSample> samples = on_map.at(points);
  SampleTally tally(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TexelSample& sample = samples[i];
    if (add_if_broken(tally, i, sample, on_map.extent())) continue;
    if (!on_map.is_lit(sample)) {
      tally.add(StabilityOutcome::wrong, i, sample, "a texel without light");
    } else if (!(sample.pdf.value > 0.0)) {
      tally.add(StabilityOutcome::wrong, i, sample, "no positive density");
    }
  }
  return std::move(tally).finding();
}

Finding check_density(const SamplerOnMap& on_map) {
  const DensityComparison found =
      compare_density(on_map.sampler(), on_map.exact(), on_map.rounding());
  Finding finding{.amount = found.largest_error};
  if (found.worst && std::isnan(found.worst->pdf)) {
    finding.outcome = StabilityOutcome::not_a_number;
    finding.came_out = fmt::format("density NaN at texel ({}, {})", found.worst->x, found.worst->y);
  } else if (found.undeclared_unreachable_cells > 0) {
    finding.outcome = StabilityOutcome::wrong;
    finding.amount = found.unreachable_mass;
    finding.came_out =
        fmt::format("density 0 at {} lit {}, first at texel ({}, {})",
                    found.undeclared_unreachable_cells, found.compared,
                    found.first_undeclared_unreachable->x, found.first_undeclared_unreachable->y);
  } else if (found.unlit_cells > 0) {
    finding.outcome = StabilityOutcome::wrong;
    finding.came_out = fmt::format("density {:.4g} at {} {} without light, first at texel ({}, {})",
                                   found.first_unlit->pdf, found.unlit_cells, found.compared,
                                   found.first_unlit->x, found.first_unlit->y);
  } else if (found.cells_off > 0) {
    finding.outcome = StabilityOutcome::wrong;
    finding.came_out = fmt::format("density {:.6g} for {:.6g} at texel ({}, {}); {} {} off",
                                   found.worst->pdf, found.worst->declared, found.worst->x,
                                   found.worst->y, found.cells_off, found.compared);
  } else {
    finding.came_out = fmt::format("density within the declared rounding, at most {:.2g} off",
                                   found.largest_error);
  }
  return finding;
}

std::vector<bool> reached_columns(const SamplerOnMap& on_map, int row, double step) {
  std::vector<bool> reached(static_cast<std::size_t>(on_map.extent().width), false);
  const std::optional<double> found = number_of_row(on_map, row);
  if (!found) return reached;
  const double t = *found;
  const auto column_at = [&](std::uint64_t k) {
    const SquarePoint point = {static_cast<double>(k) * step, t};
    const int x = on_map.at({&point, 1}).front().x;
    if (x >= 0 && x < on_map.extent().width) reached[static_cast<std::size_t>(x)] = true;
    return x;
  };
  struct Span {
    std::uint64_t low;
    std::uint64_t high;
    int x_low;
    int x_high;
  };
  const auto last = static_cast<std::uint64_t>(1.0 / step) - 1;
  std::vector<Span> open = {{0, last, column_at(0), column_at(last)}};
  while (!open.empty()) {
    const Span span = open.back();
    open.pop_back();
    if (span.x_low == span.x_high || span.high - span.low <= 1) continue;
    const std::uint64_t middle = span.low + (span.high - span.low) / 2;
    const int x = column_at(middle);
    open.push_back({span.low, middle, span.x_low, x});
    open.push_back({middle, span.high, x, span.x_high});
  }
  return reached;
}

double misplaced_share(const SamplerOnMap& on_map, double step) {
  const int width = on_map.extent().width;
  const auto column_at = [&](std::uint64_t k) {
    const SquarePoint point = {static_cast<double>(k) * step, 0.5};
    return on_map.at({&point, 1}).front().x;
  };
  const int stride = std::max(1, width / 256);
  double exact = 0.0;
  double apart = 0.0;
  int looked_at = 0;
  for (int x = 0; x + 1 < width; ++x) {
    exact += on_map.exact().masses(x, 0) / on_map.exact().rows[0];
    if (x % stride != 0) continue;
    // The first number that leads beyond column x.
    std::uint64_t low = 0;
    auto high = static_cast<std::uint64_t>(1.0 / step);
    while (low < high) {
      const std::uint64_t middle = low + (high - low) / 2;
      if (column_at(middle) > x) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    apart += std::abs(static_cast<double>(low) * step - exact);
    ++looked_at;
  }
  return looked_at == 0 ? 0.0 : apart * (width - 1) / looked_at;
}

double lost_sky(const SamplerUnderTest& method, const SamplerOnMap& on_map) {
  const auto [width, height] = on_map.extent();
  const auto masses = on_map.exact().masses.values();
  const auto sun =
      static_cast<std::size_t>(std::max_element(masses.begin(), masses.end()) - masses.begin());
  double all = 0.0;
  double lost = 0.0;
  for (int y = 0; y < height; ++y) {
    const std::vector<bool> reached =
        method.resolution > 0.0 ? reached_columns(on_map, y, method.resolution)
                                : std::vector<bool>(static_cast<std::size_t>(width), true);
    for (int x = 0; x < width; ++x) {
      const auto texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x);
      if (texel == sun) continue;
      all += masses[texel];
      const double density = on_map.sampler().pdf({(x + 0.5) / width, (y + 0.5) / height}).value;
      if (!(density > 0.0) || !reached[static_cast<std::size_t>(x)]) lost += masses[texel];
    }
  }
  return lost / all;
}

Finding worse_of(Finding a, Finding b) {
  if (severity(b.outcome) > severity(a.outcome)) return b;
  if (severity(b.outcome) == severity(a.outcome) && b.amount > a.amount) {
    a.amount = b.amount;
    a.bound = b.bound;
  }
  return a;
}

}  // namespace lightproof
