// Another program that is talked to while it runs.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightproof/core/child_status.h"

namespace lightproof {

/// What became of bytes that were to be sent or received.
enum class Exchange {
  done,
  closed,  ///< the program has ended, or closed its end
  silent,  ///< it neither took nor gave a byte for as long as there is patience
};

/// How a program ended: its exit status, or the signal that ended it.
struct ChildEnd {
  bool by_signal = false;
  int code = 0;
  std::uint64_t peak_bytes = 0;  ///< the most memory that it held at once, shared memory included
};

/// A program whose standard input and output are one end of a socket, of which this is the other.
/// Its standard error goes nowhere. What is left of it is ended with this. SIGCHLD is not ignored
/// meanwhile, even if it was before.
class ChildConversation {
 public:
  /// Starts `program`; `file`, unless it is -1, is its descriptor 3. Throws InputError if it cannot
  /// be started.
  ChildConversation(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                    int file, std::chrono::milliseconds patience);
  /// Starts `program`; `files` are its descriptors 3, 4, … .
  ChildConversation(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                    std::span<const int> files, std::chrono::milliseconds patience);
  ~ChildConversation();
  ChildConversation(const ChildConversation&) = delete;
  ChildConversation& operator=(const ChildConversation&) = delete;

  /// Sends all of the bytes. Throws Interrupted if an interrupt was requested.
  Exchange send(std::span<const std::byte> bytes);
  /// Fills all of the bytes. Throws Interrupted if an interrupt was requested.
  Exchange receive(std::span<std::byte> bytes);
  /// Closes this end, waits until the program has ended, and ends it where it does not within a
  /// moment. None if nobody knows how it ended.
  std::optional<ChildEnd> end();
  /// How long the program may be silent from now on.
  void set_patience(std::chrono::milliseconds patience) { patience_ = patience; }
  /// The process, until it was waited for.
  pid_t id() const { return child_; }

 private:
  /// Waits until the socket is ready for what is asked for.
  Exchange wait_for(short events);

  ChildStatusKept status_kept_;
  std::chrono::milliseconds patience_;
  int socket_ = -1;
  pid_t child_ = -1;
};

}  // namespace lightproof
