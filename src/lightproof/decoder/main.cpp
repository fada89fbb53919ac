// lightproof-decode: decodes or encodes one picture for whoever started it.
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lightproof/core/companion_start.h"
#include "lightproof/core/failure.h"
#include "lightproof/decoder/confinement.h"
#include "lightproof/decoder/conversation.h"
#include "lightproof/decoder/picture_decoder.h"
#include "lightproof/decoder/picture_encoder.h"
#include "lightproof/decoder/refusal.h"

namespace lightproof {
namespace {

constexpr int kFile = 3;
/// For all that comes before the pixels: six times the table of a file of tiles of 16 x 16 of the
/// largest picture.
constexpr std::uint64_t kHeaderBytes = std::uint64_t{96} << 20U;
constexpr double kHeaderSeconds = 1.0;
/// Beside what a format needs: lines that are handed over, copies of them, code.
constexpr std::uint64_t kMoreBytes = 4 * kBytesAtOnce;
constexpr double kMoreSeconds = 2.0;
/// Ten times what the slowest compression takes.
constexpr double kSecondsOfSample = 1e-6;

void check_version(const std::string& theirs) {
  if (theirs == LIGHTPROOF_VERSION) return;
  refuse(fmt::format("the decoder is of version {}, and version {} needed: install both together",
                     LIGHTPROOF_VERSION, theirs));
}

std::string_view name_of(PictureFormat format) {
  switch (format) {
    case PictureFormat::openexr:
      return "OpenEXR";
    case PictureFormat::radiance:
      return "Radiance .hdr";
    case PictureFormat::png:
      return "PNG";
    case PictureFormat::jpeg:
      break;
  }
  return "JPEG";
}

/// Runs `work`; what a library throws is a reason to refuse the file.
template <class Work>
void with_reasons(std::string_view what, const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    answer_value(MessageKind::failed, DecoderFailure{.reason = error.what()});
  } catch (const std::bad_alloc&) {
    answer_value(MessageKind::failed, DecoderFailure{.is_memory = true, .reason = ""});
  } catch (const std::exception& error) {
    answer_value(MessageKind::failed,
                 DecoderFailure{.reason = fmt::format("{}: {}", what, error.what())});
  } catch (...) {
    answer_value(MessageKind::failed,
                 DecoderFailure{.reason = fmt::format("{}: unknown error", what)});
  }
}

void decode(const OpenRequest& request) {
  check_version(request.version);
  limit(kHeaderBytes, kHeaderSeconds);
  ByteReader bytes(kFile);
  const auto decoder = open_picture(bytes, request);
  answer_value(MessageKind::picture, decoder->picture());
  const std::optional<MessageHead> next = next_request();
  if (!next || next->kind != MessageKind::read) return;
  const auto read = value_of<ReadRequest>(*next);
  const DecodingCost cost = decoder->cost();
  limit(kHeaderBytes + kMoreBytes + cost.bytes,
        seconds_taken() + kMoreSeconds + kSecondsOfSample * static_cast<double>(cost.samples));
  decoder->read(
      read, [](std::span<const float> rows) { answer(MessageKind::rows, std::as_bytes(rows)); });
  answer_value(MessageKind::done, decoder->notes());
}

/// The samples of all levels, each of which is a message of its own.
class IncomingSamples {
 public:
  void fill(std::span<std::byte> bytes) {
    while (!bytes.empty()) {
      while (left_ == 0) {
        const std::optional<MessageHead> head = next_request();
        if (!head || head->kind != MessageKind::values) refuse("cannot be written: samples needed");
        left_ = head->bytes;
      }
      const std::span<std::byte> now = bytes.first(std::min<std::uint64_t>(left_, bytes.size()));
      receive(now);
      left_ -= now.size();
      bytes = bytes.subspan(now.size());
    }
  }

 private:
  std::uint64_t left_ = 0;
};

void encode(const EncodeRequest& request) {
  check_version(request.version);
  IncomingSamples samples;
  const NextSamples next = [&](std::span<std::byte> bytes) { samples.fill(bytes); };
  std::string file;
  switch (request.format) {
    case PictureFormat::openexr:
      file = exr_file(request, next);
      break;
    case PictureFormat::radiance:
      file = radiance_file(request, next);
      break;
    case PictureFormat::png:
      file = png_file(request, next);
      break;
    case PictureFormat::jpeg:
      refuse("cannot be written: JPEG is read only");
  }
  answer(MessageKind::file, std::as_bytes(std::span(file)));
}

void converse() {
  const std::optional<MessageHead> head = next_request();
  if (!head) return;
  if (head->kind == MessageKind::encode) {
    with_reasons("cannot be written", [&] { encode(value_of<EncodeRequest>(*head)); });
  } else if (head->kind == MessageKind::open) {
    const auto request = value_of<OpenRequest>(*head);
    with_reasons(fmt::format("cannot be read as {}", name_of(request.format)),
                 [&] { decode(request); });
  }
}

constexpr const char* kUsage =
    "lightproof-decode decodes and encodes pictures for lightproof and programs that are built "
    "with\n"
    "its libraries, which start it themselves: it has no use of its own.\n"
    "  --version   print the version\n"
    "  --help      print this\n";

}  // namespace
}  // namespace lightproof

int main(int argc, char** argv) {
  using namespace lightproof;
  if (argc > 1 || !is_socket(STDIN_FILENO)) {
    return explain_companion("lightproof-decode", kUsage, argc, argv);
  }
  confine();
  try {
    converse();
  } catch (...) {
    return kProgramFailed;
  }
  // Libraries may still have threads, and nothing of them matters any more.
  ::_exit(0);
}
