// Alias, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_ALIAS_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_ALIAS_LANES_INL_H
#undef LIGHTPROOF_SAMPLERS_ALIAS_LANES_INL_H
#else
#define LIGHTPROOF_SAMPLERS_ALIAS_LANES_INL_H
#endif

#include "lightproof/samplers/alias.h"
#include "lightproof/samplers/alias_table_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

class AliasLanes {
 public:
  static constexpr int kStages = 2;
  struct Block : BlockPoints {
    AliasTableLanes::Block texels;
  };

  explicit AliasLanes(const Alias::View& view) : table_(view.entries), places_(view.places) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    AliasTableLanes::Block& texels = block.texels;
    if constexpr (kStage == 0) {
      table_.choose_columns(block.s, texels, count);
    } else {
      table_.choose_cells(block.t, texels, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        places_.store_samples(places_.cell(load(texels.cell + i)), load(texels.within + i),
                              load(block.t + i), load(texels.mass + i), out + i);
      });
    }
  }

 private:
  AliasTableLanes table_;
  LanePlaces places_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_ALIAS_LANES_INL_H
