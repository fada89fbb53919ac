#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "lightproof/core/lifetime.h"
#include "lightproof/samplers/alias_table.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/samplers/alias_entries.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

/// Computes whole vectors from the front; returns how many entries that were.
#if HWY_TARGET == HWY_SCALAR

std::size_t entries_front(const AliasRun& /*run*/, double /*unit*/, float /*alias_mass*/,
                          AliasTable::Entry* /*entries*/) {
  return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Numbers = hn::ScalableTag<double>;
using Signed = hn::ScalableTag<std::int64_t>;
using Words = hn::ScalableTag<std::uint64_t>;
using FloatBits = hn::Half<hn::ScalableTag<std::uint32_t> >;

std::size_t entries_front(const AliasRun& run, double unit, float alias_mass,
                          AliasTable::Entry* entries) {
  static_assert(sizeof(AliasTable::Entry) == 2 * sizeof(std::uint64_t));
  const Words words;
  const Signed whole;
  const std::size_t lanes = hn::Lanes(words);
  std::uint32_t alias_bits = 0;
  std::memcpy(&alias_bits, &alias_mass, sizeof alias_bits);
  const auto full = hn::Set(whole, std::int64_t{1} << AliasTable::kBits);
  const auto alias = hn::Set(words, run.alias << 32U);
  const auto mass_of_alias = hn::Set(words, std::uint64_t{alias_bits} << 32U);
  const auto to_probability = hn::Set(Numbers(), unit);
  auto index = hn::ShiftLeft<32>(hn::Iota(words, run.first));
  const auto next = hn::Set(words, std::uint64_t{lanes} << 32U);
  std::size_t done = 0;
  for (; done + lanes <= run.masses.size(); done += lanes) {
    const auto mass = hn::LoadU(words, run.masses.data() + done);
    const auto number = hn::BitCast(whole, mass);
    const auto small = hn::RebindMask(words, hn::Lt(number, full));
    const auto shares = hn::Mul(to_probability, hn::ConvertTo(Numbers(), number));
    const auto own = hn::PromoteTo(
        words, hn::BitCast(FloatBits(), hn::DemoteTo(hn::RebindToFloat<FloatBits>(), shares)));
    const auto column = hn::IfThenElse(small, hn::Or(mass, alias), index);
    const auto masses = hn::Or(own, hn::IfThenElse(small, mass_of_alias, hn::ShiftLeft<32>(own)));
    const std::size_t bytes = lanes * sizeof(AliasTable::Entry);
    hn::StoreInterleaved2(column, masses, words,
                          start_lifetime_as_array<std::uint64_t>(entries + done, bytes));
    start_lifetime_as_array<AliasTable::Entry>(entries + done, bytes);
    index = hn::Add(index, next);
  }
  return done;
}

#endif

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(entries_front);

}  // namespace

std::size_t write_entries(const AliasRun& run, double unit, float alias_mass,
                          std::span<AliasTable::Entry> entries) {
  assert(entries.size() == run.masses.size());
  const std::size_t by_vectors =
      HWY_DYNAMIC_DISPATCH(entries_front)(run, unit, alias_mass, entries.data());
  for (std::size_t i = by_vectors; i < entries.size(); ++i) {
    const AliasColumn column = run.column(i, std::uint64_t{1} << AliasTable::kBits);
    const float own = to_probability(run.masses[i], unit);
    entries[i] = {static_cast<std::uint32_t>(column.threshold),
                  static_cast<std::uint32_t>(column.alias), own,
                  column.alias == run.alias ? alias_mass : own};
  }
  return by_vectors;
}

}  // namespace lightproof
#endif
