#include "lightproof/gate/successive.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "lightproof/samplers/sampler.h"
#include "lightproof/stats/independence.h"

namespace lightproof {
namespace {

const std::vector<double>& run_edges() {
  static const std::vector<double> edges =
      irwin_hall_quantiles(static_cast<int>(kRunLength), kRunCells);
  return edges;
}

}  // namespace

std::uint8_t cells_code(const TransformedSample& sample) {
  if (std::isnan(sample.marginal)) return kPairedCells * kPairedCells;
  return static_cast<std::uint8_t>(kPairedCells * cell_of(sample.marginal, kPairedCells) +
                                   cell_of(sample.conditional, kPairedCells));
}

void SuccessiveCounts::add_pairs(std::span<const std::uint8_t> codes) {
  std::vector<std::uint32_t> counts;
  for (std::size_t k = 0; k < kLags.size(); ++k) {
    counts.assign(kStride * kStride, 0);
    for (std::size_t i = 0; i + kLags[k] < codes.size(); ++i) {
      ++counts[kStride * codes[i] + codes[i + kLags[k]]];
    }
    codes_[k].resize(kStride * kStride);
    std::transform(counts.begin(), counts.end(), codes_[k].begin(), codes_[k].begin(),
                   std::plus<>());
  }
}

void SuccessiveCounts::add_runs(std::span<const TransformedSample> samples) {
  for (std::size_t i = 0; i + kRunLength <= samples.size(); i += kRunLength) {
    double marginal = 0.0;
    double conditional = 0.0;
    for (const TransformedSample& sample : samples.subspan(i, kRunLength)) {
      marginal += sample.marginal;
      conditional += sample.conditional;
    }
    if (std::isnan(marginal)) continue;
    const auto cell = [](double sum) {
      const auto edge = std::upper_bound(run_edges().begin(), run_edges().end(), sum);
      return static_cast<std::size_t>(edge - run_edges().begin());
    };
    ++runs_[0][cell(marginal)];
    ++runs_[1][cell(conditional)];
  }
}

void SuccessiveCounts::merge(const SuccessiveCounts& other) {
  for (std::size_t k = 0; k < kLags.size(); ++k) {
    if (other.codes_[k].empty()) continue;
    codes_[k].resize(kStride * kStride);
    std::transform(codes_[k].begin(), codes_[k].end(), other.codes_[k].begin(), codes_[k].begin(),
                   std::plus<>());
  }
  for (std::size_t c = 0; c < runs_.size(); ++c) {
    std::transform(runs_[c].begin(), runs_[c].end(), other.runs_[c].begin(), runs_[c].begin(),
                   std::plus<>());
  }
}

PairCounts SuccessiveCounts::pairs(std::size_t lag) const {
  PairCounts counts;
  counts.pairs.fill(Grid<std::uint64_t>({kPairedCells, kPairedCells}));
  if (codes_[lag].empty()) return counts;
  for (std::size_t earlier = 0; earlier < kCodes; ++earlier) {
    for (std::size_t later = 0; later < kCodes; ++later) {
      const std::uint64_t count = codes_[lag][kStride * earlier + later];
      const auto marginal = [](std::size_t code) { return static_cast<int>(code) / kPairedCells; };
      const auto conditional = [](std::size_t code) {
        return static_cast<int>(code) % kPairedCells;
      };
      counts.total += count;
      counts.pairs[PairCounts::marginal_marginal](marginal(later), marginal(earlier)) += count;
      counts.pairs[PairCounts::marginal_conditional](conditional(later), marginal(earlier)) +=
          count;
      counts.pairs[PairCounts::conditional_marginal](marginal(later), conditional(earlier)) +=
          count;
      counts.pairs[PairCounts::conditional_conditional](conditional(later), conditional(earlier)) +=
          count;
    }
  }
  return counts;
}

}  // namespace lightproof
