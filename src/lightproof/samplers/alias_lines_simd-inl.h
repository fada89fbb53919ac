// AliasLines, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_ALIAS_LINES_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_ALIAS_LINES_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_ALIAS_LINES_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_ALIAS_LINES_SIMD_INL_H
#endif

#include "lightproof/samplers/alias_lines.h"
#include "lightproof/samplers/alias_table_simd-inl.h"
#include "lightproof/samplers/cdf_lines_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

class AliasLinesKernel {
 public:
  static constexpr int kStages = 3;
  struct Block : BlockPoints {
    AliasTableKernel::Block runs;
    CdfLinesKernel::Block lines;
  };

  explicit AliasLinesKernel(const AliasLines::View& view)
      : runs_(view.runs),
        lines_(view.lines),
        positions_(view.positions),
        runs_across_(view.lines.runs),
        inverse_runs_across_(1.0 / view.lines.runs) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    if constexpr (kStage == 0) {
      runs_.choose_columns(block.s, block.runs, count);
    } else if constexpr (kStage == 1) {
      runs_.choose_cells(block.t, block.runs, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        store(hn::ShiftLeft<6>(to_whole(load(block.runs.cell + i))), block.lines.offset + i);
      });
      lines_.choose_runs(block.lines, count);
    } else {
      lines_.choose_texels(block.t, block.lines, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR { store_texels(block, i, out + i); });
    }
  }

 private:
  template <class Output>
  HWY_INLINE void store_texels(const Block& block, std::size_t i, const Output& out) const {
    const CdfLinesKernel::Texel found = lines_.texels(block.t, block.lines, i);
    const Cell run =
        cell_at(load(block.runs.cell + i), number(runs_across_), number(inverse_runs_across_));
    const Number x = hn::Add(hn::Mul(run.x, number(kRunTexels)), found.index);
    positions_.store_samples({x, run.y}, found.fraction, load(block.runs.within + i),
                             hn::Mul(load(block.runs.mass + i), found.mass), out);
  }

  AliasTableKernel runs_;
  CdfLinesKernel lines_;
  PositionKernel positions_;
  double runs_across_;
  double inverse_runs_across_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_ALIAS_LINES_SIMD_INL_H
