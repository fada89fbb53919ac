// Inversion through guide tables, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_GUIDE_TABLE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_GUIDE_TABLE_LANES_INL_H
#undef LIGHTPROOF_SAMPLERS_GUIDE_TABLE_LANES_INL_H
#else
#define LIGHTPROOF_SAMPLERS_GUIDE_TABLE_LANES_INL_H
#endif

#include "lightproof/samplers/guide_table.h"
#include "lightproof/samplers/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

/// Finds a row and a column of a CdfTable.
class GuidedLanes {
 public:
  struct Block {
    alignas(64) std::int32_t whole_s[kBatchBlock];  ///< in units of 2^-31, without fractions
    alignas(64) std::int32_t whole_t[kBatchBlock];
    alignas(64) std::int64_t part[kBatchBlock];  ///< of the guides of rows, then of columns
    alignas(64) std::int64_t y[kBatchBlock];
    alignas(64) std::int64_t x[kBatchBlock];
    alignas(64) std::int64_t columns[kBatchBlock];  ///< where the knots of the row's columns begin
    alignas(64) std::int64_t row[kBatchBlock];      ///< its knots: the lower and the upper one
    alignas(64) std::int64_t column[kBatchBlock];   ///< its knots
  };
  /// Where in which cells the points lie.
  struct Found {
    Number x;
    Number y;
    Number across;
    Number along;
    Number mass;
  };

  GuidedLanes(const CdfTable::View& table, const GuidedKnots::View& guides)
      : table_(table), guides_(guides) {}

  HWY_INLINE void choose_rows(const BlockPoints& points, Block& block, std::size_t count) const {
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      const Half s = to_half(scaled(points.s + i));
      const Half t = to_half(scaled(points.t + i));
      store(s, block.whole_s + i);
      store(t, block.whole_t + i);
      store(part_of(guides_.rows, t), block.part + i);
    });
    find_cells(guides_.rows, count, {block.whole_t, block.part, block.y, block.row},
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

  /// Asks for the knots that a column's guide names.
  HWY_INLINE void fetch_columns(const Block& block, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t* knots =
          table_.columns + block.columns[i] + guides_.columns.first[block.part[i]];
      __builtin_prefetch(knots);
      __builtin_prefetch(knots + 2);
    }
  }

  HWY_INLINE void choose_columns(Block& block, std::size_t count) const {
    find_cells(guides_.columns, count, {block.whole_s, block.part, block.x, block.column},
               [&](std::size_t i) HWY_ATTR { return table_.columns + block.columns[i]; });
  }

  HWY_INLINE Found cells(const BlockPoints& points, const Block& block, std::size_t i) const {
    const Share along = share(block.row + i, scaled(points.t + i));
    const Share across = share(block.column + i, scaled(points.s + i));
    return {to_number(load(block.x + i)), to_number(load(block.y + i)), across.fraction,
            along.fraction, hn::Mul(hn::Mul(number(0x1p-62), along.units), across.units)};
  }

 private:
  /// In units of 2^-31.
  static HWY_INLINE Number scaled(const double* points) {
    return hn::Mul(load(points), number(kCdfOne));
  }
  static HWY_INLINE Int part_of(const Guides::View& guides, Half whole) {
    return hn::PromoteTo(Whole(), hn::ShiftRightSame(whole, static_cast<int>(guides.shift)));
  }

  struct Share {
    Number units;
    Number fraction;
  };
  static HWY_INLINE Share share(const std::int64_t* knots, Number scaled) {
    const Int pair = load(knots);
    const Number low = to_number(low_half(pair));
    const Number units = hn::Sub(to_number(high_half(pair)), low);
    return {units, hn::Div(hn::Sub(scaled, low), units)};
  }

  /// What is looked for, and what is found.
  struct Search {
    const std::int32_t* whole;
    const std::int64_t* part;
    std::int64_t* cell;
    std::int64_t* knots;  ///< of the cell, the lower and the upper one
  };

  /// Guesses all cells without a branch, then corrects the few wrong ones. knots_of(i): where the
  /// knots of that sample's distribution begin.
  template <class KnotsOf>
  static HWY_INLINE void find_cells(const Guides::View& guides, std::size_t count,
                                    const Search& search, const KnotsOf& knots_of) {
    std::array<std::uint16_t, kBatchBlock> wrong;
    std::size_t wrongs = 0;
    const auto set = [&](std::size_t i, std::size_t cell, const std::uint32_t* knots) HWY_ATTR {
      search.cell[i] = static_cast<std::int64_t>(cell);
      std::memcpy(search.knots + i, knots + cell, sizeof search.knots[i]);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const auto u = static_cast<std::uint32_t>(search.whole[i]);
      const std::uint32_t* knots = knots_of(i);
      const std::size_t cell = guides.guess(static_cast<std::size_t>(search.part[i]), knots, u);
      set(i, cell, knots);
      wrong[wrongs] = static_cast<std::uint16_t>(i);
      wrongs += knots[cell + 1] <= u ? 1 : 0;
    }
    for (std::size_t k = 0; k < wrongs; ++k) {
      const std::size_t i = wrong[k];
      const auto from = static_cast<std::size_t>(search.cell[i]);
      const auto part = static_cast<std::size_t>(search.part[i]);
      const std::uint32_t* knots = knots_of(i);
      set(i, guides.find_from(from, part, knots, static_cast<std::uint32_t>(search.whole[i])),
          knots);
    }
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
      guided_.fetch_columns(block.cells, count);
    } else {
      guided_.choose_columns(block.cells, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        const GuidedLanes::Found found = guided_.cells(block, block.cells, i);
        places_.store_samples({found.x, found.y}, found.across, found.along, found.mass, out + i);
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
