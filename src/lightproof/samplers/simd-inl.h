// Parts of the vectorised samplers, compiled once for every kind of vector: the pipeline of a
// batch, and the positions of samples in their texels. A lane is a sample; numbers are doubles and
// 64-bit integers, and every operation is that of the scalar code, so that the texels are the same.
//
// Included by sources of Highway's foreach_target only, once for each kind of vector: hence the
// guard, which is Highway's.
#if defined(LIGHTPROOF_SAMPLERS_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_SIMD_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

#include "lightproof/core/lifetime.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/texel_positions.h"
#include "lightproof/warp/sin_cos-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

namespace hn = hwy::HWY_NAMESPACE;

using Numbers = hn::ScalableTag<double>;
using Int64Tag = hn::ScalableTag<std::int64_t>;
using Number = hn::Vec<Numbers>;
using Int = hn::Vec<Int64Tag>;
using Mask = hn::Mask<Numbers>;
/// A vector of 32-bit integers, as many as one of numbers holds.
using Int32Tag = hn::Rebind<std::int32_t, Numbers>;
using Int32s = hn::Vec<Int32Tag>;

HWY_INLINE Number number(double value) { return hn::Set(Numbers(), value); }
HWY_INLINE Number to_number(Int value) { return hn::ConvertTo(Numbers(), value); }
HWY_INLINE Int whole(std::int64_t value) { return hn::Set(Int64Tag(), value); }
/// The integers that whole numbers from 0 to below 2^52 are: the last bits of their sums with 2^52.
HWY_INLINE Int to_whole(Number value) {
  const Int bits = hn::BitCast(Int64Tag(), hn::Add(value, number(0x1p52)));
  return hn::And(bits, whole((std::int64_t{1} << 52U) - 1));
}
HWY_INLINE Int32s to_int32(Number value) { return hn::DemoteTo(Int32Tag(), value); }
HWY_INLINE Int32s load(const std::int32_t* from) { return hn::Load(Int32Tag(), from); }
HWY_INLINE void store(Int32s value, std::int32_t* to) { hn::Store(value, Int32Tag(), to); }
/// The product of numbers below 2^32.
HWY_INLINE Int product(Int a, std::size_t b) {
  const hn::RepartitionToNarrow<hn::RebindToUnsigned<Int64Tag>> narrow;
  return hn::BitCast(Int64Tag(),
                     hn::MulEven(hn::BitCast(narrow, a),
                                 hn::BitCast(narrow, whole(static_cast<std::int64_t>(b)))));
}
HWY_INLINE Number load(const double* from) { return hn::Load(Numbers(), from); }
HWY_INLINE Int load(const std::int64_t* from) { return hn::Load(Int64Tag(), from); }
HWY_INLINE void store(Number value, double* to) { hn::Store(value, Numbers(), to); }
HWY_INLINE void store(Int value, std::int64_t* to) { hn::Store(value, Int64Tag(), to); }
HWY_INLINE Int low_half(Int value) { return hn::And(value, whole(0xffffffff)); }
HWY_INLINE Int high_half(Int value) {
  return hn::BitCast(Int64Tag(),
                     hn::ShiftRight<32>(hn::BitCast(hn::RebindToUnsigned<Int64Tag>(), value)));
}
/// The float whose bits are the low half.
HWY_INLINE Number float_in(Int value) {
  const hn::Rebind<std::uint32_t, Int64Tag> half;
  const auto bits = hn::TruncateTo(half, hn::BitCast(hn::RebindToUnsigned<Int64Tag>(), value));
  return hn::PromoteTo(Numbers(), hn::BitCast(hn::Rebind<float, Int64Tag>(), bits));
}
HWY_INLINE Number gather_numbers(const double* base, Int index) {
  return hn::GatherIndex(Numbers(), base, index);
}

