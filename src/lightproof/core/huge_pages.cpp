#include "lightproof/core/huge_pages.h"

#include <sys/mman.h>

#include <limits>
#include <new>

namespace lightproof {
namespace {

constexpr std::align_val_t kCacheLine{64};

std::align_val_t alignment_of(std::size_t bytes) {
  return bytes < kHugePage ? kCacheLine : std::align_val_t{kHugePage};
}

/// Whole pages: what shares one with other memory would not get it.
std::size_t rounded(std::size_t bytes) {
  if (bytes < kHugePage) return bytes;
  if (bytes > std::numeric_limits<std::size_t>::max() - kHugePage) throw NoMemoryForTable(bytes);
  return (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

}  // namespace

void* allocate_table(std::size_t bytes) {
  void* memory = ::operator new(rounded(bytes), alignment_of(bytes), std::nothrow);
  if (memory == nullptr) throw NoMemoryForTable(bytes);
#ifdef MADV_HUGEPAGE  // of Linux
  // Where the wish is not granted, nothing but speed is lost.
  if (bytes >= kHugePage) static_cast<void>(madvise(memory, rounded(bytes), MADV_HUGEPAGE));
#endif
  return memory;
}

void free_table(void* memory, std::size_t bytes) noexcept {
  ::operator delete(memory, alignment_of(bytes));
}

}  // namespace lightproof
