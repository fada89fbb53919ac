// CdfLines, for many samples at once: a run's 16-bit CDF entries are compared all together.
#if defined(LIGHTPROOF_SAMPLERS_CDF_LINES_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_CDF_LINES_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_CDF_LINES_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_CDF_LINES_SIMD_INL_H
#endif

#include "lightproof/samplers/cdf_lines.h"
#include "lightproof/samplers/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

class CdfLinesKernel {
 public:
  struct Block {
    alignas(64) std::int64_t offset[kBatchBlock];  ///< where the run begins, in bytes
    alignas(
        64) std::int32_t wide[kBatchBlock];  ///< what is looked for, in units of wide CDF entries
    alignas(64) std::int32_t narrow[kBatchBlock];   ///< what is looked for, in units of narrow ones
    alignas(64) std::int32_t index[kBatchBlock];    ///< index of the texel in its run
    alignas(64) std::int32_t pair[kBatchBlock];     ///< its lower and upper narrow CDF entry
    alignas(64) std::int64_t entries[kBatchBlock];  ///< the CDF entries as wide ones
  };
  struct Texel {
    Number index;
    Number mass;      ///< its share of the run's mass
    Number fraction;  ///< share of its mass that lies before the number
  };

  explicit CdfLinesKernel(const CdfLines::View& view) : view_(view) {}

  HWY_INLINE void choose_runs(Block& block, std::size_t count) const {
    fetch(view_.narrow, block.offset, count);
  }

  /// u: uniform numbers in [0,1).
  HWY_INLINE void choose_texels(const double* u, Block& block, std::size_t count) const {
    for_vectors(count, [&](std::size_t i) HWY_ATTR {
      const Int32s wide = to_int32(hn::Mul(load(u + i), number(kWideOne)));
      const Int32s most = hn::Set(Int32Tag(), CdfLines::Narrow::kLast - 1);
      store(wide, block.wide + i);
      store(hn::Min(hn::ShiftRight<kFinerBits>(wide), most), block.narrow + i);
    });
    std::array<std::uint16_t, kBatchBlock> wide;
    std::size_t wides = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const CdfLines::Narrow& entries = narrow(block.offset[i]);
      const std::size_t index = find(entries.upper, static_cast<std::uint16_t>(block.narrow[i]));
      const auto pair = pair_at<std::uint32_t>(entries.upper, index);
      block.index[i] = static_cast<std::int32_t>(index);
      block.pair[i] = static_cast<std::int32_t>(pair);
      wide[wides] = static_cast<std::uint16_t>(i);
      wides += pair >> 16U == 0 ? 1 : 0;  // the CDF entry above a number is 0 in no narrow run
    }
    for_vectors(count, [&](std::size_t i) HWY_ATTR { widen(block, i); });
    for (std::size_t k = 0; k < wides; ++k) choose_wide(block, wide[k]);
  }

  HWY_INLINE Texel texels(const double* u, const Block& block, std::size_t i) const {
    const Int entries = load(block.entries + i);
    const Number index = hn::PromoteTo(Numbers(), load(block.index + i));
    const Number before = to_number(low_half(entries));
    const Number low = hn::IfThenZeroElse(hn::Eq(index, number(0.0)), before);
    const Number units = hn::Sub(to_number(high_half(entries)), low);
    const Number scaled = hn::Mul(load(u + i), number(kWideOne));
    return {index, hn::Mul(units, number(1.0 / kWideOne)), hn::Div(hn::Sub(scaled, low), units)};
  }

 private:
  static constexpr std::uint32_t kNarrowOne = 1U << 16U;
  static constexpr double kWideOne = 0x1p31;
  static constexpr int kFinerBits = 15;  ///< that wide CDF entries have and narrow ones have not

  HWY_INLINE const CdfLines::Narrow& narrow(std::int64_t offset) const {
    return view_.narrow[static_cast<std::size_t>(offset) / sizeof(CdfLines::Narrow)];
  }

  /// From 16-bit CDF entries to 31-bit ones.
  HWY_INLINE void widen(Block& block, std::size_t i) const {
    const Int pair = hn::PromoteTo(Int64Tag(), load(block.pair + i));
    const Int upper = hn::And(hn::ShiftRight<16>(pair), whole(0xffff));
    const Int high =
        hn::IfThenElse(hn::Eq(upper, whole(CdfLines::Narrow::kLast)), whole(kNarrowOne), upper);
    store(hn::Or(hn::ShiftLeft<kFinerBits>(hn::And(pair, whole(0xffff))),
                 hn::ShiftLeft<32 + kFinerBits>(high)),
          block.entries + i);
  }

  HWY_INLINE void choose_wide(Block& block, std::size_t i) const {
    const CdfLines::Wide& entries = view_.wide[CdfLines::wide_index(narrow(block.offset[i]))];
    const std::size_t index = find(entries.upper, static_cast<std::uint32_t>(block.wide[i]));
    block.index[i] = static_cast<std::int32_t>(index);
    block.entries[i] = pair_at<std::int64_t>(entries.upper, index);
  }

  /// The first CDF entry above this number; the last one of a run is, and of what stands in for a
  /// wide run the third.
  template <class Integer>
  static HWY_INLINE std::size_t find(const std::array<Integer, kRunTexels>& upper, Integer number) {
    const hn::CappedTag<Integer, kRunTexels> tag;
    const auto wanted = hn::Set(tag, number);
    std::size_t above = 0;
    for (std::size_t k = 0; k < upper.size(); k += hn::Lanes(tag)) {
      above += hn::CountTrue(tag, hn::Gt(hn::Load(tag, upper.data() + k), wanted));
    }
    return upper.size() - above;
  }

  /// A CDF entry and, in the lower half, the one before it: of the first one, what comes before the
  /// run.
  template <class Pair, class Integer>
  static HWY_INLINE Pair pair_at(const std::array<Integer, kRunTexels>& upper, std::size_t index) {
    static_assert(sizeof(Pair) == 2 * sizeof(Integer));
    Pair pair;
    std::memcpy(&pair, reinterpret_cast<const char*>(upper.data() + index) - sizeof(Integer),
                sizeof pair);
    return pair;
  }

  CdfLines::View view_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_CDF_LINES_SIMD_INL_H
