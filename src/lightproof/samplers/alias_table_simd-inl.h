// AliasTable, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_ALIAS_TABLE_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_ALIAS_TABLE_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_ALIAS_TABLE_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_ALIAS_TABLE_SIMD_INL_H
#endif

#include "lightproof/samplers/alias_table.h"
#include "lightproof/samplers/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

class AliasTableKernel {
 public:
  struct Block {
    alignas(64) std::int64_t offset[kBatchBlock];  ///< where the column's entry begins, in bytes
    alignas(64) double within[kBatchBlock];        ///< the column: uniform
    alignas(64) AliasTable::Entry entry[kBatchBlock];
    alignas(64) double cell[kBatchBlock];
    alignas(64) double mass[kBatchBlock];
  };

  explicit AliasTableKernel(std::span<const AliasTable::Entry> entries) : entries_(entries) {}

  HWY_INLINE void choose_columns(const double* column, Block& block, std::size_t count) const {
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      const Number scaled = hn::Mul(load(column + i), number(static_cast<double>(entries_.size())));
      const Number index = hn::Trunc(scaled);
      store(hn::ShiftLeft<4>(to_whole(index)), block.offset + i);
      store(hn::Sub(scaled, index), block.within + i);
    });
    fetch(entries_.data(), block.offset, count);
  }

  /// Leaves in `choice` what remains of it.
  HWY_INLINE void choose_cells(double* choice, Block& block, std::size_t count) const {
    static_assert(sizeof(AliasTable::Entry) == 16);
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(block.entry + i, reinterpret_cast<const char*>(entries_.data()) + block.offset[i],
                  sizeof block.entry[i]);
    }
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      // Threshold and alias; the masses of the column's own cell and of the alias.
      const auto [column, masses] = load_pairs(block.entry + i);
      const Number share = hn::Mul(to_number(low_half(column)), number(0x1p-31));
      const Number u = load(choice + i);
      const Mask own = hn::Lt(u, share);
      const auto own_whole = hn::RebindMask(Int64Tag(), own);
      const Int index = hn::ShiftRight<4>(load(block.offset + i));
      store(to_number(hn::IfThenElse(own_whole, index, high_half(column))), block.cell + i);
      store(float_in(hn::IfThenElse(own_whole, masses, high_half(masses))), block.mass + i);
      store(rest_of_choice(u, share, own), choice + i);
    });
  }

 private:
  std::span<const AliasTable::Entry> entries_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_ALIAS_TABLE_SIMD_INL_H
