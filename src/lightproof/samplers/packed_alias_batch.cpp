#include "lightproof/samplers/packed_alias.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/samplers/packed_alias_batch.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include "lightproof/samplers/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

std::size_t draw(const PackedAlias::View& /*table*/, const BatchPoints& /*points*/,
                 std::span<TexelSample> /*samples*/) {
  return 0;
}

#else

class PackedAliasLanes {
 public:
  static constexpr int kStages = 2;
  struct Block : BlockPoints {
    alignas(64) std::int64_t offset[kBatchBlock];  ///< of the column's word, in bytes
    alignas(64) double within[kBatchBlock];        ///< the column
  };

  explicit PackedAliasLanes(const PackedAlias::View& table) : table_(table), places_(table.places) {}

  template <int kStage>
  HWY_INLINE void stage(Block& block, std::size_t i, TexelSample* out) const {
    kStage == 0 ? choose_column(block, i) : choose_cell(block, i, out);
  }

 private:
  HWY_INLINE void choose_column(Block& block, std::size_t i) const {
    const Number scaled =
        hn::Mul(load(block.s + i), number(static_cast<double>(table_.words.size())));
    const Int column = to_whole(scaled);
    store(hn::ShiftLeft<3>(column), block.offset + i);
    store(hn::Sub(scaled, to_number(column)), block.within + i);
    fetch(table_.words.data(), block.offset + i, hn::Lanes(Numbers()));
  }

  HWY_INLINE void choose_cell(Block& block, std::size_t i, TexelSample* out) const {
    const PackedAliasLayout& layout = table_.layout;
    const Int offset = load(block.offset + i);
    const Int word = gather(table_.words.data(), offset);
    const Number share =
        hn::Mul(to_number(shifted(word, layout.threshold_at)), number(layout.unit));
    const Number choice = load(block.t + i);
    const Which own = hn::Lt(choice, share);
    const auto own_whole = hn::RebindMask(Whole(), own);
    const Int alias = hn::And(word, whole(static_cast<std::int64_t>(layout.alias_mask)));
    const Int cell = hn::IfThenElse(own_whole, hn::ShiftRight<3>(offset), alias);
    const Int code = hn::And(
        hn::IfThenElse(own_whole, shifted(word, layout.own_at), shifted(word, layout.alias_at)),
        whole(static_cast<std::int64_t>(layout.code_mask)));
    const Number mass = float_in(gather(table_.palette.data(), hn::ShiftLeft<2>(code)));
    places_.store_samples(places_.cell(to_number(cell)), load(block.within + i),
                          rest_of_choice(choice, share, own), mass, out);
  }

  static HWY_INLINE Int shifted(Int word, unsigned bits) {
    const hn::RebindToUnsigned<Whole> bits_of;
    return hn::BitCast(Whole(), hn::ShiftRightSame(hn::BitCast(bits_of, word), static_cast<int>(bits)));
  }

  PackedAlias::View table_;
  LanePlaces places_;
};

std::size_t draw(const PackedAlias::View& table, const BatchPoints& points,
                 std::span<TexelSample> samples) {
  return draw_vectors(PackedAliasLanes(table), points, samples);
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lightproof
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(draw);

}  // namespace

std::size_t sample_vectors(const PackedAlias::View& table, const BatchPoints& points,
                           std::span<TexelSample> samples) {
  return HWY_DYNAMIC_DISPATCH(draw)(table, points, samples);
}

}  // namespace lightproof
#endif
