#include "lightproof/samplers/eytzinger.h"

#include <bit>

#include "lightproof/core/parallel.h"

namespace lightproof {

CdfTrees::CdfTrees(std::size_t count, std::size_t cells)
    : levels_(static_cast<unsigned>(std::bit_width(cells - 1))),
      lines_per_tree_(((std::size_t{1} << levels_) + 15) / 16),
      lines_(count * lines_per_tree_ + 1) {  // vectors read a word behind what they need
  lines_.back() = {};
}

void CdfTrees::set(std::size_t tree, CdfEntries entries) {
  CacheLine* lines = &lines_[tree * lines_per_tree_];
  // A node of level l, the k-th from the left, has the rank (2k + 1) 2^(levels - l - 1).
  std::size_t node = 1;
  for (unsigned level = 0; level < levels_; ++level) {
    const std::size_t step = std::size_t{1} << (levels_ - level - 1);
    for (std::size_t rank = step; node < std::size_t{2} << level; ++node, rank += 2 * step) {
      lines[node / 16].words[node % 16] = rank < entries.size() ? entries[rank] : kCdfOne;
    }
  }
}

EytzingerEntries::EytzingerEntries(const CdfTable& table)
    : rows_(1, static_cast<std::size_t>(table.extent().height)),
      columns_(static_cast<std::size_t>(table.extent().height),
               static_cast<std::size_t>(table.extent().width)) {
  rows_.set(0, table.rows());
  parallel_for(static_cast<std::size_t>(table.extent().height),
               [&](std::size_t y) { columns_.set(y, table.columns(static_cast<int>(y))); });
}

}  // namespace lightproof
