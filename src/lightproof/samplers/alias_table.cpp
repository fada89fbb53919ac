#include "lightproof/samplers/alias_table.h"

#include <algorithm>
#include <cmath>

#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

/// Cells of one task; fixed, so that the split does not depend on the threads.
constexpr std::size_t kChunk = std::size_t{1} << 16U;

std::size_t chunks_of(std::size_t count) { return (count + kChunk - 1) / kChunk; }

/// Calls body(chunk, first cell, last cell + 1) for all chunks, in parallel.
template <class Body>
void for_chunks(std::size_t count, const Body& body) {
  parallel_for(chunks_of(count), [&](std::size_t chunk) {
    body(chunk, chunk * kChunk, std::min(count, (chunk + 1) * kChunk));
  });
}

/// Neumaier's sum: off by one rounding, however many terms.
double exact_sum(std::span<const double> values) {
  double sum = 0.0;
  double lost = 0.0;
  for (const double value : values) {
    const double next = sum + value;
    lost += std::abs(sum) >= value ? (sum - next) + value : (value - next) + sum;
    sum = next;
  }
  return sum + lost;
}

double sum_of_weights(std::span<const double> weights) {
  std::vector<double> sums(chunks_of(weights.size()));
  for_chunks(weights.size(), [&](std::size_t chunk, std::size_t first, std::size_t end) {
    sums[chunk] = exact_sum(weights.subspan(first, end - first));
  });
  return exact_sum(sums);
}

/// Cells of less than a unit, which get one, and the weight of the others.
struct Parts {
  std::uint64_t faint = 0;
  double bright = 0.0;
};

bool is_faint(double weight, double unit) { return weight > 0.0 && weight < unit; }

Parts parts_of(std::span<const double> weights, double unit) {
  std::vector<Parts> parts(chunks_of(weights.size()));
  for_chunks(weights.size(), [&](std::size_t chunk, std::size_t first, std::size_t end) {
    Parts sum;
    for (const double weight : weights.subspan(first, end - first)) {
      const bool faint = is_faint(weight, unit);
      sum.faint += faint ? 1 : 0;
      sum.bright += faint ? 0.0 : weight;
    }
    parts[chunk] = sum;
  });
  Parts all;
  for (const Parts& part : parts) {
    all.faint += part.faint;
    all.bright += part.bright;
  }
  return all;
}

/// What one chunk's masses come to.
struct Rounded {
  std::uint64_t sum = 0;
  std::size_t largest = 0;
};

/// What rounding leaves of a cell goes on to the next.
Rounded round_masses(std::span<const double> weights, double unit, double scale,
                     std::span<std::uint64_t> masses) {
  Rounded rounded;
  double carry = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0.0)) continue;
    if (is_faint(weights[i], unit)) {
      masses[i] = 1;
    } else {
      const double share = scale * weights[i] + carry;
      const double whole = std::max(1.0, std::floor(share));
      carry = share - whole;
      masses[i] = static_cast<std::uint64_t>(whole);
    }
    rounded.sum += masses[i];
    if (masses[i] > masses[rounded.largest]) rounded.largest = i;
  }
  return rounded;
}

}  // namespace

std::vector<std::uint64_t> whole_masses(std::span<const double> weights, unsigned bits) {
  const std::uint64_t total = weights.size() << bits;
  const double unit = sum_of_weights(weights) / static_cast<double>(total);
  const Parts parts = parts_of(weights, unit);
  const double scale = static_cast<double>(total - parts.faint) / parts.bright;
  std::vector<std::uint64_t> masses(weights.size());
  std::vector<Rounded> chunks(chunks_of(weights.size()));
  for_chunks(weights.size(), [&](std::size_t chunk, std::size_t first, std::size_t end) {
    chunks[chunk] = round_masses(weights.subspan(first, end - first), unit, scale,
                                 std::span(masses).subspan(first, end - first));
    chunks[chunk].largest += first;
  });
  std::uint64_t sum = 0;
  std::size_t largest = 0;
  for (const Rounded& chunk : chunks) {
    sum += chunk.sum;
    if (masses[chunk.largest] > masses[largest]) largest = chunk.largest;
  }
  masses[largest] += total - sum;  // modulo 2^64: of either sign
  return masses;
}

AliasTable::AliasTable(std::span<const double> weights) : entries_(weights.size()) {
  const std::vector<std::uint64_t> masses = whole_masses(weights, kBits);
  const auto probability = [unit = kUnit / static_cast<double>(weights.size())](std::uint64_t m) {
    return static_cast<float>(unit * static_cast<double>(m));
  };
  sweep_aliases(masses, kBits, [&](std::size_t cell, const AliasColumn& column) {
    entries_[cell] = {static_cast<std::uint32_t>(column.threshold),
                      static_cast<std::uint32_t>(column.alias), probability(masses[cell]),
                      probability(masses[column.alias])};
  });
}

}  // namespace lightproof
