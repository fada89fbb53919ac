// Memory for tables that are read at random. The processor remembers where some thousand pages
// lie; of 4 kB each that covers less than a table of a large map, and every other read pays for a
// walk through the page table. Pages of 2 MB are asked for, where the system has them (Linux:
// transparent huge pages); where it has none the same memory is used as it comes.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace lightproof {

/// Bytes of a huge page; smaller tables are left to the usual heap.
inline constexpr std::size_t kHugePage = std::size_t{1} << 21U;

/// There are not so many bytes for one table.
class NoMemoryForTable : public std::bad_alloc {
 public:
  explicit NoMemoryForTable(std::size_t bytes) : bytes_(bytes) {}

  const char* what() const noexcept override { return "not enough memory for a table"; }
  std::size_t bytes() const { return bytes_; }

 private:
  std::size_t bytes_;
};

/// Memory for a table, at least 64-byte aligned, on huge pages where the system gives them. Throws
/// NoMemoryForTable.
void* allocate_table(std::size_t bytes);
/// Gives back what allocate_table() gave for so many bytes.
void free_table(void* memory, std::size_t bytes) noexcept;

/// An allocator of standard containers whose memory comes from allocate_table().
template <class T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  explicit(false) HugePageAllocator(const HugePageAllocator<U>& /*other*/) {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_table(count * sizeof(T))); }
  /// Elements that are made without a value have none: whoever writes them is the first to touch
  /// their pages.
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0 && std::is_trivially_default_constructible_v<U>) {
      ::new (static_cast<void*>(at)) U;
    } else {
      std::construct_at(at, std::forward<Arguments>(arguments)...);
    }
  }
  void deallocate(T* memory, std::size_t count) noexcept { free_table(memory, count * sizeof(T)); }

  friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }
};

/// A vector on huge pages. Elements that are made without a value have none.
template <class T>
using TableVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace lightproof
