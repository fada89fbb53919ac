// In the place of core/child_conversation.cpp: what reads pictures, or runs plug-ins, talks to a
// part of this process, which libFuzzer and the sanitizers can look into.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "lightproof/core/child_conversation.h"

namespace lightproof::fuzz {

/// What stands at the other end of every ChildConversation, one at a time.
class ChildInProcess {
 public:
  ChildInProcess() = default;
  virtual ~ChildInProcess() = default;
  ChildInProcess(const ChildInProcess&) = delete;
  ChildInProcess& operator=(const ChildInProcess&) = delete;

  /// A conversation begins; the descriptors are those of the files, of this process.
  virtual void begin(std::span<const int> files) = 0;
  virtual void take(std::span<const std::byte> bytes) = 0;
  /// Fills all of the bytes, if it is done.
  virtual Exchange give(std::span<std::byte> bytes) = 0;
  virtual void end() = 0;
  /// How it ended.
  virtual std::optional<ChildEnd> ending() { return ChildEnd{}; }
};

/// The one that is talked to.
void set_child(ChildInProcess& child);

}  // namespace lightproof::fuzz
