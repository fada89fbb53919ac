#include "lightproof/samplers/guide_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

constexpr unsigned kCdfBits = 31;
constexpr std::size_t kPartsPerRow = 4;

/// Cells of a distribution that a guide has numbers for.
constexpr std::size_t kMostCells = std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1;

unsigned guide_bits(std::size_t cells) { return static_cast<unsigned>(std::bit_width(cells - 1)); }

std::size_t checked(std::size_t cells) {
  if (cells <= kMostCells) return cells;
  throw InputError(
      fmt::format("guide tables have 16-bit numbers: of {} texels or runs of texels in a row or "
                  "column they can number {}; scale the map down or take another sampler",
                  cells, kMostCells));
}

}  // namespace

Guides::Guides(std::size_t count, std::size_t cells, std::size_t parts_per_cell)
    : shift_(kCdfBits - guide_bits(checked(cells) * parts_per_cell)),
      parts_((std::size_t{1} << guide_bits(cells * parts_per_cell)) + 1),
      first_(count * parts_) {}

void Guides::set(std::size_t guide, CdfEntries entries) {
  if (entries.back() == 0) {  // without mass, and so never asked
    std::fill_n(first_.begin() + static_cast<std::ptrdiff_t>(guide * parts_), parts_,
                std::uint16_t{0});
    return;
  }
  std::size_t cell = 0;
  for (std::size_t part = 0; part + 1 < parts_; ++part) {
    const auto u = static_cast<std::uint32_t>(part << shift_);
    while (entries[cell + 1] <= u) ++cell;
    first_[guide * parts_ + part] = static_cast<std::uint16_t>(cell);
  }
  // The last random number's.
  while (entries[cell + 1] < kCdfOne) ++cell;
  first_[guide * parts_ + parts_ - 1] = static_cast<std::uint16_t>(cell);
}

GuidedEntries::GuidedEntries(const CdfTable& table, std::size_t parts_per_column)
    : rows_(1, static_cast<std::size_t>(table.extent().height), kPartsPerRow),
      columns_(static_cast<std::size_t>(table.extent().height),
               static_cast<std::size_t>(table.extent().width), parts_per_column) {
  rows_.set(0, table.rows());
  parallel_for(static_cast<std::size_t>(table.extent().height),
               [&](std::size_t y) { columns_.set(y, table.columns(static_cast<int>(y))); });
}

}  // namespace lightproof
