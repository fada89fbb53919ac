// Inversion through guide tables, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_GUIDE_TABLE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_GUIDE_TABLE_LANES_INL_H
#undef LIGHTPROOF_SAMPLERS_GUIDE_TABLE_LANES_INL_H
#else
#define LIGHTPROOF_SAMPLERS_GUIDE_TABLE_LANES_INL_H
#endif

#include "lightproof/samplers/cdf_inversion_lanes-inl.h"
#include "lightproof/samplers/guide_table.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

/// Finds a row and a column of a CdfTable.
class GuidedLanes {
 public:
  struct Block : CdfCells {
    alignas(64) std::int64_t part[kBatchBlock];     ///< of the guides of rows, then of columns
    alignas(64) std::int64_t columns[kBatchBlock];  ///< where the knots of the row's columns begin
    alignas(64) std::int64_t first_knot[kBatchBlock];  ///< and where those of a part begin
  };

  GuidedLanes(const CdfTable::View& table, const GuidedKnots::View& guides)
      : table_(table), guides_(guides) {}

  HWY_INLINE void choose_rows(const BlockPoints& points, Block& block, std::size_t count) const {
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      set_whole(points, block, i);
      store(part_of(guides_.rows, load(block.whole_t + i)), block.part + i);
    });
    Knots knots;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint16_t first = guides_.rows.first[block.part[i]];
      block.y[i] = first;
      knots.read(i, table_.rows + first);
    }
    find_cells(guides_.rows, count, knots, {block.whole_t, block.part, block.y, block.row},
               [&](std::size_t /*i*/) HWY_ATTR { return table_.rows; });
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      const Int y = load(block.y + i);
      store(product(y, table_.stride), block.columns + i);
      const Int guide = product(y, guides_.columns.parts);
      store(hn::Add(guide, part_of(guides_.columns, load(block.whole_s + i))), block.part + i);
    });
    for (std::size_t i = 0; i < count; ++i) {
      __builtin_prefetch(guides_.columns.first + block.part[i]);
    }
  }

  /// Reads the guides, and asks for the knots that they name.
  HWY_INLINE void begin_columns(Block& block, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint16_t first = guides_.columns.first[block.part[i]];
      block.x[i] = first;
      block.first_knot[i] = block.columns[i] + first;
      const std::uint32_t* knots = table_.columns + block.first_knot[i];
      __builtin_prefetch(knots);
      __builtin_prefetch(knots + kKnots - 1);
    }
  }

  HWY_INLINE void choose_columns(Block& block, std::size_t count) const {
    Knots knots;
    for (std::size_t i = 0; i < count; ++i) knots.read(i, table_.columns + block.first_knot[i]);
    find_cells(guides_.columns, count, knots, {block.whole_s, block.part, block.x, block.column},
               [&](std::size_t i) HWY_ATTR { return table_.columns + block.columns[i]; });
  }

 private:
  static HWY_INLINE Int part_of(const Guides::View& guides, Half whole) {
    return hn::PromoteTo(Whole(), hn::ShiftRightSame(whole, static_cast<int>(guides.shift)));
  }

  /// Knots that are read for a part of a guide: those of the cell that it begins in and of the two
  /// after it.
  static constexpr std::size_t kKnots = 4;
  static_assert(kKnots - 2 == CdfTable::kKnotsAfter);

  struct Knots {
    HWY_INLINE void read(std::size_t i, const std::uint32_t* from) {
      std::memcpy(of + kKnots * i, from, sizeof(std::uint32_t) * kKnots);
    }
    alignas(64) std::uint32_t of[kBatchBlock * kKnots];
  };

  /// What is looked for, and what is found.
  struct Wanted {
    const std::int32_t* whole;
    const std::int64_t* part;
    std::int64_t* cell;   ///< that the part begins in, then the one that is sought
    std::int64_t* knots;  ///< of the cell, the lower and the upper one
  };

  /// Chooses among the first three cells of all parts, then corrects the few samples that lie in
  /// none of them. knots_of(i): where the knots of that sample's distribution begin.
  template <class KnotsOf>
  static HWY_INLINE void find_cells(const Guides::View& guides, std::size_t count,
                                    const Knots& first_knots, const Wanted& wanted,
                                    const KnotsOf& knots_of) {
    Marks others;
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      others.set(i, choose(first_knots.of + kKnots * i, wanted, i));
    });
    others.for_each(count, [&](std::size_t i) HWY_ATTR {
      const auto from = static_cast<std::size_t>(wanted.cell[i]);
      const auto part = static_cast<std::size_t>(wanted.part[i]);
      const std::uint32_t* knots = knots_of(i);
      const std::size_t cell =
          guides.find_from(from, part, knots, static_cast<std::uint32_t>(wanted.whole[i]));
      wanted.cell[i] = static_cast<std::int64_t>(cell);
      std::memcpy(wanted.knots + i, knots + cell, sizeof wanted.knots[i]);
    });
  }

  /// Returns which samples lie in a cell after these.
  static HWY_INLINE hn::Mask<Whole> choose(const std::uint32_t* four, const Wanted& wanted,
                                           std::size_t i) {
    const auto [first, last] = load_pairs(four);  // knots 0 and 1; knots 2 and 3
    const Int u = hn::PromoteTo(Whole(), load(wanted.whole + i));
    // What follows the last knot of all, which is above u, may be anything.
    const auto after_first = hn::Not(hn::Gt(high_half(first), u));
    const auto after_second = hn::And(after_first, hn::Not(hn::Gt(low_half(last), u)));
    const auto after_third = hn::And(after_second, hn::Not(hn::Gt(high_half(last), u)));
    const Int middle = hn::Or(high_half(first), hn::ShiftLeft<32>(last));
    const Int steps =
        hn::Add(hn::VecFromMask(Whole(), after_first), hn::VecFromMask(Whole(), after_second));
    store(hn::Sub(load(wanted.cell + i), steps), wanted.cell + i);
    store(hn::IfThenElse(after_second, last, hn::IfThenElse(after_first, middle, first)),
          wanted.knots + i);
    return after_third;
  }

  CdfTable::View table_;
  GuidedKnots::View guides_;
};

class GuideTableLanes {
 public:
  static constexpr int kStages = 3;
  struct Block : BlockPoints {
    GuidedLanes::Block cells;
  };

  explicit GuideTableLanes(const GuideTableView& view)
      : guided_(view.table, view.finder), places_(view.places) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    if constexpr (kStage == 0) {
      guided_.choose_rows(block, block.cells, count);
    } else if constexpr (kStage == 1) {
      guided_.begin_columns(block.cells, count);
    } else {
      guided_.choose_columns(block.cells, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        store_found(places_, found_cells(block, block.cells, i), out + i);
      });
    }
  }

 private:
  GuidedLanes guided_;
  LanePlaces places_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_GUIDE_TABLE_LANES_INL_H
