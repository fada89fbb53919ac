// PackedAlias, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_PACKED_ALIAS_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_PACKED_ALIAS_LANES_INL_H
#undef LIGHTPROOF_SAMPLERS_PACKED_ALIAS_LANES_INL_H
#else
#define LIGHTPROOF_SAMPLERS_PACKED_ALIAS_LANES_INL_H
#endif

#include "lightproof/samplers/lanes-inl.h"
#include "lightproof/samplers/packed_alias.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

class PackedAliasLanes {
 public:
  static constexpr int kStages = 2;
  struct Block : BlockPoints {
    alignas(64) std::int64_t offset[kBatchBlock];  ///< of the column's word, in bytes
    alignas(64) double within[kBatchBlock];        ///< the column
    alignas(64) std::int64_t word[kBatchBlock];
    alignas(64) std::int64_t code[kBatchBlock];  ///< where the probability is, in bytes
    alignas(64) double cell[kBatchBlock];
  };

  explicit PackedAliasLanes(const PackedAlias::View& table)
      : table_(table), places_(table.places) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    if constexpr (kStage == 0) {
      for_vectors(count, [&](std::size_t i) HWY_ATTR { choose_column(block, i); });
      fetch(table_.words.data(), block.offset, count);
    } else {
      read_words(table_.words.data(), block.offset, count, block.word);
      for_vectors(count, [&](std::size_t i) HWY_ATTR { choose_cell(block, i); });
      read_words(table_.palette.data(), block.code, count, block.word);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        places_.store_samples(places_.cell(load(block.cell + i)), load(block.within + i),
                              load(block.t + i), float_in(load(block.word + i)), out + i);
      });
    }
  }

 private:
  HWY_INLINE void choose_column(Block& block, std::size_t i) const {
    const Number scaled =
        hn::Mul(load(block.s + i), number(static_cast<double>(table_.words.size())));
    const Int column = to_whole(scaled);
    store(hn::ShiftLeft<3>(column), block.offset + i);
    store(hn::Sub(scaled, to_number(column)), block.within + i);
  }

  /// Leaves what remains of t.
  HWY_INLINE void choose_cell(Block& block, std::size_t i) const {
    const PackedAliasLayout& layout = table_.layout;
    const Int word = load(block.word + i);
    const Number share =
        hn::Mul(to_number(shifted(word, layout.threshold_at)), number(layout.unit));
    const Number choice = load(block.t + i);
    const Which own = hn::Lt(choice, share);
    const auto own_whole = hn::RebindMask(Whole(), own);
    const Int alias = hn::And(word, whole(static_cast<std::int64_t>(layout.alias_mask)));
    const Int column = hn::ShiftRight<3>(load(block.offset + i));
    const Int code = hn::And(
        hn::IfThenElse(own_whole, shifted(word, layout.own_at), shifted(word, layout.alias_at)),
        whole(static_cast<std::int64_t>(layout.code_mask)));
    store(hn::ShiftLeft<2>(code), block.code + i);
    store(to_number(hn::IfThenElse(own_whole, column, alias)), block.cell + i);
    store(rest_of_choice(choice, share, own), block.t + i);
  }

  static HWY_INLINE Int shifted(Int word, unsigned bits) {
    const hn::RebindToUnsigned<Whole> bits_of;
    return hn::BitCast(Whole(),
                       hn::ShiftRightSame(hn::BitCast(bits_of, word), static_cast<int>(bits)));
  }

  PackedAlias::View table_;
  LanePlaces places_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_PACKED_ALIAS_LANES_INL_H
