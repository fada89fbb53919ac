#include "lightproof/samplers/cdf_lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "lightproof/core/parallel.h"
#include "lightproof/samplers/cdf_table.h"

namespace lightproof {
namespace {

/// A run is narrow if that changes no texel's mass by more than this share of it.
constexpr double kNarrowError = 1.0 / 32.0;

Extent runs_of(Extent texels) {
  return {(texels.width + kRunTexels - 1) / kRunTexels, texels.height};
}

/// The texels of one run.
std::span<const double> run(const Grid<double>& weights, int column, int y) {
  const auto row = weights.row(y);
  const auto first = static_cast<std::size_t>(column) * kRunTexels;
  return row.subspan(first, std::min<std::size_t>(kRunTexels, row.size() - first));
}

double sum(std::span<const double> weights) {
  return std::accumulate(weights.begin(), weights.end(), 0.0);
}

template <class Integer, std::uint32_t kOne>
void set_entries(RunEntries<Integer, kOne>& run, std::span<const double> weights) {
  std::array<std::uint32_t, kRunTexels + 1> entries{};
  quantise_cdf(weights, std::span(entries).first(weights.size() + 1), kOne);
  run.upper.fill(run.kLast);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    run.upper[i] = static_cast<Integer>(std::min<std::uint32_t>(entries[i + 1], run.kLast));
  }
}

template <class Entries>
bool is_close(const Entries& entries, std::span<const double> weights) {
  const double total = sum(weights);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double share = weights[i] / total;
    if (std::abs(entries.mass(static_cast<int>(i)) - share) > kNarrowError * share) return false;
  }
  return true;
}

}  // namespace

CdfLines::CdfLines(const Grid<double>& weights)
    : extent_(runs_of(weights.extent())), narrow_(kBefore + extent_.count()), wide_(kBefore) {
  narrow_.front().upper.fill(Narrow::kLast);
  wide_.front().upper.fill(Wide::kLast);
  std::vector<std::vector<int>> wide_in_row(static_cast<std::size_t>(extent_.height));
  parallel_for(wide_in_row.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int column = 0; column < extent_.width; ++column) {
      const auto texels = run(weights, column, y);
      Narrow& entries = narrow_[kBefore + index(column, y)];
      // As it stays without light: the run itself has no mass then.
      entries.upper.fill(Narrow::kLast);
      if (!(sum(texels) > 0.0)) continue;
      set_entries(entries, texels);
      if (!is_close(entries, texels)) wide_in_row[row].push_back(column);
    }
  });
  for (int y = 0; y < extent_.height; ++y) {
    for (const int column : wide_in_row[static_cast<std::size_t>(y)]) {
      const std::size_t at = wide_.size();
      set_entries(wide_.emplace_back(), run(weights, column, y));
      narrow_[kBefore + index(column, y)] = where_wide(at);
    }
  }
}

Grid<double> run_weights(const Grid<double>& weights) {
  Grid<double> sums(runs_of(weights.extent()));
  parallel_for(static_cast<std::size_t>(sums.extent().height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int column = 0; column < sums.extent().width; ++column) {
      sums(column, y) = sum(run(weights, column, y));
    }
  });
  return sums;
}

}  // namespace lightproof
