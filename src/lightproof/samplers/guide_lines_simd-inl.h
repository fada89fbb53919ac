// GuideLines, for many samples at once.
#if defined(LIGHTPROOF_SAMPLERS_GUIDE_LINES_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_GUIDE_LINES_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_GUIDE_LINES_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_GUIDE_LINES_SIMD_INL_H
#endif

#include "lightproof/samplers/cdf_lines_simd-inl.h"
#include "lightproof/samplers/guide_lines.h"
#include "lightproof/samplers/guide_table_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

class GuideLinesKernel {
 public:
  static constexpr int kStages = 4;
  struct Block : BlockPoints {
    GuidedKernel::Block runs;
    CdfLinesKernel::Block lines;
    alignas(64) double column_fraction[kBatchBlock];  ///< the run
    alignas(64) double row_fraction[kBatchBlock];
    alignas(64) double mass[kBatchBlock];  ///< probability of the run
  };

  explicit GuideLinesKernel(const GuideLines::View& view)
      : guided_(view.runs, view.guides),
        lines_(view.lines),
        positions_(view.positions),
        runs_across_(view.lines.runs) {}

  template <int kStage, class Output>
  HWY_INLINE void stage(Block& block, std::size_t count, const Output& out) const {
    if constexpr (kStage == 0) {
      guided_.choose_rows(block, block.runs, count);
    } else if constexpr (kStage == 1) {
      guided_.begin_columns(block.runs, count);
    } else if constexpr (kStage == 2) {
      guided_.choose_columns(block.runs, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        const FoundCells run = found_cells(block, block.runs, i);
        const Number index = hn::Add(hn::Mul(run.y, number(runs_across_)), run.x);
        store(hn::ShiftLeft<6>(to_whole(index)), block.lines.offset + i);
        store(run.column_fraction, block.column_fraction + i);
        store(run.row_fraction, block.row_fraction + i);
        store(run.mass, block.mass + i);
      });
      lines_.choose_runs(block.lines, count);
    } else {
      lines_.choose_texels(block.column_fraction, block.lines, count);
      for_vectors(count, [&](std::size_t i) HWY_ATTR { store_texels(block, i, out + i); });
    }
  }

 private:
  template <class Output>
  HWY_INLINE void store_texels(const Block& block, std::size_t i, const Output& out) const {
    const CdfLinesKernel::Texel texel = lines_.texels(block.column_fraction, block.lines, i);
    const Number run = to_number(load(block.runs.x + i));
    const Number x = hn::Add(hn::Mul(run, number(kRunTexels)), texel.index);
    positions_.store_samples({x, to_number(load(block.runs.y + i))}, texel.fraction,
                             load(block.row_fraction + i),
                             hn::Mul(load(block.mass + i), texel.mass), out);
  }

  GuidedKernel guided_;
  CdfLinesKernel lines_;
  PositionKernel positions_;
  double runs_across_;
};

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_GUIDE_LINES_SIMD_INL_H
