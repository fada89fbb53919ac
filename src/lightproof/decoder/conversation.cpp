#include "lightproof/decoder/conversation.h"

#include <unistd.h>

#include <cstdlib>

#include "lightproof/core/failure.h"
#include "lightproof/core/system_call.h"

namespace lightproof {
namespace {

/// False if the other end closed before the first byte.
bool read_all(std::span<std::byte> bytes) {
  const bool is_empty = bytes.empty();
  bool began = false;
  while (!bytes.empty()) {
    const ssize_t got =
        uninterrupted([&] { return ::read(STDIN_FILENO, bytes.data(), bytes.size()); });
    if (got <= 0) {
      if (began) ::_exit(kInputFailed);
      return false;
    }
    began = true;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return began || is_empty;
}

void write_all(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written =
        uninterrupted([&] { return ::write(STDOUT_FILENO, bytes.data(), bytes.size()); });
    if (written <= 0) ::_exit(kInputFailed);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace

std::optional<MessageHead> next_request() {
  MessageHead head;
  if (!read_all(std::as_writable_bytes(std::span(&head, 1)))) return std::nullopt;
  return head;
}

void receive(std::span<std::byte> bytes) {
  if (!read_all(bytes)) ::_exit(kInputFailed);
}

void answer(MessageKind kind, std::span<const std::byte> bytes) {
  const MessageHead head = {.kind = kind, .bytes = bytes.size()};
  write_all(std::as_bytes(std::span(&head, 1)));
  write_all(bytes);
}

}  // namespace lightproof