/// Numbers that lie in pairs in memory, apart.
template <class D>
struct NumberPairs {
  hn::Vec<D> first;
  hn::Vec<D> second;
};
/// A de-interleaving load of the pairs at these offsets from `base`, in doubles, one for a lane. A
/// load a pair: on AMD's processors two gathers take longer.
template <std::size_t kLanes>
HWY_INLINE auto load_number_pairs(const double* base, const std::int64_t* indices) {
  const hn::FixedTag<double, kLanes> d;
  if constexpr (kLanes == 2) {
    const auto even = hn::LoadU(d, base + indices[0]);
    const auto odd = hn::LoadU(d, base + indices[1]);
    return NumberPairs<decltype(d)>{hn::InterleaveLower(d, even, odd),
                                    hn::InterleaveUpper(d, even, odd)};
  } else {
    const auto low = load_number_pairs<kLanes / 2>(base, indices);
    const auto high = load_number_pairs<kLanes / 2>(base, indices + kLanes / 2);
    return NumberPairs<decltype(d)>{hn::Combine(d, high.first, low.first),
                                    hn::Combine(d, high.second, low.second)};
  }
}
HWY_INLINE auto gather_number_pairs(const double* base, Int index) {
  constexpr std::size_t kLanes = hn::MaxLanes(Numbers());
  alignas(64) std::int64_t indices[kLanes];
  store(index, indices);
  return load_number_pairs<kLanes>(base, indices);
}

/// 64-bit words at these byte offsets, which need not be aligned, one after the other: several
/// processors read so as quickly as with a gather, AMD's more quickly.
template <class Word>
HWY_INLINE void read_words(const void* base, const std::int64_t* offsets, std::size_t count,
                           Word* words) {
  static_assert(sizeof(Word) == sizeof(std::int64_t));
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(words + i, static_cast<const char*>(base) + offsets[i], sizeof(Word));
  }
}

/// The words of a vector of items of two 64-bit words each.
struct WordPairs {
  Int first;
  Int second;
};
/// A vector of items; aligned like a vector.
HWY_INLINE WordPairs load_pairs(const void* items) {
  const auto* words = static_cast<const std::int64_t*>(items);
  const Int even = load(words);
  const Int odd = load(words + hn::Lanes(Int64Tag()));
  return {hn::ConcatEven(Int64Tag(), odd, even), hn::ConcatOdd(Int64Tag(), odd, even)};
}

/// What is left of a uniform number that has chosen the part below or above `share`; see
/// rest_of_choice of the scalar code.
HWY_INLINE Number rest_of_choice(Number choice, Number share, Mask below) {
  const Number part = hn::IfThenElse(below, choice, hn::Sub(choice, share));
  const Number of = hn::IfThenElse(below, share, hn::Sub(number(1.0), share));
  return hn::Min(hn::Div(part, of), number(1.0 - 0x1p-53));
}

/// A cell's number, of cells counted row by row, as column and row: exact below 2^48.
struct Cell {
  Number x;
  Number y;
};
HWY_INLINE Cell cell_at(Number cell, Number width, Number inverse_width) {
  const Number y = hn::Trunc(hn::Mul(hn::Add(cell, number(0.5)), inverse_width));
  return {hn::Sub(cell, hn::Mul(y, width)), y};
}

/// A DirectionBatch from some sample on.
struct DirectionPointers {
  explicit DirectionPointers(const DirectionBatch& batch)
      : x(batch.x.data()),
        y(batch.y.data()),
        z(batch.z.data()),
        pdf(batch.pdf.data()),
        column(batch.column.data()),
        row(batch.row.data()) {}

  DirectionPointers operator+(std::size_t i) const {
    DirectionPointers later = *this;
    later.x += i;
    later.y += i;
    later.z += i;
    later.pdf += i;
    later.column += i;
    later.row += i;
    return later;
  }

  double* x;
  double* y;
  double* z;
  double* pdf;
  std::int32_t* column;
  std::int32_t* row;
};

/// TexelPositions, for a vector of samples.
class PositionKernel {
 public:
  explicit PositionKernel(const TexelPositionsView& view) : view_(view) {}

