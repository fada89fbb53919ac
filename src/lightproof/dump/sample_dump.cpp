#include "lightproof/dump/sample_dump.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

/// Rows that are read at once: few enough for the cache.
constexpr std::size_t kBlock = 4096;

}  // namespace

SampleDump::SampleDump(NumberTable table, SampleColumns columns, SampleConvention convention)
    : table_(std::move(table)), rows_(columns, convention) {
  if (columns.count != table_.columns()) {
    throw InputError(fmt::format("the rows have {} numbers, {} columns are named", table_.columns(),
                                 columns.count));
  }
}

double SampleDump::rounding() const {
  // Three components of a unit vector, or two coordinates over a turn and half a turn.
  return rows_.columns().are_directions() ? std::sqrt(3.0) * table_.rounding()
                                          : 2.0 * kPi * table_.rounding();
}

void SampleDump::read(std::uint64_t first, std::span<DumpedSample> samples) const {
  const std::size_t columns = table_.columns();
  std::vector<double> numbers(std::min(samples.size(), kBlock) * columns);
  for (std::size_t done = 0; done < samples.size(); done += kBlock) {
    const std::size_t count = std::min(kBlock, samples.size() - done);
    const std::span<double> block = std::span(numbers).first(count * columns);
    table_.read(first + done, block);
    rows_.set_samples(block, samples.subspan(done, count));
  }
}

void SampleDump::read_weights(std::uint64_t first, std::span<SampleWeight> weights) const {
  const std::size_t columns = table_.columns();
  std::vector<double> numbers(std::min(weights.size(), kBlock) * columns);
  for (std::size_t done = 0; done < weights.size(); done += kBlock) {
    const std::size_t count = std::min(kBlock, weights.size() - done);
    const std::span<double> block = std::span(numbers).first(count * columns);
    table_.read(first + done, block);
    for (std::size_t i = 0; i < count; ++i) {
      weights[done + i] = rows_.weight(block.subspan(i * columns, columns));
    }
  }
}

}  // namespace lightproof
