// The other end of lightproof-decode: a program that decodes or encodes one picture, and then ends.
// Whatever it meets with, a crash, a limit of its memory or its time, is an InputError here.
// Private to the image module.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "lightproof/core/child_conversation.h"
#include "lightproof/core/serialise.h"
#include "lightproof/image/decoder_messages.h"

namespace lightproof {

/// How long the program may neither take nor give a byte.
inline constexpr std::chrono::seconds kDecoderPatience{60};

class Decoder {
 public:
  /// Starts the program. Messages begin with `subject`, "sky.exr", and, where the program gives no
  /// reason itself, go on with `failing`, "cannot be read as OpenEXR". `file`, unless it is -1, is
  /// the descriptor that it reads. Throws InputError if the program is missing.
  Decoder(std::string subject, std::string failing, int file,
          std::chrono::milliseconds patience = kDecoderPatience);

  /// What is being done, as the end of a message: "in the header", "at row 7 of 512".
  void now_at(std::string position) { position_ = std::move(position); }

  template <class Value>
  void send(MessageKind kind, const Value& value) {
    ValueWriter writer;
    writer.add(value);
    const std::string bytes = writer.take();
    send(kind, std::as_bytes(std::span(bytes)));
  }
  void send(MessageKind kind, std::span<const std::byte> bytes);

  /// The head of the next message. Throws InputError if the program says that it failed, or did so
  /// without a word.
  MessageHead next();
  /// Bytes of the message whose head came last.
  void receive(std::span<std::byte> bytes);
  template <class Value>
  Value value_of(const MessageHead& head, MessageKind kind) {
    if (head.kind != kind || head.bytes > kLongestValue) fail_nonsense();
    std::string bytes(head.bytes, '\0');
    receive(std::as_writable_bytes(std::span(bytes)));
    try {
      return ValueReader(bytes).value<Value>();
    } catch (const std::out_of_range&) {
      fail_nonsense();
    }
  }

  /// Refuses the file because of an answer that the program cannot have meant.
  [[noreturn]] void fail_nonsense();

  pid_t id() const { return child_.id(); }

 private:
  void require(Exchange exchange);
  /// The program has ended in the middle.
  [[noreturn]] void fail_ended();
  [[noreturn]] void fail(const std::string& reason) const;

  std::string subject_;
  std::string failing_;
  std::string position_;
  std::filesystem::path program_;
  std::chrono::milliseconds patience_;
  ChildConversation child_;
};

/// The first line of what a program or library reported, for a message of one line.
std::string first_line(std::string text);

}  // namespace lightproof
