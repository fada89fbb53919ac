// Inversion by bisection and by descent of trees, for many samples at once. All samples of a block
// take a step together: a sample waits for what its step reads, but the samples do not wait for
// each other.
#if defined(LIGHTPROOF_SAMPLERS_SEARCH_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_SEARCH_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_SEARCH_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_SEARCH_SIMD_INL_H
#endif

#include "lightproof/samplers/binary_search.h"
#include "lightproof/samplers/cdf_inversion_simd-inl.h"
#include "lightproof/samplers/eytzinger.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

/// A search of one distribution per sample, among several of the same number of cells.
struct Search {
  const std::int32_t* whole;         ///< what is looked for, in units of 2^-31
  const std::int64_t* distribution;  ///< in which
  std::int64_t* cell;                ///< that it lies in
  std::int64_t* entries;             ///< the cell's CDF entries, the lower and the upper one
};

/// Bisection of sorted CDF entries, those of all distributions one after the other.
class BisectionKernel {
 public:
  BisectionKernel(const std::uint32_t* entries, int cells)
      : entries_(entries), cells_(static_cast<std::size_t>(cells)) {}

  HWY_INLINE void find(const Search& search, std::size_t count) const {
    alignas(64) std::int64_t start[kBatchBlock];  // of the distribution, in bytes
    alignas(64) std::int64_t at[kBatchBlock];     // of the cell's lower CDF entry, in bytes
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      store(hn::ShiftLeft<2>(product(load(search.distribution + i), cells_ + 1)), start + i);
      store(load(start + i), at + i);
    });
    for (std::size_t cells = cells_; cells > 1; cells -= cells / 2) {
      const std::size_t half = cells / 2;
      const Int step = whole(static_cast<std::int64_t>(half * sizeof(std::uint32_t)));
      read_words(entries_ + half, at, count, search.entries);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        const auto before = hn::Gt(low_half(load(search.entries + i)), wanted(search, i));
        store(hn::Add(load(at + i), hn::IfThenZeroElse(before, step)), at + i);
      });
    }
    read_words(entries_, at, count, search.entries);
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      store(hn::ShiftRight<2>(hn::Sub(load(at + i), load(start + i))), search.cell + i);
    });
  }

 private:
  static HWY_INLINE Int wanted(const Search& search, std::size_t i) {
    return hn::PromoteTo(Int64Tag(), load(search.whole + i));
  }

  const std::uint32_t* entries_;
  std::size_t cells_;
};

/// Descent of CdfTrees.
class TreeKernel {
 public:
  explicit TreeKernel(const CdfTrees::View& trees) : trees_(trees) {}

  HWY_INLINE void find(const Search& search, std::size_t count) const {
    Nodes nodes;
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      const Int root = product(load(search.distribution + i), trees_.words_per_tree);
      store(hn::ShiftLeft<2>(root), nodes.start + i);
      store(whole(1), search.cell + i);
      store(whole(std::int64_t{kCdfOne} << 32U), search.entries + i);
      point_to(nodes, whole(1), i);
    });
    for (unsigned level = 0; level < trees_.levels; ++level) {
      if (level + 4 < trees_.levels) fetch(trees_.words, nodes.below, count);
      read_words(trees_.words, nodes.at, count, nodes.words);
      for_vectors(count, [&](std::size_t i) HWY_ATTR { descend(search, nodes, i); });
    }
    const Int leaves = whole(std::int64_t{1} << trees_.levels);
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      store(hn::Sub(load(search.cell + i), leaves), search.cell + i);
    });
  }

 private:
  /// Where the search is, in bytes; the numbers of the nodes stand where the cells will.
  struct Nodes {
    alignas(64) std::int64_t start[kBatchBlock];  ///< where the tree begins, in bytes
    alignas(64) std::int64_t at[kBatchBlock];
    alignas(64) std::int64_t below[kBatchBlock];  ///< four levels down
    alignas(64) std::int64_t words[kBatchBlock];  ///< the nodes' words, in the lower halves
  };

  static HWY_INLINE void point_to(Nodes& nodes, Int node, std::size_t i) {
    const Int start = load(nodes.start + i);
    store(hn::Add(start, hn::ShiftLeft<2>(node)), nodes.at + i);
    store(hn::Add(start, hn::ShiftLeft<6>(node)), nodes.below + i);
  }

  static HWY_INLINE void descend(const Search& search, Nodes& nodes, std::size_t i) {
    const Int entry = low_half(load(nodes.words + i));
    const auto left = hn::Gt(entry, hn::PromoteTo(Int64Tag(), load(search.whole + i)));
    const Int entries = load(search.entries + i);
    const Int low = low_half(entries);
    const Int to_left = hn::Or(low, hn::ShiftLeft<32>(entry));
    const Int to_right = hn::Or(hn::Sub(entries, low), entry);
    store(hn::IfThenElse(left, to_left, to_right), search.entries + i);
    const Int parent = load(search.cell + i);
    const Int node = hn::Add(hn::Add(parent, parent), hn::IfThenZeroElse(left, whole(1)));
    store(node, search.cell + i);
    point_to(nodes, node, i);
  }

  CdfTrees::View trees_;
};

/// Finds rows, then columns, with one of the searches above.
template <class Finder>
class SearchKernel {
 public:
  static constexpr int kStages = 1;
  struct Block : BlockPoints {
    CdfCells cells;
  };

  SearchKernel(const Finder& rows, const Finder& columns, const TexelPositionsView& positions)
      : rows_(rows), columns_(columns), positions_(positions) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    CdfCells& cells = block.cells;
    alignas(64) std::int64_t all[kBatchBlock] = {};  // the one distribution of rows
    for_vectors(count, [&](std::size_t i) HWY_ATTR { set_whole(block, cells, i); });
    rows_.find({cells.whole_t, all, cells.y, cells.row}, count);
    columns_.find({cells.whole_s, cells.y, cells.x, cells.column}, count);
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      store_found(positions_, found_cells(block, cells, i), out + i);
    });
  }

 private:
  Finder rows_;
  Finder columns_;
  PositionKernel positions_;
};

struct BinarySearchKernel : SearchKernel<BisectionKernel> {
  explicit BinarySearchKernel(const BinarySearchView& view)
      : SearchKernel({view.table.rows, view.positions.extent.height},
                     {view.table.columns, view.positions.extent.width}, view.positions) {}
};

struct EytzingerKernel : SearchKernel<TreeKernel> {
  explicit EytzingerKernel(const EytzingerView& view)
      : SearchKernel(TreeKernel(view.finder.rows), TreeKernel(view.finder.columns),
                     view.positions) {}
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_SEARCH_SIMD_INL_H
