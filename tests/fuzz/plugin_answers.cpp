// What the process of a plug-in answers, if the plug-in has taken it over: any replies, any numbers
// in the memory that both share, any words in its log, any end.
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/core/text_escapes.h"
#include "lightproof/gate/sampler_failure.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/plugin/plugin_library.h"
#include "tests/fuzz/child_in_process.h"
#include "tests/fuzz/fuzz.h"

namespace lightproof::fuzz {
namespace {

constexpr std::array kSignals = {SIGSEGV, SIGKILL, SIGSYS, SIGABRT};

/// Answers of one process after the other, from one sequence of bytes.
class AnyPlugin : public ChildInProcess {
 public:
  /// How processes end, the numbers and the words are at the front, before the answers.
  void set(Input& input) {
    const std::size_t how = input.below(8);
    ending_.reset();
    if (how < kSignals.size()) ending_ = ChildEnd{true, kSignals[how], 0};
    if (how == 4) ending_ = ChildEnd{false, input.take<std::uint8_t>(), 0};
    if (how == 5) ending_ = ChildEnd{true, input.take<std::uint8_t>(), ~std::uint64_t{0}};
    without_answer_ = static_cast<Exchange>(input.below(3));
    numbers_.clear();
    for (std::size_t left = input.below(16); left > 0; --left) numbers_.push_back(number(input));
    step_ = 1 + input.below(7);
    words_.clear();
    for (std::size_t left = input.below(32); left > 0; --left) words_ += input.take<char>();
    left_ = input.rest();
  }

  void begin(std::span<const int> files) override {
    batch_ = files[0];
    const auto size = static_cast<ssize_t>(words_.size());
    if (::pwrite(files[1], words_.data(), words_.size(), 0) != size) fail("no log");
  }
  void take(std::span<const std::byte> bytes) override {
    PluginRequest request;
    if (bytes.size() != sizeof request) fail("no request");
    std::memcpy(&request, bytes.data(), sizeof request);
    if (numbers_.empty() || request.count == 0) return;
    // What went in is written over, too.
    std::size_t next = 0;
    const auto write = [&](std::size_t first, std::size_t count) {
      std::vector<double> values(count);
      for (double& value : values) value = numbers_[(next += step_) % numbers_.size()];
      const auto size = static_cast<ssize_t>(count * sizeof(double));
      const auto at = static_cast<off_t>(first * sizeof(double));
      if (::pwrite(batch_, values.data(), static_cast<std::size_t>(size), at) != size)
        fail("no batch");
    };
    write(0, kMostPositionNumbers * request.count);
    write(kPluginInputs, kMostPluginColumns * request.count);
  }
  Exchange give(std::span<std::byte> bytes) override {
    if (bytes.size() > left_.size() && without_answer_ != Exchange::done) return without_answer_;
    // Zeros are a reply that it is done.
    const std::size_t count = std::min(bytes.size(), left_.size());
    std::ranges::fill(bytes, std::byte{0});
    std::memcpy(bytes.data(), left_.data(), count);
    left_ = left_.subspan(count);
    return Exchange::done;
  }
  void end() override {}
  std::optional<ChildEnd> ending() override { return ending_; }

 private:
  /// Any number, or a component of unit vectors and coordinates, or what has been hard.
  static double number(Input& input) {
    constexpr std::array kNumbers = {0.0,
                                     -0.0,
                                     1.0,
                                     -1.0,
                                     0.6,
                                     -0.8,
                                     0.5,
                                     1.0 - 0x1p-53,
                                     std::numeric_limits<double>::infinity(),
                                     std::numeric_limits<double>::quiet_NaN(),
                                     std::numeric_limits<double>::denorm_min(),
                                     std::numeric_limits<double>::max()};
    const std::size_t kind = input.below(16);
    return kind < kNumbers.size() ? kNumbers[kind] : input.take<double>();
  }

