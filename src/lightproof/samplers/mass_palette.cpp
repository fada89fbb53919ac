#include "lightproof/samplers/mass_palette.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

/// Cells are counted in so many parts at most, each with numbers of its own.
constexpr std::size_t kParts = 16;
/// Cells with a mass of their own.
constexpr std::size_t kOwnMasses = 1024;
constexpr unsigned kMostDigits = 12;

/// The bits of a mass; 1 for none too.
unsigned bits_of(std::uint64_t mass) { return static_cast<unsigned>(std::bit_width(mass | 1U)); }

/// Masses cut to so many binary digits, numbered from 0 in ascending order.
class Steps {
 public:
  explicit Steps(unsigned digits) : digits_(digits) {}

  /// log2 of the step of masses with so many bits.
  unsigned step(unsigned bits) const { return std::max(bits, digits_) - digits_; }
  std::size_t key(std::uint64_t mass) const { return key(mass, bits_of(mass)); }
  /// The key of a mass with so many bits, or of the first that has one more.
  std::size_t key(std::uint64_t mass, unsigned bits) const {
    const unsigned s = step(bits);
    return (static_cast<std::size_t>(s) << (digits_ - 1)) + (mass >> s);
  }
  std::uint64_t mass(std::size_t key) const {
    const std::size_t half = std::size_t{1} << (digits_ - 1);
    if (key < 2 * half) return key;
    const std::size_t s = key / half - 1;
    return (key - s * half) << s;
  }
  std::size_t count() const { return key(~std::uint64_t{0}) + 2; }

 private:
  unsigned digits_;
};

/// One number for every number of bits that a mass may have.
using ByBits = std::array<std::uint64_t, 65>;

struct Census {
  std::vector<std::size_t> counts;  ///< of cells, by their keys at kMostDigits
  std::vector<ByBits> sums;         ///< of each chunk's masses, modulo 2^64
};

Census census_of(std::span<const std::uint64_t> cells) {
  const Steps finest(kMostDigits);
  Census census = {std::vector<std::size_t>(finest.count()),
                   std::vector<ByBits>(chunks_of(cells.size(), kTaskCells))};
  const std::size_t part_size = chunks_of(census.sums.size(), kParts) * kTaskCells;
  std::vector<std::vector<std::uint32_t>> parts(chunks_of(cells.size(), part_size));
  parallel_chunks(cells.size(), part_size,
                  [&](std::size_t part, std::size_t first, std::size_t end) {
                    std::vector<std::uint32_t> counts(finest.count());
                    for (std::size_t i = first; i < end; ++i) {
                      const unsigned bits = bits_of(cells[i]);
                      ++counts[finest.key(cells[i], bits)];
                      census.sums[i / kTaskCells][bits] += cells[i];
                    }
                    parts[part] = std::move(counts);
                  });
  for (const std::vector<std::uint32_t>& counts : parts) {
    std::ranges::transform(census.counts, counts, census.counts.begin(), std::plus<>());
  }
  return census;
}

/// The brightest cells, at most kOwnMasses, in their order.
std::vector<std::size_t> brightest(std::span<const std::uint64_t> cells,
                                   std::span<const std::size_t> counts) {
  std::size_t key = counts.size();
  std::size_t above = 0;
  while (key > 1 && above + counts[key - 1] <= kOwnMasses) above += counts[--key];
  // Those with this key or a higher one fit; some with the key below do too.
  const Steps finest(kMostDigits);
  const std::uint64_t all_from = finest.mass(key);
  const std::uint64_t some_from = key > 1 ? finest.mass(key - 1) : all_from;
  std::vector<std::vector<std::size_t>> found(chunks_of(cells.size(), kTaskCells));
  parallel_chunks(cells.size(), kTaskCells,
                  [&](std::size_t chunk, std::size_t first, std::size_t end) {
                    for (std::size_t i = first; i < end; ++i) {
                      if (cells[i] < some_from) continue;
                      if (cells[i] >= all_from || found[chunk].size() < kOwnMasses)
                        found[chunk].push_back(i);
                    }
                  });
  std::size_t more = kOwnMasses - above;
  std::vector<std::size_t> own;
  for (const std::vector<std::size_t>& of_chunk : found) {
    for (const std::size_t cell : of_chunk) {
      const bool one_of_some = cells[cell] < all_from;
      if (one_of_some && more == 0) continue;
      if (one_of_some) --more;
      own.push_back(cell);
    }
  }
  return own;
}

/// The most digits for which at most `most` different masses remain, of cells that were counted by
/// their keys at kMostDigits. Rounding may go up by one step.
unsigned digits_for(std::span<const std::size_t> counts, std::size_t most) {
  const Steps finest(kMostDigits);
  for (unsigned digits = kMostDigits;; --digits) {
    const Steps steps(digits);
    std::size_t different = 0;
    std::size_t last = 0;  // the key that is counted with its next one
    for (std::size_t fine = 0; fine < counts.size(); ++fine) {
      if (counts[fine] == 0) continue;
      const std::size_t key = steps.key(finest.mass(fine));
      if (different == 0 || key > last + 1) {
        different += 2;
      } else if (key == last + 1) {
        different += 1;
      }
      last = key;
    }
    if (different <= most || digits == 1) return digits;
  }
}

