// Files of pictures: the decoder inside of this process, and all that reads a map.
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "lightproof/core/serialise.h"
#include "lightproof/decoder/byte_reader.h"
#include "lightproof/decoder/picture_decoder.h"
#include "lightproof/image/decoder_messages.h"
#include "tests/fuzz/child_in_process.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/read_map.h"

namespace lightproof::fuzz {
namespace {

/// Larger pictures and tiles cost time and show no other code.
constexpr std::int64_t kMostPixels = std::int64_t{1} << 18U;
/// What the decoder's process may take before pixels are read.
constexpr std::size_t kMostBytes = std::size_t{96} << 20U;

bool is_small(const StoredPicture& stored) {
  const auto fits = [](std::int64_t width, std::int64_t height) {
    return width < kMostPixels && height < kMostPixels && width * height < kMostPixels;
  };
  return fits(stored.data.width, stored.data.height) &&
         fits(stored.display.width, stored.display.height) &&
         fits(stored.tile_width, stored.tile_height) && stored.channels.size() < 64;
}

/// What decoder/main.cpp does, a message at a time.
class DecoderInProcess : public ChildInProcess {
 public:
  void begin(std::span<const int> files) override {
    end();
    file_ = files.empty() ? -1 : files.front();
  }
  void end() override {
    decoder_.reset();
    bytes_.reset();
    requests_.clear();
    answers_.clear();
    given_ = 0;
  }
  void take(std::span<const std::byte> bytes) override {
    requests_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  Exchange give(std::span<std::byte> bytes) override {
    if (answers_.size() - given_ < bytes.size()) answer_next();
    if (answers_.size() - given_ < bytes.size()) return Exchange::closed;
    std::memcpy(bytes.data(), answers_.data() + given_, bytes.size());
    given_ += bytes.size();
    return Exchange::done;
  }

 private:
  void answer_next() {
    if (requests_.size() < sizeof(MessageHead)) return;
    MessageHead head;
    std::memcpy(&head, requests_.data(), sizeof head);
    const std::string value = requests_.substr(sizeof head, head.bytes);
    requests_.erase(0, sizeof head + head.bytes);
    try {
      if (head.kind == MessageKind::open) open(ValueReader(value).value<OpenRequest>());
      if (head.kind == MessageKind::read) read(ValueReader(value).value<ReadRequest>());
    } catch (const std::bad_alloc&) {
      answer_value(MessageKind::failed, DecoderFailure{.is_memory = true, .reason = ""});
    } catch (const std::exception& error) {
      answer_value(MessageKind::failed, DecoderFailure{.reason = error.what()});
    }
  }
  void open(const OpenRequest& request) {
    bytes_.emplace(file_);
    decoder_ = open_picture(*bytes_, request);
    if (!is_small(decoder_->picture())) throw InputError("larger than what is read here");
    answer_value(MessageKind::picture, decoder_->picture());
  }
  void read(const ReadRequest& request) {
    static_cast<void>(decoder_->cost());
    decoder_->read(request, [&](std::span<const float> rows) {
      answer(MessageKind::rows, std::as_bytes(rows));
    });
    answer_value(MessageKind::done, decoder_->notes());
  }
  template <class Value>
  void answer_value(MessageKind kind, const Value& value) {
    ValueWriter writer;
    writer.add(value);
    const std::string bytes = writer.take();
    answer(kind, std::as_bytes(std::span(bytes)));
  }
  void answer(MessageKind kind, std::span<const std::byte> bytes) {
    const MessageHead head = {.kind = kind, .bytes = bytes.size()};
    answers_.append(reinterpret_cast<const char*>(&head), sizeof head);
    answers_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }

  int file_ = -1;
  std::optional<ByteReader> bytes_;
  std::unique_ptr<PictureDecoder> decoder_;
  std::string requests_;
  std::string answers_;
  std::size_t given_ = 0;
};

DecoderInProcess decoder;

}  // namespace
}  // namespace lightproof::fuzz

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  lightproof::fuzz::set_child(lightproof::fuzz::decoder);
  lightproof::fuzz::limit_allocations(lightproof::fuzz::kMostBytes);
  return 0;
}

// The last bytes choose the options: any picture is an input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lightproof::fuzz;
  constexpr std::size_t kChoices = 8;
  const MemoryFile file(Input(data, size).text());
  const std::size_t first = size > kChoices ? size - kChoices : 0;
  read_map(file.path(), Input(data + first, size - first));
  return 0;
}