  Cell cell(Number texel) const {
    return cell_at(texel, number(view_.extent.width), number(view_.texel_width));
  }

  /// Writes a vector of samples: the texels, the shares of their width and of their
  /// height or solid angle, and their probabilities.
  HWY_INLINE void store_samples(Cell cell, Number column_fraction, Number row_fraction, Number mass,
                                TexelSample* to) const {
    const Number s = hn::Mul(hn::Add(cell.x, inside(column_fraction)), number(view_.texel_width));
    Number t;
    Number pdf;
    if (view_.measure == MapMeasure::square) {
      t = hn::Mul(hn::Add(cell.y, inside(row_fraction)), number(view_.texel_height));
      pdf = hn::Mul(mass, number(view_.texels));
    } else {
      const RowPosition at = row_position(cell.y, row_fraction);
      t = position_by_solid_angle(cell.y, at);
      Number sine = at.sine;
      if (!SolidAngleRows::has_many_rows(view_.extent.height)) {
        const Number near = hn::Min(t, hn::Sub(number(1.0), t));
        sine = hn::Sin(Numbers(), hn::Mul(number(kPi), near));
      }
      pdf = hn::Mul(density_by_solid_angle(at, mass), hn::Mul(number(2.0 * kPi * kPi), sine));
    }
    static_assert(sizeof(TexelSample) == 32 && offsetof(TexelSample, x) == 16 &&
                  offsetof(TexelSample, y) == 20 && offsetof(TexelSample, pdf) == 24);
    const Int texel = to_whole(hn::Add(hn::Mul(cell.y, number(0x1p32)), cell.x));
    const std::size_t bytes = hn::Lanes(Numbers()) * sizeof(TexelSample);
    hn::StoreInterleaved4(s, t, hn::BitCast(Numbers(), texel), pdf, Numbers(),
                          start_lifetime_as_array<double>(to, bytes));
    start_lifetime_as_array<TexelSample>(to, bytes);
  }

  /// Stores samples as directions: neither arc sine nor sine of an arc sine is needed.
  HWY_INLINE void store_samples(Cell cell, Number column_fraction, Number row_fraction, Number mass,
                                const DirectionPointers& to) const {
    const Number s = hn::Mul(hn::Add(cell.x, inside(column_fraction)), number(view_.texel_width));
    const auto azimuth = sin_cos_of_turns(Numbers(), s);
    const Height height = view_.measure == MapMeasure::square
                              ? height_by_position(cell.y, row_fraction, mass)
                              : height_by_solid_angle(cell.y, row_fraction, mass);
    store_anywhere(hn::Neg(hn::Mul(height.sine, azimuth.cos)), to.x);
    store_anywhere(hn::Mul(height.sine, azimuth.sin), to.y);
    store_anywhere(height.z, to.z);
    store_anywhere(height.pdf, to.pdf);
    hn::StoreU(to_int32(cell.x), Int32Tag(), to.column);
    hn::StoreU(to_int32(cell.y), Int32Tag(), to.row);
  }

 private:
  static HWY_INLINE Number inside(Number fraction) {
    return hn::Clamp(fraction, number(kCellMargin), number(1.0 - kCellMargin));
  }

  static HWY_INLINE void store_anywhere(Number value, double* to) {
    hn::StoreU(value, Numbers(), to);
  }

  /// A direction but for its azimuth.
  struct Height {
    Number sine;  ///< sine of the angle from a pole
    Number z;
    Number pdf;  ///< per steradian
  };

  /// Uniform in t.
  HWY_INLINE Height height_by_position(Number y, Number row_fraction, Number mass) const {
    const Number t = hn::Mul(hn::Add(y, inside(row_fraction)), number(view_.texel_height));
    const auto from_nadir = sin_cos_of_turns(Numbers(), hn::Mul(t, number(0.5)));
    const Number density = hn::Mul(mass, number(view_.texels / (2.0 * kPi * kPi)));
    return {from_nadir.sin, hn::Neg(from_nadir.cos), hn::Div(density, from_nadir.sin)};
  }

