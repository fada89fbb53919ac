// In the place of core/child_conversation.cpp: what reads pictures talks to a part of this process,
// which libFuzzer and the sanitizers can look into.
#pragma once

#include <cstddef>
#include <span>

namespace lightproof::fuzz {

/// What stands at the other end of every ChildConversation, one at a time.
class ChildInProcess {
 public:
  ChildInProcess() = default;
  virtual ~ChildInProcess() = default;
  ChildInProcess(const ChildInProcess&) = delete;
  ChildInProcess& operator=(const ChildInProcess&) = delete;

  /// A conversation begins; the descriptor is that of the file.
  virtual void begin(int file) = 0;
  virtual void take(std::span<const std::byte> bytes) = 0;
  /// Fills all of the bytes; false if there are no more.
  virtual bool give(std::span<std::byte> bytes) = 0;
  virtual void end() = 0;
};

/// The one that is talked to.
void set_child(ChildInProcess& child);

}  // namespace lightproof::fuzz
