// Inversion through guide tables, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_GUIDE_TABLE_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_GUIDE_TABLE_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_GUIDE_TABLE_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_GUIDE_TABLE_SIMD_INL_H
#endif

#include "lightproof/samplers/cdf_inversion_simd-inl.h"
#include "lightproof/samplers/guide_table.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

/// Finds a row and a column of a CdfTable.
class GuidedKernel {
 public:
  struct Block : CdfCells {
    alignas(64) std::int64_t part[kBatchBlock];  ///< part of the guides of rows, then of columns
    alignas(64)
        std::int64_t columns[kBatchBlock];  ///< where the CDF entries of the row's columns begin
    alignas(64) std::int64_t first_entry[kBatchBlock];  ///< and where those of a part begin
  };

  GuidedKernel(const CdfTable::View& table, const GuidedEntries::View& guides)
      : table_(table), guides_(guides) {}

  HWY_INLINE void choose_rows(const BlockPoints& points, Block& block, std::size_t count) const {
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      set_whole(points, block, i);
      store(part_of(guides_.rows, load(block.whole_t + i)), block.part + i);
    });
    Entries entries;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint16_t first = guides_.rows.first[block.part[i]];
      block.y[i] = first;
      entries.read(i, table_.rows + first);
    }
    find_cells(guides_.rows, count, entries, {block.whole_t, block.part, block.y, block.row},
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

  /// Reads the guides, and asks for the CDF entries that they name.
  HWY_INLINE void begin_columns(Block& block, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint16_t first = guides_.columns.first[block.part[i]];
      block.x[i] = first;
      block.first_entry[i] = block.columns[i] + first;
      const std::uint32_t* entries = table_.columns + block.first_entry[i];
      __builtin_prefetch(entries);
      __builtin_prefetch(entries + kEntries - 1);
    }
  }

  HWY_INLINE void choose_columns(Block& block, std::size_t count) const {
    Entries entries;
    for (std::size_t i = 0; i < count; ++i) entries.read(i, table_.columns + block.first_entry[i]);
    find_cells(guides_.columns, count, entries, {block.whole_s, block.part, block.x, block.column},
               [&](std::size_t i) HWY_ATTR { return table_.columns + block.columns[i]; });
  }

 private:
  static HWY_INLINE Int part_of(const Guides::View& guides, Int32s whole) {
    return hn::PromoteTo(Int64Tag(), hn::ShiftRightSame(whole, static_cast<int>(guides.shift)));
  }

  /// CDF entries that are read for a part of a guide: those of the cell that it begins in and of
  /// the two after it.
  static constexpr std::size_t kEntries = 4;
  static_assert(kEntries - 2 == CdfTable::kEntriesAfter);

  struct Entries {
    HWY_INLINE void read(std::size_t i, const std::uint32_t* from) {
      std::memcpy(of + kEntries * i, from, sizeof(std::uint32_t) * kEntries);
    }
    alignas(64) std::uint32_t of[kBatchBlock * kEntries];
  };

  /// What is looked for, and what is found.
  struct Wanted {
    const std::int32_t* whole;
    const std::int64_t* part;
    std::int64_t* cell;     ///< that the part begins in, then the one that is sought
    std::int64_t* entries;  ///< the cell's CDF entries, the lower and the upper one
  };

  /// Chooses among the first three cells of all parts, then corrects the few samples that lie in
  /// none of them. entries_of(i): where the CDF entries of that sample's distribution begin.
  template <class EntriesOf>
  static HWY_INLINE void find_cells(const Guides::View& guides, std::size_t count,
                                    const Entries& first_entries, const Wanted& wanted,
                                    const EntriesOf& entries_of) {
    Marks others;
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      others.set(i, choose(first_entries.of + kEntries * i, wanted, i));
    });
    others.for_each(count, [&](std::size_t i) HWY_ATTR {
      const auto from = static_cast<std::size_t>(wanted.cell[i]);
      const auto part = static_cast<std::size_t>(wanted.part[i]);
      const std::uint32_t* entries = entries_of(i);
      const std::size_t cell =
          guides.find_from(from, part, entries, static_cast<std::uint32_t>(wanted.whole[i]));
      wanted.cell[i] = static_cast<std::int64_t>(cell);
      std::memcpy(wanted.entries + i, entries + cell, sizeof wanted.entries[i]);
    });
  }

  /// Returns which samples lie in a cell after these.
  static HWY_INLINE hn::Mask<Int64Tag> choose(const std::uint32_t* four, const Wanted& wanted,
                                              std::size_t i) {
    const auto [first, last] = load_pairs(four);  // CDF entries 0 and 1; CDF entries 2 and 3
    const Int u = hn::PromoteTo(Int64Tag(), load(wanted.whole + i));
    // What follows the last CDF entry of all, which is above u, may be anything.
    const auto after_first = hn::Not(hn::Gt(high_half(first), u));
    const auto after_second = hn::And(after_first, hn::Not(hn::Gt(low_half(last), u)));
    const auto after_third = hn::And(after_second, hn::Not(hn::Gt(high_half(last), u)));
    const Int middle = hn::Or(high_half(first), hn::ShiftLeft<32>(last));
    const Int steps = hn::Add(hn::VecFromMask(Int64Tag(), after_first),
                              hn::VecFromMask(Int64Tag(), after_second));
    store(hn::Sub(load(wanted.cell + i), steps), wanted.cell + i);
    store(hn::IfThenElse(after_second, last, hn::IfThenElse(after_first, middle, first)),
          wanted.entries + i);
    return after_third;
  }

  CdfTable::View table_;
  GuidedEntries::View guides_;
};

class GuideTableKernel {
 public:
  static constexpr int kStages = 3;
  struct Block : BlockPoints {
    GuidedKernel::Block cells;
  };

  explicit GuideTableKernel(const GuideTableView& view)
      : guided_(view.table, view.finder), positions_(view.positions) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    if constexpr (kStage == 0) {
      guided_.choose_rows(block, block.cells, count);
    } else if constexpr (kStage == 1) {
      guided_.begin_columns(block.cells, count);
    } else {
      guided_.choose_columns(block.cells, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        store_found(positions_, found_cells(block, block.cells, i), out + i);
      });
    }
  }

 private:
  GuidedKernel guided_;
  PositionKernel positions_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_GUIDE_TABLE_SIMD_INL_H
