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
    alignas(64) double scaled_s[kBatchBlock];  ///< in units of 2^-31
    alignas(64) double scaled_t[kBatchBlock];
    alignas(64) std::int64_t whole_s[kBatchBlock];  ///< the same without fractions
    alignas(64) std::int64_t whole_t[kBatchBlock];
    alignas(64) std::int64_t y[kBatchBlock];
    alignas(64) std::int64_t row[kBatchBlock];   ///< its knots: the lower and the upper one
    alignas(64) std::int64_t part[kBatchBlock];  ///< of the guides of columns
    alignas(64) std::int64_t x[kBatchBlock];
    alignas(64) std::int64_t column[kBatchBlock];  ///< its knots
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
      const Number s = hn::Mul(load(points.s + i), number(kCdfOne));
      const Number t = hn::Mul(load(points.t + i), number(kCdfOne));
      store(s, block.scaled_s + i);
      store(t, block.scaled_t + i);
      store(to_whole(s), block.whole_s + i);
      store(to_whole(t), block.whole_t + i);
    });
    find_cells(guides_.rows, count, block.whole_t, {block.y, block.row},
               [&](std::size_t /*i*/, std::uint32_t u) HWY_ATTR {
                 return Where{guides_.rows.part(0, u), table_.rows};
               });
    for (std::size_t i = 0; i < count; ++i) {
      const auto u = static_cast<std::uint32_t>(block.whole_s[i]);
      const std::size_t part = guides_.columns.part(static_cast<std::size_t>(block.y[i]), u);
      block.part[i] = static_cast<std::int64_t>(part);
      __builtin_prefetch(guides_.columns.first + part);
    }
  }

  /// Asks for the knots that a column's guide names.
  HWY_INLINE void fetch_columns(const Block& block, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t* knots = table_.row(static_cast<std::size_t>(block.y[i]));
      const std::size_t first = guides_.columns.first[block.part[i]];
      __builtin_prefetch(knots + first);
      __builtin_prefetch(knots + first + 2);
    }
  }

  HWY_INLINE void choose_columns(Block& block, std::size_t count) const {
    find_cells(guides_.columns, count, block.whole_s, {block.x, block.column},
               [&](std::size_t i, std::uint32_t /*u*/) HWY_ATTR {
                 return Where{static_cast<std::size_t>(block.part[i]),
                              table_.row(static_cast<std::size_t>(block.y[i]))};
               });
  }

  HWY_INLINE Found cells(const Block& block, std::size_t i) const {
    const Share along = share(block.row + i, block.scaled_t + i);
    const Share across = share(block.column + i, block.scaled_s + i);
    return {to_number(load(block.x + i)), to_number(load(block.y + i)), across.fraction,
            along.fraction, hn::Mul(hn::Mul(number(0x1p-62), along.units), across.units)};
  }

 private:
  struct Share {
    Number units;
    Number fraction;
  };
  static HWY_INLINE Share share(const std::int64_t* knots, const double* scaled) {
    const Int pair = load(knots);
    const Number low = to_number(low_half(pair));
    const Number units = hn::Sub(to_number(high_half(pair)), low);
    return {units, hn::Div(hn::Sub(load(scaled), low), units)};
  }

  struct Where {
    std::size_t part;  ///< of the guide
    const std::uint32_t* knots;
  };
  /// Cells and their lower and upper knots.
  struct Cells {
    std::int64_t* index;
    std::int64_t* knots;
  };

  /// Guesses all cells without a branch, then corrects the few wrong ones.
  template <class Locate>
  static HWY_INLINE void find_cells(const Guides::View& guides, std::size_t count,
                                    const std::int64_t* whole, Cells cells, const Locate& locate) {
    std::array<std::uint16_t, kBatchBlock> wrong;
    std::size_t wrongs = 0;
    const auto set = [&](std::size_t i, std::size_t cell, const std::uint32_t* knots) HWY_ATTR {
      cells.index[i] = static_cast<std::int64_t>(cell);
      std::memcpy(cells.knots + i, knots + cell, sizeof cells.knots[i]);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const auto u = static_cast<std::uint32_t>(whole[i]);
      const Where where = locate(i, u);
      const std::size_t cell = guides.guess(where.part, where.knots, u);
      set(i, cell, where.knots);
      wrong[wrongs] = static_cast<std::uint16_t>(i);
      wrongs += where.knots[cell + 1] <= u ? 1 : 0;
    }
    for (std::size_t k = 0; k < wrongs; ++k) {
      const std::size_t i = wrong[k];
      const auto u = static_cast<std::uint32_t>(whole[i]);
      const Where where = locate(i, u);
      const auto from = static_cast<std::size_t>(cells.index[i]);
      set(i, guides.find_from(from, where.part, where.knots, u), where.knots);
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

  template <int kStage>
  HWY_INLINE void stage(Block& block, std::size_t count, TexelSample* out) const {
    if constexpr (kStage == 0) {
      guided_.choose_rows(block, block.cells, count);
    } else if constexpr (kStage == 1) {
      guided_.fetch_columns(block.cells, count);
    } else {
      guided_.choose_columns(block.cells, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        const GuidedLanes::Found found = guided_.cells(block.cells, i);
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
