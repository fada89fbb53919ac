#include "lightproof/core/shared_memory.h"

#include <fcntl.h>
#include <linux/memfd.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <new>

namespace lightproof {
namespace {

/// No system has more than its memory, and asked for more it ends programs in place of saying no.
bool can_be_had(std::size_t bytes) {
  const auto pages = static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES));
  return bytes / static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) < pages;
}

/// Takes the memory now: later the system would end whoever writes first, for want of it.
bool take(int descriptor, std::size_t bytes) {
  const auto size = static_cast<off_t>(bytes);
  if (::ftruncate(descriptor, size) != 0) return false;
  int error = 0;
  do {
    error = ::posix_fallocate(descriptor, 0, size);
  } while (error == EINTR);
  return error == 0;
}

}  // namespace

SharedMemory::SharedMemory(std::size_t bytes) {
  if (!can_be_had(bytes)) throw std::bad_alloc();
  descriptor_ = ::memfd_create("lightproof", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor_ < 0) throw std::bad_alloc();
  void* at = take(descriptor_, bytes)
                 ? ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0)
                 : MAP_FAILED;
  if (at == MAP_FAILED) {
    ::close(descriptor_);
    throw std::bad_alloc();
  }
  ::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW);
  bytes_ = {static_cast<std::byte*>(at), bytes};
}

SharedMemory::~SharedMemory() {
  ::munmap(bytes_.data(), bytes_.size());
  ::close(descriptor_);
}

void SharedMemory::close_to_others() const {
  // A system that does not know this seal leaves the children able to write what they are given.
  ::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_FUTURE_WRITE);
}

}  // namespace lightproof