/// Turns the sums of chunks into what each chunk carries on from those before it: of every number
/// of bits what is below a step. Returns what the last leaves.
ByBits carry_on(std::span<ByBits> sums, const Steps& steps) {
  ByBits carry{};
  for (ByBits& chunk : sums) {
    ByBits after{};
    for (unsigned bits = 0; bits < after.size(); ++bits) {
      const std::uint64_t step = std::uint64_t{1} << steps.step(bits);
      after[bits] = (carry[bits] + chunk[bits]) & (step - 1);
    }
    chunk = std::exchange(carry, after);
  }
  return carry;
}

/// Which keys are in use; several threads may set them.
class Marks {
 public:
  explicit Marks(std::size_t count) : marks_(count) {}
  void set(std::size_t key) {
    const std::atomic_ref<char> mark(marks_[key]);
    if (mark.load(std::memory_order_relaxed) == 0) mark.store(1, std::memory_order_relaxed);
  }
  /// No other thread sets any more.
  bool has(std::size_t key) const { return marks_[key] != 0; }

 private:
  std::vector<char> marks_;
};

/// Rounds down; what that leaves goes on to the next of as many bits.
void round_cells(std::span<std::uint64_t> cells, const Steps& steps, ByBits& carry, Marks& used) {
  for (std::uint64_t& cell : cells) {
    const unsigned bits = bits_of(cell);
    // Each waits for the one before it: nothing but the sum and the rest is on that way.
    const std::uint64_t below_step = (std::uint64_t{1} << steps.step(bits)) - 1;
    const std::uint64_t sum = cell + carry[bits];
    carry[bits] = sum & below_step;
    cell = sum & ~below_step;
    used.set(steps.key(cell, bits));
  }
}

/// All but some, which are given in their order.
void round_all_but(std::span<const std::size_t> own, std::span<std::uint64_t> cells,
                   const Steps& steps, std::span<const ByBits> carries, Marks& used) {
  parallel_chunks(cells.size(), kTaskCells,
                  [&](std::size_t chunk, std::size_t first, std::size_t end) {
                    ByBits carry = carries[chunk];
                    auto next = std::ranges::lower_bound(own, first);
                    while (first < end) {
                      const std::size_t stop = next == own.end() ? end : std::min(end, *next);
                      round_cells(cells.subspan(first, stop - first), steps, carry, used);
                      if (stop < end) ++next;
                      first = stop + 1;
                    }
                  });
}

}  // namespace

MassPalette::MassPalette(TableVector<std::uint64_t> exact, unsigned bits)
    : cells(std::move(exact)), codes(cells.size()) {
  const std::size_t most = std::size_t{1} << bits;
  if (cells.size() <= most) {
    keep_all();
  } else {
    assert(bits >= 11 && bits <= 16);
    round_all(most);
  }
}

void MassPalette::keep_all() {
  masses.assign(cells.begin(), cells.end());
  std::iota(codes.begin(), codes.end(), std::uint16_t{0});
}

void MassPalette::round_all(std::size_t most) {
  auto [counts, sums] = census_of(cells);
  const std::vector<std::size_t> own = brightest(cells, counts);
  for (const std::size_t cell : own) sums[cell / kTaskCells][bits_of(cells[cell])] -= cells[cell];
  const Steps steps(digits_for(counts, most - kOwnMasses));
  const ByBits carry = carry_on(sums, steps);
  Marks used(steps.count());
  round_all_but(own, cells, steps, sums, used);

  std::vector<std::uint16_t> code_of(steps.count());
  for (std::size_t key = 0; key < code_of.size(); ++key) {
    if (used.has(key)) code_of[key] = add(steps.mass(key));
  }
  parallel_chunks(cells.size(), kTaskCells,
                  [&](std::size_t /*chunk*/, std::size_t first, std::size_t end) {
                    for (std::size_t i = first; i < end; ++i)
                      codes[i] = code_of[steps.key(cells[i])];
                  });
  const std::uint64_t left = std::accumulate(carry.begin(), carry.end(), std::uint64_t{0});
  for (std::size_t k = 0; k < own.size(); ++k) {
    cells[own[k]] += left / own.size() + (k < left % own.size() ? 1 : 0);
    codes[own[k]] = add(cells[own[k]]);
  }
  assert(masses.size() <= most);
}

std::uint16_t MassPalette::add(std::uint64_t mass) {
  masses.push_back(mass);
  return static_cast<std::uint16_t>(masses.size() - 1);
}

}  // namespace lightproof
