// Inversion by descent of an implicit tree: the CDF entries of a row in the order of a
// breadth-first walk (Khuong and Morin 2017, "Array layouts for comparison-based searching"). Every
// step goes one level down; the sixteen CDF entries four levels below a CDF entry are one line of
// the cache, which is fetched ahead. O(log W + log H) per sample, texel for texel the same as
// LinearScan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>

#include "lightproof/core/huge_pages.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/cdf_inversion.h"

namespace lightproof {

/// A line of the cache, so that vectors of it begin on one.
struct alignas(64) CacheLine {
  std::uint32_t words[16];
};

/// The inner CDF entries of distributions of the same number of cells, as complete trees: filled up
/// with kCdfOne, which no random number reaches.
class CdfTrees {
 public:
  /// Makes `count` trees for distributions of so many cells each.
  CdfTrees(std::size_t count, std::size_t cells);
  /// Sets one tree to the CDF entries of a distribution, as CdfTable gives them.
  void set(std::size_t tree, CdfEntries entries);
  /// The cell of one tree that u lies in. The nearest CDF entries on either side of it stand on the
  /// way down.
  CdfCell find(std::size_t tree, std::uint32_t u) const {
    const CacheLine* lines = &lines_[tree * lines_per_tree_];
    std::uint32_t low = 0;
    std::uint32_t high = kCdfOne;
    std::size_t node = 1;
    for (unsigned level = 0; level < levels_; ++level) {
      if (level + 4 < levels_) __builtin_prefetch(lines + node);
      const std::uint32_t entry = lines[node / 16].words[node % 16];
      const bool right = entry <= u;
      low = right ? entry : low;
      high = right ? high : entry;
      node = 2 * node + (right ? 1 : 0);
    }
    return {low, high, static_cast<int>(node - (std::size_t{1} << levels_))};
  }
  std::size_t bytes() const { return lines_.size() * sizeof(CacheLine); }

  struct View {
    unsigned levels;
    std::size_t words_per_tree;
    const std::uint32_t* words;  ///< one behind the last may be read
  };
  View view() const {
    return {levels_, lines_per_tree_ * std::size(lines_[0].words), lines_[0].words};
  }

 private:
  unsigned levels_;
  std::size_t lines_per_tree_;
  TableVector<CacheLine> lines_;
};

/// The CDF entries of a table as trees of rows and of columns.
class EytzingerEntries {
 public:
  explicit EytzingerEntries(const CdfTable& table);
  CdfCell row(const CdfTable& /*table*/, std::uint32_t u) const { return rows_.find(0, u); }
  CdfCell column(const CdfTable& /*table*/, int y, std::uint32_t u) const {
    return columns_.find(static_cast<std::size_t>(y), u);
  }
  std::size_t bytes() const { return rows_.bytes() + columns_.bytes(); }

  struct View {
    CdfTrees::View rows;
    CdfTrees::View columns;
  };
  View view() const { return {rows_.view(), columns_.view()}; }

 private:
  CdfTrees rows_;
  CdfTrees columns_;
};

using Eytzinger = CdfInversion<EytzingerEntries>;
using EytzingerView = CdfInversionView<EytzingerEntries::View>;
static_assert(EnvSampler<Eytzinger>);

/// Draws a batch by vectors, as many whole ones as fit, from the front. Returns how many samples
/// these are.
std::size_t sample_vectors(const EytzingerView& table, const BatchPoints& points,
                           const BatchOutput& output);

}  // namespace lightproof
