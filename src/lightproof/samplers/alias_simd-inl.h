// Alias, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_ALIAS_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_ALIAS_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_ALIAS_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_ALIAS_SIMD_INL_H
#endif

#include "lightproof/samplers/alias.h"
#include "lightproof/samplers/alias_table_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

class AliasKernel {
 public:
  static constexpr int kStages = 2;
  struct Block : BlockPoints {
    AliasTableKernel::Block texels;
  };

  explicit AliasKernel(const Alias::View& view)
      : table_(view.entries), positions_(view.positions) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    AliasTableKernel::Block& texels = block.texels;
    if constexpr (kStage == 0) {
      table_.choose_columns(block.s, texels, count);
    } else {
      table_.choose_cells(block.t, texels, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        positions_.store_samples(positions_.cell(load(texels.cell + i)), load(texels.within + i),
                                 load(block.t + i), load(texels.mass + i), out + i);
      });
    }
  }

 private:
  AliasTableKernel table_;
  PositionKernel positions_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_ALIAS_SIMD_INL_H
