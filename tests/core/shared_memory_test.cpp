#include "lightproof/core/shared_memory.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <new>

namespace lightproof {
namespace {

constexpr std::size_t kBytes = 8192;

TEST(SharedMemory, IsTheSameForWhoeverHasTheDescriptor) {
  const SharedMemory memory(kBytes);
  memory.bytes()[17] = std::byte{42};
  std::byte seen{};
  ASSERT_EQ(::pread(memory.descriptor(), &seen, 1, 17), 1);
  EXPECT_EQ(seen, std::byte{42});
  const std::byte written{7};
  ASSERT_EQ(::pwrite(memory.descriptor(), &written, 1, 18), 1);
  EXPECT_EQ(memory.bytes()[18], std::byte{7});
}

TEST(SharedMemory, CannotBeMadeSmallerOrLarger) {
  const SharedMemory memory(kBytes);
  EXPECT_NE(::ftruncate(memory.descriptor(), 1), 0);
  EXPECT_NE(::ftruncate(memory.descriptor(), 2 * kBytes), 0);
  EXPECT_EQ(memory.bytes()[kBytes - 1], std::byte{0});
}

TEST(SharedMemory, ClosedToOthersIsStillWrittenHere) {
  const SharedMemory memory(kBytes);
  memory.close_to_others();
  memory.bytes()[0] = std::byte{1};
  void* other = ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, memory.descriptor(), 0);
  EXPECT_EQ(other, MAP_FAILED);
  if (other != MAP_FAILED) ::munmap(other, kBytes);
}

TEST(SharedMemory, ThatIsNotThereIsLackOfMemory) {
  EXPECT_THROW(SharedMemory(std::size_t{1} << 62U), std::bad_alloc);
}

}  // namespace
}  // namespace lightproof