  /// Uniform in solid angle.
  HWY_INLINE Height height_by_solid_angle(Number y, Number row_fraction, Number mass) const {
    const RowPosition at = row_position(y, row_fraction);
    return {at.sine, hn::IfThenElse(at.upper, at.cosine, hn::Neg(at.cosine)),
            density_by_solid_angle(at, mass)};
  }

  /// SolidAngleRows, at a share of a row. Angles are those from the nearer pole.
  struct RowPosition {
    Mask upper;           ///< whether the nearer pole is the zenith
    Number row;           ///< counted from it
    Int line;             ///< index of the row's line, in doubles
    Number span;          ///< of the row's line
    Number squared_sine;  ///< squared sine of half the angle
    Number sine;
    Number cosine;
  };
  /// One number of the lines of rows.
  HWY_INLINE Number of_line(Int line, double SolidAngleRows::Line::*number_of) const {
    return gather_numbers(&(view_.lines->*number_of), line);
  }
  HWY_INLINE RowPosition row_position(Number y, Number fraction) const {
    const Number height = number(view_.extent.height);
    const Mask upper = hn::Ge(hn::Add(y, y), height);
    const Number row = hn::IfThenElse(upper, hn::Sub(hn::Sub(height, number(1.0)), y), y);
    const Number from_edge = hn::IfThenElse(upper, hn::Sub(number(1.0), fraction), fraction);
    const Number f = hn::Clamp(from_edge, number(SolidAngleRows::kMargin),
                               number(1.0 - SolidAngleRows::kMargin));
    static_assert(sizeof(SolidAngleRows::Line) == 4 * sizeof(double));
    const Int line = hn::ShiftLeft<2>(to_whole(row));
    static_assert(offsetof(SolidAngleRows::Line, squared_sine) == 0 &&
                  offsetof(SolidAngleRows::Line, span) == sizeof(double));
    const auto [squared_sine, span] = gather_number_pairs(&view_.lines->squared_sine, line);
    const Number squared = hn::Add(squared_sine, hn::Mul(f, span));
    const Number rest = hn::Sub(number(1.0), squared);
    const Number sine = hn::Mul(number(2.0), hn::Sqrt(hn::Mul(squared, rest)));
    return {upper, row, line, span, squared, sine, hn::Sub(rest, squared)};
  }

  /// Per steradian.
  HWY_INLINE Number density_by_solid_angle(const RowPosition& at, Number mass) const {
    return hn::Div(mass, hn::Mul(number(view_.solid_angle), at.span));
  }

  HWY_INLINE Number position_by_solid_angle(Number y, const RowPosition& at) const {
    const int height = view_.extent.height;
    Number within;
    if (SolidAngleRows::needs_few_terms(height)) {
      within = since_edge<SolidAngleRows::kFewTerms>(at);
    } else if (SolidAngleRows::has_many_rows(height)) {
      within = since_edge<SolidAngleRows::kArcSine.size()>(at);
    } else {
      const Number sine = hn::Min(hn::Sqrt(at.squared_sine), number(1.0));
      const Number angle = hn::Asin(Numbers(), sine);
      within = hn::Sub(hn::Mul(hn::Mul(number(2.0 / kPi), angle), number(height)), at.row);
    }
    const Number share = inside(hn::IfThenElse(at.upper, hn::Sub(number(1.0), within), within));
    return hn::Mul(hn::Add(y, share), number(view_.texel_height));
  }

