#include "lightproof/image/encoder.h"

#include <fmt/format.h>

#include <utility>

#include "lightproof/image/decoder.h"
#include "lightproof/image/file_format.h"

namespace lightproof {

std::string encode(EncodeRequest request,
                   const std::function<std::span<const std::byte>(int)>& samples_of) {
  Decoder decoder(fmt::format("{} file", info(request.format).name), "cannot be written", -1);
  decoder.now_at("while it wrote");
  request.version = LIGHTPROOF_VERSION;
  const int levels = static_cast<int>(request.levels.size());
  decoder.send(MessageKind::encode, request);
  for (int level = 0; level < levels; ++level) {
    decoder.send(MessageKind::values, samples_of(level));
  }
  const MessageHead head = decoder.next();
  if (head.kind != MessageKind::file) decoder.fail_nonsense();
  std::string bytes(head.bytes, '\0');
  decoder.receive(std::as_writable_bytes(std::span(bytes)));
  return bytes;
}

}  // namespace lightproof
