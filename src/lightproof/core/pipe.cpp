#include "lightproof/core/pipe.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/system_call.h"

namespace lightproof {

Pipe::Pipe() {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw InputError(fmt::format("no pipe to another program can be opened: {}",
                                 std::generic_category().message(errno)));
  }
  read_end_ = ends[0];
  write_end_ = ends[1];
}

Pipe::~Pipe() {
  ::close(read_end_);
  close_write_end();
}

void Pipe::close_write_end() {
  if (write_end_ >= 0) ::close(std::exchange(write_end_, -1));
}

std::string Pipe::take(std::size_t most) const {
  std::string taken(most, '\0');
  std::size_t size = 0;
  while (size < most) {
    pollfd ready = {.fd = read_end_, .events = POLLIN, .revents = 0};
    if (uninterrupted([&] { return ::poll(&ready, 1, 0); }) <= 0) break;
    const ssize_t got =
        uninterrupted([&] { return ::read(read_end_, taken.data() + size, most - size); });
    if (got <= 0) break;
    size += static_cast<std::size_t>(got);
  }
  taken.resize(size);
  return taken;
}

}  // namespace lightproof
