// Values as bytes: what is kept of measurements, and the messages between the program and its
// decoder.
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lightproof/core/kept_file.h"
#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/serialise.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/image/decoder_messages.h"
#include "lightproof/image/stored_picture.h"
#include "lightproof/results/recommendation_survey.h"
#include "tests/fuzz/fuzz.h"

namespace lightproof::fuzz {
namespace {

template <class Value>
std::string bytes_of(const Value& value) {
  ValueWriter writer;
  writer.add(value);
  return writer.take();
}

/// Reads a value, which must come back whole from its own bytes.
template <class Value>
void read_as(std::string_view bytes) {
  Value value;
  try {
    value = ValueReader(bytes).value<Value>();
  } catch (const std::out_of_range&) {
    return;
  }
  const std::string written = bytes_of(value);
  ValueReader again(written);
  if (bytes_of(again.value<Value>()) != written || !again.is_at_end()) {
    fail("a value does not come back from its bytes");
  }
}

void read_file(std::string_view bytes) {
  static const TemporaryFolder folder;
  static const KeptFile kept = {folder / "", "fuzz", "identity"};
  static const std::filesystem::path path = [] {
    if (!keep(kept, "content")) fail("nothing can be kept");
    return std::filesystem::directory_iterator(folder / "")->path();
  }();
  std::ofstream(path, std::ios::binary) << bytes;
  read_kept(kept);
}

}  // namespace
}  // namespace lightproof::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lightproof;
  using namespace lightproof::fuzz;
  Input input(data, size);
  const std::size_t kind = input.below(8);
  const std::string_view bytes = input.text();
  if (kind == 0) read_file(bytes);
  if (kind == 1) read_as<StoredPicture>(bytes);
  if (kind == 2) read_as<EncodeRequest>(bytes);
  if (kind == 3) read_as<ReadRequest>(bytes);
  if (kind == 4) read_as<DecoderFailure>(bytes);
  if (kind == 5) read_as<KeptMeasurement<RecommendationSurvey>>(bytes);
  if (kind == 6) read_as<std::vector<std::optional<std::vector<bool>>>>(bytes);
  if (kind == 7) read_as<std::variant<double, std::string, std::vector<std::int8_t>>>(bytes);
  return 0;
}
