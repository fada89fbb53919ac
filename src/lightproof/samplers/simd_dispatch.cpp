// Every sampler with a vectorised form: a kernel in a header of its own, which is
// included, drawn with and exported here.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/samplers/simd_dispatch.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR
#include "lightproof/samplers/registry.h"
#else
#include "lightproof/samplers/alias_lines_simd-inl.h"
#include "lightproof/samplers/alias_simd-inl.h"
#include "lightproof/samplers/guide_lines_simd-inl.h"
#include "lightproof/samplers/guide_table_simd-inl.h"
#include "lightproof/samplers/packed_alias_simd-inl.h"
#include "lightproof/samplers/search_simd-inl.h"
#endif

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

/// Without vectors the scalar interface draws everything.
class AliasKernel;
class AliasLinesKernel;
class BinarySearchKernel;
class EytzingerKernel;
class GuideLinesKernel;
class GuideTableKernel;
class PackedAliasKernel;

template <class Kernel, class View>
std::size_t draw(const View& /*table*/, const BatchPoints& /*points*/,
                 const BatchOutput& /*output*/) {
  return 0;
}

#else

template <class Kernel, class View>
std::size_t draw(const View& table, const BatchPoints& points, const BatchOutput& output) {
  if (const auto* samples = std::get_if<std::span<TexelSample> >(&output)) {
    return draw_vectors(Kernel(table), points, samples->size(), samples->data());
  }
  const auto& directions = std::get<DirectionBatch>(output);
  return draw_vectors(Kernel(table), points, directions.size(), DirectionPointers(directions));
}

#endif

std::size_t draw_alias(const Alias::View& table, const BatchPoints& points,
                       const BatchOutput& output) {
  return draw<AliasKernel>(table, points, output);
}
std::size_t draw_alias_lines(const AliasLines::View& table, const BatchPoints& points,
                             const BatchOutput& output) {
  return draw<AliasLinesKernel>(table, points, output);
}
std::size_t draw_binary_search(const BinarySearchView& table, const BatchPoints& points,
                               const BatchOutput& output) {
  return draw<BinarySearchKernel>(table, points, output);
}
std::size_t draw_eytzinger(const EytzingerView& table, const BatchPoints& points,
                           const BatchOutput& output) {
  return draw<EytzingerKernel>(table, points, output);
}
std::size_t draw_guide_lines(const GuideLines::View& table, const BatchPoints& points,
                             const BatchOutput& output) {
  return draw<GuideLinesKernel>(table, points, output);
}
std::size_t draw_guide_table(const GuideTableView& table, const BatchPoints& points,
                             const BatchOutput& output) {
  return draw<GuideTableKernel>(table, points, output);
}
std::size_t draw_packed_alias(const PackedAlias::View& table, const BatchPoints& points,
                              const BatchOutput& output) {
  return draw<PackedAliasKernel>(table, points, output);
}

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(draw_alias);
HWY_EXPORT(draw_alias_lines);
HWY_EXPORT(draw_binary_search);
HWY_EXPORT(draw_eytzinger);
HWY_EXPORT(draw_guide_lines);
HWY_EXPORT(draw_guide_table);
HWY_EXPORT(draw_packed_alias);

}  // namespace

std::size_t sample_vectors(const Alias::View& table, const BatchPoints& points,
                           const BatchOutput& output) {
  return HWY_DYNAMIC_DISPATCH(draw_alias)(table, points, output);
}

std::size_t sample_vectors(const AliasLines::View& table, const BatchPoints& points,
                           const BatchOutput& output) {
  return HWY_DYNAMIC_DISPATCH(draw_alias_lines)(table, points, output);
}

std::size_t sample_vectors(const BinarySearchView& table, const BatchPoints& points,
                           const BatchOutput& output) {
  return HWY_DYNAMIC_DISPATCH(draw_binary_search)(table, points, output);
}

std::size_t sample_vectors(const EytzingerView& table, const BatchPoints& points,
                           const BatchOutput& output) {
  return HWY_DYNAMIC_DISPATCH(draw_eytzinger)(table, points, output);
}

std::size_t sample_vectors(const GuideLines::View& table, const BatchPoints& points,
                           const BatchOutput& output) {
  return HWY_DYNAMIC_DISPATCH(draw_guide_lines)(table, points, output);
}

std::size_t sample_vectors(const GuideTableView& table, const BatchPoints& points,
                           const BatchOutput& output) {
  return HWY_DYNAMIC_DISPATCH(draw_guide_table)(table, points, output);
}

std::size_t sample_vectors(const PackedAlias::View& table, const BatchPoints& points,
                           const BatchOutput& output) {
  return HWY_DYNAMIC_DISPATCH(draw_packed_alias)(table, points, output);
}

}  // namespace lightproof
#endif
