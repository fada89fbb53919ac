// CdfLines, for many samples at once: a run's 16-bit knots are compared all together.
#if defined(LIGHTPROOF_SAMPLERS_CDF_LINES_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_CDF_LINES_LANES_INL_H
#undef LIGHTPROOF_SAMPLERS_CDF_LINES_LANES_INL_H
#else
#define LIGHTPROOF_SAMPLERS_CDF_LINES_LANES_INL_H
#endif

#include "lightproof/samplers/cdf_lines.h"
#include "lightproof/samplers/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

class CdfLinesLanes {
 public:
  struct Block {
    alignas(64) std::int64_t offset[kBatchBlock];  ///< of the run, in bytes
    alignas(64) std::int64_t index[kBatchBlock];   ///< of the texel in its run
    alignas(64) std::int64_t knots[kBatchBlock];   ///< its lower and upper one, in units of 2^-31
  };
  struct Texel {
    Number index;
    Number mass;      ///< its share of the run's mass
    Number fraction;  ///< of the way through it
  };

  explicit CdfLinesLanes(const CdfLines::View& view) : view_(view) {}

  HWY_INLINE void choose_runs(Block& block, std::size_t count) const {
    fetch(view_.narrow, block.offset, count);
  }

  /// u: uniform numbers in [0,1).
  HWY_INLINE void choose_texels(const double* u, Block& block, std::size_t count) const {
    std::array<std::uint16_t, kBatchBlock> wide;
    std::size_t wides = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const CdfLines::Narrow& knots = run(block, i);
      choose(knots, u[i], block, i);
      wide[wides] = static_cast<std::uint16_t>(i);
      wides += CdfLines::is_wide(knots) ? 1 : 0;
    }
    for (std::size_t k = 0; k < wides; ++k) {
      const std::size_t i = wide[k];
      choose(view_.wide[CdfLines::wide_index(run(block, i))], u[i], block, i);
    }
  }

  HWY_INLINE Texel texels(const double* u, const Block& block, std::size_t i) const {
    const Int knots = load(block.knots + i);
    const Number low = to_number(low_half(knots));
    const Number units = hn::Sub(to_number(high_half(knots)), low);
    const Number scaled = hn::Mul(load(u + i), number(0x1p31));
    return {to_number(load(block.index + i)), hn::Mul(units, number(0x1p-31)),
            hn::Div(hn::Sub(scaled, low), units)};
  }

 private:
  HWY_INLINE const CdfLines::Narrow& run(const Block& block, std::size_t i) const {
    return view_.narrow[static_cast<std::size_t>(block.offset[i]) / sizeof(CdfLines::Narrow)];
  }

  /// What stands in for a wide run gives some texel or other.
  template <class Integer, std::uint32_t kOne>
  static HWY_INLINE void choose(const RunKnots<Integer, kOne>& run, double u, Block& block,
                                std::size_t i) {
    constexpr std::uint32_t kLast = RunKnots<Integer, kOne>::kLast;
    constexpr std::uint32_t kUnit = (1U << 31U) / kOne;
    const auto number = std::min<std::uint32_t>(static_cast<std::uint32_t>(u * kOne), kLast - 1);
    // No branches, which would be guessed wrong as often as right.
    const std::size_t index = count_up_to(run.upper, static_cast<Integer>(number)) % kRunTexels;
    const std::uint32_t has_lower = index > 0 ? 1 : 0;
    const std::uint32_t below = run.upper[(index - 1) % kRunTexels] * has_lower;
    const std::uint32_t above = run.upper[index];
    const std::uint64_t high = above + (above == kLast ? kOne - kLast : 0);
    block.index[i] = static_cast<std::int64_t>(index);
    block.knots[i] =
        static_cast<std::int64_t>((high * kUnit) << 32U | std::uint64_t{below} * kUnit);
  }

  /// How many knots are not above this number.
  template <class Integer>
  static HWY_INLINE std::size_t count_up_to(const std::array<Integer, kRunTexels>& upper,
                                            Integer number) {
    const hn::CappedTag<Integer, kRunTexels> tag;
    const auto wanted = hn::Set(tag, number);
    std::size_t count = upper.size();
    for (std::size_t k = 0; k < upper.size(); k += hn::Lanes(tag)) {
      count -= hn::CountTrue(tag, hn::Gt(hn::Load(tag, upper.data() + k), wanted));
    }
    return count;
  }

  CdfLines::View view_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_CDF_LINES_LANES_INL_H