  template <std::size_t kTerms>
  HWY_INLINE Number since_edge(const RowPosition& at) const {
    const Number x = hn::Sub(hn::Mul(at.sine, of_line(at.line, &SolidAngleRows::Line::cosine)),
                             hn::Mul(at.cosine, of_line(at.line, &SolidAngleRows::Line::sine)));
    const Number square = hn::Mul(x, x);
    Number sum = number(SolidAngleRows::kArcSine[kTerms - 1]);
    for (std::size_t k = kTerms - 1; k-- > 0;) {
      sum = hn::Add(hn::Mul(sum, square), number(SolidAngleRows::kArcSine[k]));
    }
    return hn::Mul(hn::Mul(x, sum), number(view_.rows_per_radian));
  }

  TexelPositionsView view_;
};

/// Random points of a block of samples.
struct BlockPoints {
  alignas(64) double s[kBatchBlock];
  alignas(64) double t[kBatchBlock];
};

/// Fetches the lines of these byte offsets.
HWY_INLINE void fetch(const void* base, const std::int64_t* offsets, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    __builtin_prefetch(static_cast<const char*>(base) + offsets[i]);
  }
}

/// Calls body(i) for every vector of a block of samples, i the first of them.
template <class Body>
HWY_INLINE void for_vectors(std::size_t count, const Body& body) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(Numbers())) body(i);
}

/// Those samples of a block that something is true of: a byte for every vector.
class Marks {
 public:
  /// Sets the marks of the vector that begins at sample i; to be called for all vectors of a block
  /// in turn, from the first on.
  HWY_INLINE void set(std::size_t i, hn::Mask<Int64Tag> mask) {
    static_assert(hn::MaxLanes(Int64Tag()) <= 8);
    std::uint8_t bits[8];
    hn::StoreMaskBits(Int64Tag(), mask, bits);
    bytes_[i / hn::Lanes(Int64Tag())] = bits[0];
  }
  /// Calls body(i) for every marked sample, in their order.
  template <class Body>
  HWY_INLINE void for_each(std::size_t count, const Body& body) const {
    const std::size_t vectors = count / hn::Lanes(Int64Tag());
    for (std::size_t first = 0; first < vectors; first += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes_ + first, std::min(sizeof word, vectors - first));
      for (; word != 0; word &= word - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(word));
        body((first + bit / 8) * hn::Lanes(Int64Tag()) + bit % 8);
      }
    }
  }

 private:
  std::uint8_t bytes_[kBatchBlock];
};

/// Draws whole vectors of samples; returns how many samples that were. A kernel works in stages,
/// each of which asks for the lines that the next one reads; while these come, other blocks go
/// through theirs.
///
/// Kernel: kStages, struct Block : BlockPoints, and stage<k>(Block&, count, output + first sample),
/// of which the last writes the samples.
template <class Kernel, class Output>
std::size_t draw_vectors(Kernel&& kernel, const BatchPoints& points, std::size_t samples,
                         const Output& output) {
  using Block = typename std::remove_reference_t<Kernel>::Block;
  constexpr int kStages = std::remove_reference_t<Kernel>::kStages;
  Block ring[kStages];
  const std::size_t lanes = hn::Lanes(Numbers());
  const std::size_t total = samples / lanes * lanes;
  const std::size_t blocks = (total + kBatchBlock - 1) / kBatchBlock;
  const auto run = [&]<int kStage>(std::size_t step) HWY_ATTR {
    if (step < kStage || step - kStage >= blocks) return;
    const std::size_t index = step - kStage;
    const std::size_t first = index * kBatchBlock;
    const std::size_t count = std::min(kBatchBlock, total - first);
    Block& block = ring[index % kStages];
    if constexpr (kStage == 0) {
      points.fill(first, std::span(block.s).first(count), std::span(block.t).first(count));
    }
    kernel.template stage<kStage>(block, count, output + first);
  };
  const auto run_all = [&]<int... kStage>(std::size_t step, std::integer_sequence<int, kStage...>)
      HWY_ATTR {
    (run.template operator()<kStage>(step), ...);
  };
  for (std::size_t step = 0; step < blocks + kStages - 1; ++step) {
    run_all(step, std::make_integer_sequence<int, kStages>());
  }
  return total;
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
