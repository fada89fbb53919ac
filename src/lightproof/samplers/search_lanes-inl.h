// Inversion by bisection and by descent of trees, for many samples at once. All samples of a block
// take a step together: a sample waits for what its step reads, but the samples do not wait for
// each other.
#if defined(LIGHTPROOF_SAMPLERS_SEARCH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_SEARCH_LANES_INL_H
#undef LIGHTPROOF_SAMPLERS_SEARCH_LANES_INL_H
#else
#define LIGHTPROOF_SAMPLERS_SEARCH_LANES_INL_H
#endif

#include "lightproof/samplers/binary_search.h"
#include "lightproof/samplers/cdf_inversion_lanes-inl.h"
#include "lightproof/samplers/eytzinger.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

/// A search of one distribution per sample, among several of the same number of cells.
struct SearchBlock {
  const std::int32_t* whole;         ///< what is looked for, in units of 2^-31
  const std::int64_t* distribution;  ///< in which
  std::int64_t* cell;                ///< that it lies in
  std::int64_t* knots;               ///< of the cell, the lower and the upper one
};

/// Sorted knots of several distributions, one after the other.
class BisectionLanes {
 public:
  BisectionLanes(const std::uint32_t* knots, int cells)
      : knots_(knots), cells_(static_cast<std::size_t>(cells)) {}

  HWY_INLINE void find(const SearchBlock& search, std::size_t count) const {
    for_vectors(count, [&](std::size_t i) HWY_ATTR { store(whole(0), search.cell + i); });
    for (std::size_t cells = cells_; cells > 1; cells -= cells / 2) {
      const Int half = whole(static_cast<std::int64_t>(cells / 2));
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        const Int cell = load(search.cell + i);
        const Int knot = low_half(pair_at(search, hn::Add(cell, half), i));
        const Int u = hn::PromoteTo(Whole(), load(search.whole + i));
        store(hn::Add(cell, hn::IfThenZeroElse(hn::Gt(knot, u), half)), search.cell + i);
      });
    }
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      store(pair_at(search, load(search.cell + i), i), search.knots + i);
    });
  }

 private:
  /// The knot before a cell and, in the upper half, the one after it.
  HWY_INLINE Int pair_at(const SearchBlock& search, Int cell, std::size_t i) const {
    const Int first = product(load(search.distribution + i), cells_ + 1);
    return gather(knots_, hn::ShiftLeft<2>(hn::Add(first, cell)));
  }

  const std::uint32_t* knots_;
  std::size_t cells_;
};

class TreeLanes {
 public:
  explicit TreeLanes(const KnotTrees::View& trees) : trees_(trees) {}

  HWY_INLINE void find(const SearchBlock& search, std::size_t count) const {
    // Nodes stand where the cells will.
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      store(whole(1), search.cell + i);
      store(whole(std::int64_t{kCdfOne} << 32U), search.knots + i);
    });
    for (unsigned level = 0; level < trees_.levels; ++level) {
      for_vectors(count, [&](std::size_t i) HWY_ATTR { descend(search, i); });
    }
    const Int leaves = whole(std::int64_t{1} << trees_.levels);
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      store(hn::Sub(load(search.cell + i), leaves), search.cell + i);
    });
  }

 private:
  HWY_INLINE void descend(const SearchBlock& search, std::size_t i) const {
    const Int node = load(search.cell + i);
    const Int tree = product(load(search.distribution + i), trees_.words_per_tree);
    const Int knot = low_half(gather(trees_.words, hn::ShiftLeft<2>(hn::Add(tree, node))));
    const auto left = hn::Gt(knot, hn::PromoteTo(Whole(), load(search.whole + i)));
    const Int knots = load(search.knots + i);
    const Int to_left = hn::Or(low_half(knots), hn::ShiftLeft<32>(knot));
    const Int to_right = hn::Or(hn::Sub(knots, low_half(knots)), knot);
    store(hn::IfThenElse(left, to_left, to_right), search.knots + i);
    const Int right = hn::IfThenZeroElse(left, whole(1));
    store(hn::Add(hn::Add(node, node), right), search.cell + i);
  }

  KnotTrees::View trees_;
};

/// Finds rows, then columns, with one of the searches above.
template <class Search>
class SearchLanes {
 public:
  static constexpr int kStages = 1;
  struct Block : BlockPoints {
    CdfCells cells;
  };

  SearchLanes(const Search& rows, const Search& columns, const TexelPlacesView& places)
      : rows_(rows), columns_(columns), places_(places) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    CdfCells& cells = block.cells;
    alignas(64) std::int64_t all[kBatchBlock] = {};  // the one distribution of rows
    for_vectors(count, [&](std::size_t i) HWY_ATTR { set_whole(block, cells, i); });
    rows_.find({cells.whole_t, all, cells.y, cells.row}, count);
    columns_.find({cells.whole_s, cells.y, cells.x, cells.column}, count);
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      store_found(places_, found_cells(block, cells, i), out + i);
    });
  }

 private:
  Search rows_;
  Search columns_;
  LanePlaces places_;
};

struct BinarySearchLanes : SearchLanes<BisectionLanes> {
  explicit BinarySearchLanes(const BinarySearchView& view)
      : SearchLanes({view.table.rows, view.places.extent.height},
                    {view.table.columns, view.places.extent.width}, view.places) {}
};

struct EytzingerLanes : SearchLanes<TreeLanes> {
  explicit EytzingerLanes(const EytzingerView& view)
      : SearchLanes(TreeLanes(view.finder.rows), TreeLanes(view.finder.columns), view.places) {}
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_SEARCH_LANES_INL_H
