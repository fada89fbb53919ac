// PackedAlias, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_PACKED_ALIAS_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_PACKED_ALIAS_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_PACKED_ALIAS_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_PACKED_ALIAS_SIMD_INL_H
#endif

#include "lightproof/samplers/packed_alias.h"
#include "lightproof/samplers/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

class PackedAliasKernel {
 public:
  static constexpr int kStages = 2;
  struct Block : BlockPoints {
    alignas(64) std::int64_t offset[kBatchBlock];  ///< where the column's word begins, in bytes
    alignas(64) double within[kBatchBlock];        ///< the column
    alignas(64) std::int64_t word[kBatchBlock];
  };

  explicit PackedAliasKernel(const PackedAlias::View& table)
      : table_(table), positions_(table.positions) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    if constexpr (kStage == 0) {
      for_vectors(count, [&](std::size_t i) HWY_ATTR { choose_column(block, i); });
      fetch(table_.words.data(), block.offset, count);
    } else {
      read_words(table_.words.data(), block.offset, count, block.word);
      for_vectors(count, [&](std::size_t i) HWY_ATTR { choose_cell(block, i, out); });
    }
  }

 private:
  HWY_INLINE void choose_column(Block& block, std::size_t i) const {
    const Number scaled =
        hn::Mul(load(block.s + i), number(static_cast<double>(table_.words.size())));
    const Number column = hn::Trunc(scaled);
    store(hn::ShiftLeft<3>(to_whole(column)), block.offset + i);
    store(hn::Sub(scaled, column), block.within + i);
  }

  template <class Output>
  HWY_INLINE void choose_cell(const Block& block, std::size_t i, const Output& out) const {
    const PackedAliasLayout& layout = table_.layout;
    const Int word = load(block.word + i);
    const Number share =
        hn::Mul(to_number(shifted(word, layout.threshold_at)), number(layout.unit));
    const Number choice = load(block.t + i);
    const Mask own = hn::Lt(choice, share);
    const auto own_whole = hn::RebindMask(Int64Tag(), own);
    const Int alias = hn::And(word, whole(static_cast<std::int64_t>(layout.alias_mask)));
    const Int column = hn::ShiftRight<3>(load(block.offset + i));
    const Int code = hn::And(
        hn::IfThenElse(own_whole, shifted(word, layout.own_at), shifted(word, layout.alias_at)),
        whole(static_cast<std::int64_t>(layout.code_mask)));
    const hn::Rebind<float, Int64Tag> floats;
    const hn::RebindToUnsigned<Int64Tag> wide;
    const hn::Rebind<std::uint32_t, Int64Tag> narrow;
    const auto index = hn::BitCast(Int32Tag(), hn::TruncateTo(narrow, hn::BitCast(wide, code)));
    const auto masses = hn::GatherIndex(floats, table_.palette.data(), index);
    positions_.store_samples(positions_.cell(to_number(hn::IfThenElse(own_whole, column, alias))),
                             load(block.within + i), rest_of_choice(choice, share, own),
                             hn::PromoteTo(Numbers(), masses), out + i);
  }

  static HWY_INLINE Int shifted(Int word, unsigned bits) {
    const hn::RebindToUnsigned<Int64Tag> bits_of;
    return hn::BitCast(Int64Tag(),
                       hn::ShiftRightSame(hn::BitCast(bits_of, word), static_cast<int>(bits)));
  }

  PackedAlias::View table_;
  PositionKernel positions_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_PACKED_ALIAS_SIMD_INL_H