  std::optional<ChildEnd> ending_;
  Exchange without_answer_ = Exchange::done;
  std::vector<double> numbers_;
  std::size_t step_ = 1;
  std::string words_;
  std::span<const std::uint8_t> left_;
  int batch_ = -1;
};

AnyPlugin plugin;

void require_one_line(const std::string& words) {
  if (words.empty() || terminal_text(words) != words) fail("words that move cursors: " + words);
}

/// Runs a call, which the plug-in may leave without an answer.
template <class Call>
void answered(const Call& call) {
  try {
    call();
  } catch (const SamplerFailure& failure) {
    require_one_line(failure.what());
  }
}

void require_place(const TexelSample& sample, Extent extent) {
  const bool is_nowhere = sample.x == -1 && sample.y == -1 && std::isnan(sample.at.s);
  const bool is_in_its_texel = sample.x >= 0 && sample.x < extent.width && sample.y >= 0 &&
                               sample.y < extent.height &&
                               cell_of(sample.at.s, extent.width) == sample.x &&
                               cell_of(sample.at.t, extent.height) == sample.y;
  if (is_nowhere || is_in_its_texel) return;
  fail(fmt::format("a sample in texel ({}, {}) at ({:.17g}, {:.17g})", sample.x, sample.y,
                   sample.at.s, sample.at.t));
}

const EnvironmentMap& chosen_map(std::size_t number) {
  static const std::array maps = {make_synthetic_map("sun-sky", {8, 4}),
                                  make_synthetic_map("gradient", {2, 1}),
                                  make_synthetic_map("checker", {7, 5})};
  return maps[number % maps.size()];
}

void draw(const BoundSampler& sampler, Extent extent, std::size_t count) {
  std::vector<TexelSample> samples(count);
  std::vector<SquarePoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    points[i] = {(static_cast<double>(i) + 0.5) / static_cast<double>(count), 0.25};
  }
  if (sampler.sample) sampler.sample(points, samples);
  if (sampler.sample_in_order) sampler.sample_in_order(7, samples);
  for (const TexelSample& sample : samples) {
    require_place(sample, extent);
    if (sample.x >= 0 && !(sampler.pdf_rounding(sample.at) >= 0.0)) fail("no rounding");
  }
  std::vector<PerSquare> densities(count);
  if (sampler.pdfs) sampler.pdfs(points, densities);
}

void require_time(const PluginTime& time) {
  for (const double nanoseconds : {time.cpu_nanoseconds, time.wall_nanoseconds}) {
    if (!(nanoseconds >= 0.0) || !std::isfinite(nanoseconds)) fail("no time of a sample");
  }
}

}  // namespace
}  // namespace lightproof::fuzz

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  lightproof::fuzz::set_child(lightproof::fuzz::plugin);
  ::setenv("LIGHTPROOF_PLUGIN_HOST", "/proc/self/exe", 1);  // any program that is there
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lightproof;
  using namespace lightproof::fuzz;
  Input input(data, size);
  const EnvironmentMap& map = chosen_map(input.below(3));
  const std::size_t count = 1 + input.below(40);
  const bool is_timed = input.below(4) == 0;
  plugin.set(input);
  PluginOptions options;
  options.limits.memory_bytes = std::uint64_t{1} << 40U;
  std::shared_ptr<const PluginLibrary> library;
  const bool is_taken =
      accepts([&] { library = std::make_shared<const PluginLibrary>("/proc/self/exe", options); });
  if (!is_taken) return 0;
  const auto notes = std::make_shared<PluginNotes>();
  accepts([&] {
    answered([&] { draw(bound_plugin(library, map, notes), map.radiance.extent(), count); });
    if (!is_timed || !library->description().has_sample) return;
    answered([&] {
      const TimedPlugin timed(*library, map);
      require_time(timed.draw(std::vector<SquarePoint>(count, {0.25, 0.75})));
    });
  });
  for (const std::string& note : notes->all()) require_one_line(note);
  return 0;
}
