// What the program that decodes answers, if somebody has taken it over: any bytes.
#include "tests/fuzz/child_in_process.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/read_map.h"

namespace lightproof::fuzz {
namespace {

class AnyAnswers : public ChildInProcess {
 public:
  void set(std::span<const std::uint8_t> answers) { answers_ = answers; }
  void begin(std::span<const int> /*files*/) override { left_ = answers_; }
  void take(std::span<const std::byte> /*bytes*/) override {}
  Exchange give(std::span<std::byte> bytes) override {
    if (bytes.size() > left_.size()) return Exchange::closed;
    std::memcpy(bytes.data(), left_.data(), bytes.size());
    left_ = left_.subspan(bytes.size());
    return Exchange::done;
  }
  void end() override {}

 private:
  std::span<const std::uint8_t> answers_;
  std::span<const std::uint8_t> left_;
};

AnyAnswers answers;

}  // namespace
}  // namespace lightproof::fuzz

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  lightproof::fuzz::set_child(lightproof::fuzz::answers);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lightproof::fuzz;
  // A file that is long enough for what is said of it.
  static const MemoryFile exr("\x76\x2f\x31\x01" + std::string(1 << 16U, '\0'));
  static const MemoryFile hdr("#?" + std::string(1 << 16U, '\0'));
  Input input(data, size);
  const MemoryFile& file = input.below(2) == 0 ? exr : hdr;
  Input choice(data, std::min<std::size_t>(size, 8));
  for (int i = 0; i < 7; ++i) input.take<std::uint8_t>();
  answers.set(input.rest());
  read_map(file.path(), choice);
  return 0;
}
