#include "lightproof/image/decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <iterator>
#include <optional>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/decoder_program.h"

namespace lightproof {
namespace {

constexpr std::size_t kLongestReason = 600;
constexpr std::string_view kDamaged =
    "the file is damaged or made to do harm; write it again with the program that made it";

/// How a decoder ended that said nothing of it.
std::string words_of(const ChildEnd& end) {
  if (!end.by_signal) return fmt::format("the decoder ended with status {}", end.code);
  if (end.code == SIGXCPU) return "the decoder took more processor time than such a picture needs";
  if (end.code == SIGKILL) return "the decoder was killed (signal 9), as systems without memory do";
  return fmt::format("the decoder crashed (signal {}, {})", end.code, ::strsignal(end.code));
}

}  // namespace

std::string first_line(std::string text) {
  text.resize(std::min(text.find_first_of("\r\n"), std::min(text.size(), kLongestReason)));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text.empty() ? "no reason given" : text;
}

Decoder::Decoder(std::string subject, std::string failing, int file,
                 std::chrono::milliseconds patience)
    : subject_(std::move(subject)),
      failing_(std::move(failing)),
      position_("at the start"),
      program_(decoder_program()),
      patience_(patience),
      child_(program_, {}, file, patience) {}

void Decoder::fail(const std::string& reason) const {
  throw InputError(fmt::format("{}: {}: {}", subject_, failing_, reason));
}

void Decoder::fail_nonsense() {
  fail(
      fmt::format("the decoder gave an answer that makes no sense {}: {}; is {} the one of this "
                  "installation?",
                  position_, kDamaged, program_.string()));
}

void Decoder::fail_ended() {
  const std::optional<ChildEnd> end = child_.end();
  throw_if_interrupted();  // a Ctrl-C reaches both
  if (!end) fail(fmt::format("nobody knows how the decoder ended {}: try again", position_));
  if (!end->by_signal) {
    fail(fmt::format("{} {}: is {} the one of this installation?", words_of(*end), position_,
                     program_.string()));
  }
  fail(fmt::format("{} {}: {}", words_of(*end), position_, kDamaged));
}

void Decoder::require(Exchange exchange) {
  if (exchange == Exchange::closed) fail_ended();
  if (exchange == Exchange::silent) {
    fail(fmt::format("the decoder stood still for {} s {}: {}",
                     1e-3 * static_cast<double>(patience_.count()), position_, kDamaged));
  }
}

void Decoder::send(MessageKind kind, std::span<const std::byte> bytes) {
  const MessageHead head = {.kind = kind, .bytes = bytes.size()};
  if (child_.send(std::as_bytes(std::span(&head, 1))) == Exchange::done &&
      child_.send(bytes) == Exchange::done) {
    return;
  }
  // It may have said why.
  next();
  fail_nonsense();
}

MessageHead Decoder::next() {
  throw_if_interrupted();
  MessageHead head;
  require(child_.receive(std::as_writable_bytes(std::span(&head, 1))));
  if (head.kind != MessageKind::failed) return head;
  const auto failure = value_of<DecoderFailure>(head, MessageKind::failed);
  if (failure.is_memory) {
    fail(fmt::format("decoding needs more memory {} than such a picture can need: {}", position_,
                     kDamaged));
  }
  throw InputError(fmt::format("{}: {}", subject_, first_line(failure.reason)));
}

void Decoder::receive(std::span<std::byte> bytes) { require(child_.receive(bytes)); }

}  // namespace lightproof
