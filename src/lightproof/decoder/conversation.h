// The messages of image/decoder_messages.h from this program's side: requests come on standard
// input, answers go to standard output. Where whoever started it has gone, the program ends.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "lightproof/core/serialise.h"
#include "lightproof/image/decoder_messages.h"

namespace lightproof {

/// The head of the next request; none if there is no more.
std::optional<MessageHead> next_request();

/// Bytes of the request whose head came last.
void receive(std::span<std::byte> bytes);

template <class Value>
Value value_of(const MessageHead& head) {
  if (head.bytes > kLongestValue) throw std::length_error("a request is too long");
  std::string bytes(head.bytes, '\0');
  receive(std::as_writable_bytes(std::span(bytes)));
  return ValueReader(bytes).value<Value>();
}

void answer(MessageKind kind, std::span<const std::byte> bytes);

template <class Value>
void answer_value(MessageKind kind, const Value& value) {
  ValueWriter writer;
  writer.add(value);
  const std::string bytes = writer.take();
  answer(kind, std::as_bytes(std::span(bytes)));
}

}  // namespace lightproof
