// Memory that this process shares with programs that it starts.
#pragma once

#include <cstddef>
#include <span>

namespace lightproof {

/// A block of memory, of which a child that gets the descriptor has the same bytes. Nobody can make
/// it larger or smaller; all of it is there before anybody writes.
class SharedMemory {
 public:
  /// Throws std::bad_alloc if there is not so much.
  explicit SharedMemory(std::size_t bytes);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// From now on only this process can write.
  void close_to_others() const;

  int descriptor() const { return descriptor_; }
  std::span<std::byte> bytes() const { return bytes_; }

 private:
  int descriptor_ = -1;
  std::span<std::byte> bytes_;
};

}  // namespace lightproof
