#include "tests/fuzz/fuzz.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>

#include "lightproof/core/parallel.h"

namespace lightproof::fuzz {
namespace {

std::atomic<std::size_t> largest_allocation = std::numeric_limits<std::size_t>::max();
/// One input after the other, the same way each time.
const ThreadLimit one_thread(1);

}  // namespace

MemoryFile::MemoryFile(std::string_view bytes)
    : descriptor_(::memfd_create("lightproof-fuzz", MFD_CLOEXEC)) {
  const bool is_written = descriptor_ >= 0 && ::write(descriptor_, bytes.data(), bytes.size()) ==
                                                  static_cast<ssize_t>(bytes.size());
  if (!is_written) fail("no memory for a file");
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::filesystem::path MemoryFile::path() const {
  return fmt::format("/proc/self/fd/{}", descriptor_);
}

void fail(std::string_view what) {
  fmt::print(stderr, "{}\n", what);
  std::abort();
}

void require_words(const std::string& refusal) {
  if (refusal.empty()) fail("refused without a word");
  if (refusal.find('\n') != std::string::npos) fail("a refusal of several lines: " + refusal);
}

void limit_allocations(std::size_t bytes) { largest_allocation = bytes; }

namespace {

void* allocate(std::size_t bytes, std::size_t alignment = alignof(std::max_align_t)) noexcept {
  if (bytes > largest_allocation.load(std::memory_order_relaxed)) return nullptr;
  const std::size_t rounded =
      (std::max<std::size_t>(bytes, 1) + alignment - 1) / alignment * alignment;
  return std::aligned_alloc(alignment, rounded);
}

void* there(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace
}  // namespace lightproof::fuzz

// In the place of those of the address sanitizer, which end the process where there is no memory.
// It still watches over what they return.
using lightproof::fuzz::allocate;
using lightproof::fuzz::there;
using Alignment = std::align_val_t;
using std::nothrow_t;
using std::size_t;
void* operator new(size_t bytes) { return there(allocate(bytes)); }
void* operator new[](size_t bytes) { return there(allocate(bytes)); }
void* operator new(size_t bytes, const nothrow_t& /*tag*/) noexcept { return allocate(bytes); }
void* operator new[](size_t bytes, const nothrow_t& /*tag*/) noexcept { return allocate(bytes); }
void* operator new(size_t bytes, Alignment to) {
  return there(allocate(bytes, static_cast<size_t>(to)));
}
void* operator new[](size_t bytes, Alignment to) {
  return there(allocate(bytes, static_cast<size_t>(to)));
}
void* operator new(size_t bytes, Alignment to, const nothrow_t& /*tag*/) noexcept {
  return allocate(bytes, static_cast<size_t>(to));
}
void* operator new[](size_t bytes, Alignment to, const nothrow_t& /*tag*/) noexcept {
  return allocate(bytes, static_cast<size_t>(to));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, const nothrow_t& /*tag*/) noexcept { std::free(memory); }
void operator delete[](void* memory, const nothrow_t& /*tag*/) noexcept { std::free(memory); }
void operator delete(void* memory, size_t /*bytes*/) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t /*bytes*/) noexcept { std::free(memory); }
void operator delete(void* memory, Alignment /*to*/) noexcept { std::free(memory); }
void operator delete[](void* memory, Alignment /*to*/) noexcept { std::free(memory); }
void operator delete(void* memory, size_t /*bytes*/, Alignment /*to*/) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, size_t /*bytes*/, Alignment /*to*/) noexcept {
  std::free(memory);
}
void operator delete(void* memory, Alignment /*to*/, const nothrow_t& /*tag*/) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, Alignment /*to*/, const nothrow_t& /*tag*/) noexcept {
  std::free(memory);
}
