#include "lightproof/plugin/plugin_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "lightproof/core/companion_program.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/serialise.h"
#include "lightproof/core/text_escapes.h"

namespace lightproof {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kUsualMemory = std::uint64_t{1} << 30U;
constexpr std::uint64_t kMemoryOfTexel = 64;
/// Private memory is measured after every call; what allocations may reach meanwhile is somewhat
/// more, so that a leak is found by measuring it.
constexpr std::uint64_t kHeadroom = std::uint64_t{64} << 20U;
/// What a process may keep of what it is asked for, beside kMemoryOfTexel: its allocator, stacks of
/// its threads, tables of fixed size.
constexpr std::uint64_t kKept = std::uint64_t{16} << 20U;
/// One number kept of every item; allocators hand out no less than two.
constexpr double kLeakOfItem = 8.0;
/// Memory that a call adds beyond this for each of its items is a table that is made once, not a
/// leak: four whole batches that make tables stay within kKept.
constexpr std::uint64_t kMostOfItem = kKept / (4 * kPluginBatch);
constexpr int kCreateBatches = 10;
/// The time for a search for an item that fails alone, in that of a batch.
constexpr int kSearchBatches = 10;
constexpr std::size_t kLongestPrint = 200;
constexpr std::size_t kLongestReason = 1000;

std::filesystem::path host_program() {
  return find_companion(
      {"lightproof-plugin-host", "LIGHTPROOF_PLUGIN_HOST", "the program that runs plug-ins"});
}

std::vector<int> files_of(const SharedMemory& batch, const SharedMemory& log, const Pipe& prints,
                          const SharedMemory* map) {
  std::vector<int> files = {batch.descriptor(), log.descriptor(), prints.read_end(),
                            prints.write_end()};
  if (map != nullptr) files.push_back(map->descriptor());
  return files;
}

std::string megabytes(std::uint64_t bytes) {
  return fmt::format("{:.4g} MB", 1e-6 * static_cast<double>(bytes));
}

std::string seconds_text(milliseconds time) {
  return fmt::format("{:g} s", 1e-3 * static_cast<double>(time.count()));
}

/// What a plug-in chose to say, in one line that every output can hold.
std::string one_line(std::string text, std::size_t longest) {
  text.resize(std::min(text.size(), longest));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  const std::size_t last = text.find_last_not_of(' ');
  text.resize(last == std::string::npos ? 0 : last + 1);
  return terminal_text(text);
}

bool is_time(double seconds) { return std::isfinite(seconds) && seconds >= 0.0; }

/// Whether the program that runs plug-ins could have sent it. A plug-in that got hold of the socket
/// may send anything.
bool is_reply(const PluginReply& reply) {
  return (reply.status == PluginStatus::done || reply.status == PluginStatus::failed) &&
         is_time(reply.cpu_seconds) && is_time(reply.wall_seconds) &&
         reply.text_bytes <= kLongestPluginText;
}

/// What was wrong with a process that nobody asked any more, and that nobody here ended.
std::string words_of_destroy(const ChildEnd& end) {
  if (!end.by_signal) {
    if (end.code == kPluginDestroyed) return "";
    if (end.code == kPluginThrew) return "threw an exception at the end";
    return end.code == kPluginStuck
               ? "did not end within a moment"
               : fmt::format("ended its process with status {} at the end", end.code);
  }
  if (end.code == SIGKILL) return "did not end within a moment";
  if (end.code == SIGSYS) {
    return "started another process or program at the end, which a plug-in may not";
  }
  return fmt::format("crashed at the end (signal {}, {})", end.code, ::strsignal(end.code));
}

std::span<const std::byte> bytes_of(const PluginRequest& request) {
  return std::as_bytes(std::span(&request, 1));
}

}  // namespace

std::uint64_t PluginLimits::memory_for(std::size_t texels) const {
  return memory_bytes > 0 ? memory_bytes : kUsualMemory + kMemoryOfTexel * texels;
}

PluginProcess::PluginProcess(const std::filesystem::path& library, const PluginLimits& limits,
                             const SharedMemory* map)
    : library_(library),
      limits_(limits),
      shared_bytes_(map != nullptr ? map->bytes().size() : 0),
      batch_((kPluginInputs + kPluginOutputs) * sizeof(double)),
      log_(kPluginLogBytes) {
  // A name without a folder would be looked for among the system's libraries.
  const std::filesystem::path whole = std::filesystem::absolute(library);
  child_.emplace(host_program(), std::vector<std::string>{whole.string()},
                 files_of(batch_, log_, prints_, map), limits.batch_time);
  prints_.close_write_end();
}

PluginProcess::~PluginProcess() { end(); }

std::span<double> PluginProcess::inputs() const {
  return {reinterpret_cast<double*>(batch_.bytes().data()), kPluginInputs};
}

std::span<const double> PluginProcess::outputs() const {
  return {reinterpret_cast<const double*>(batch_.bytes().data()) + kPluginInputs, kPluginOutputs};
}

std::string PluginProcess::printed() const {
  const std::span<std::byte> bytes = log_.bytes();
  const auto end = std::ranges::find(bytes, std::byte{0});
  // What a process printed last, it may have left in the pipe; here it is asked for more than once.
  const std::string rest = prints_.take(static_cast<std::size_t>(bytes.end() - end));
  std::ranges::copy(std::as_bytes(std::span(rest)), end);
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  text.resize(std::min(text.find('\0'), text.size()));
  return one_line(std::move(text), kLongestPrint);
}

void PluginProcess::end_group() {
  // It has not been waited for: the number is still its own.
  is_killed_ = true;
  if (child_->id() > 0) ::kill(-child_->id(), SIGKILL);
}

std::string PluginProcess::words_of_end() {
  end_group();
  const std::optional<ChildEnd> end = child_->end();
  throw_if_interrupted();  // a Ctrl-C reaches both
  if (!end) return "ended, nobody knows how";
  const std::uint64_t most = allowed_bytes_ + shared_bytes_;
  const std::string all_of_it =
      allowed_bytes_ > 0 && end->peak_bytes > most - most / 8
          ? fmt::format(", having taken all of the {} that it may", megabytes(allowed_bytes_))
          : "";
  if (!end->by_signal) {
    return fmt::format("ended its process with status {}{}", end->code, all_of_it);
  }
  if (end->code == SIGSYS) return "started another process or program, which a plug-in may not";
  if (end->code == SIGKILL) {
    return fmt::format("was killed (signal 9), as systems without memory do{}", all_of_it);
  }
  return fmt::format("crashed (signal {}, {}){}", end->code, ::strsignal(end->code), all_of_it);
}

std::string PluginProcess::words_of(Exchange exchange, milliseconds patience) {
  std::string words;
  if (exchange == Exchange::silent) {
    end_group();
    child_->end();
    words = fmt::format("took longer than {}", seconds_text(patience));
  } else {
    words = words_of_end();
  }
  const std::string print = printed();
  return print.empty() ? words : fmt::format("{}; it printed: {}", words, print);
}

PluginAnswer PluginProcess::ask(const PluginRequest& request, milliseconds patience,
                                std::string* text) {
  PluginAnswer answer;
  child_->set_patience(patience);
  const auto went = [&](Exchange exchange) {
    if (exchange == Exchange::done) return true;
    answer.failure = words_of(exchange, patience);
    return false;
  };
  if (!went(child_->send(bytes_of(request)))) return answer;
  const auto deadline = Clock::now() + kSearchBatches * patience;
  if (request.one_by_one != 0) {
    for (; answer.items_done < request.count; ++answer.items_done) {
      if (Clock::now() > deadline) return answer;
      auto item = PluginItem::failed;
      if (!went(child_->receive(std::as_writable_bytes(std::span(&item, 1))))) return answer;
      if (item != PluginItem::done) break;
    }
  }
  PluginReply reply;
  if (!went(child_->receive(std::as_writable_bytes(std::span(&reply, 1))))) return answer;
  if (!is_reply(reply)) {
    answer.failure = "sent to the socket of its process what is no reply";
    end_group();
    return answer;
  }
  std::string words(reply.text_bytes, '\0');
  if (!went(child_->receive(std::as_writable_bytes(std::span(words))))) return answer;
  answer.cpu_seconds = reply.cpu_seconds;
  answer.wall_seconds = reply.wall_seconds;
  answer.held_bytes = reply.held_bytes;
  if (reply.status != PluginStatus::done) {
    words = one_line(std::move(words), kLongestReason);
    answer.failure = words.empty() ? "failed without a reason" : words;
    end_group();
  } else if (text != nullptr) {
    *text = std::move(words);
  }
  return answer;
}

PluginDescription PluginProcess::describe() {
  PluginRequest request;
  request.call = PluginCall::describe;
  request.memory_bytes = limits_.memory_for(0) + kHeadroom;
  allowed_bytes_ = limits_.memory_for(0);
  std::string text;
  const PluginAnswer answer = ask(request, kCreateBatches * limits_.batch_time, &text);
  if (!answer.is_done()) {
    throw InputError(fmt::format("{}: the plug-in {}", library_.string(), answer.failure));
  }
  try {
    return ValueReader(text).value<PluginDescription>();
  } catch (const std::out_of_range&) {
    throw InputError(
        fmt::format("{}: the plug-in sent to the socket of its process what is no description",
                    library_.string()));
  }
}

PluginAnswer PluginProcess::create(PluginRequest request, std::size_t texels) {
  request.call = PluginCall::create;
  allowed_bytes_ = limits_.memory_for(texels);
  request.memory_bytes = allowed_bytes_ + allowed_bytes_ / 4 + kHeadroom;
  PluginAnswer answer = ask(request, kCreateBatches * limits_.batch_time);
  held_at_first_ = held_before_ = answer.held_bytes;
  if (limits_.memory_bytes == 0) may_keep_ = kKept + kMemoryOfTexel * texels;
  judge_memory(answer);
  return answer;
}

PluginAnswer PluginProcess::call(const PluginRequest& request) {
  PluginAnswer answer = ask(request, limits_.batch_time);
  items_ += request.count;
  if (answer.is_done()) {
    // A process that gives memory back is not nearer to a leak when it takes it again.
    kept_ = answer.held_bytes > held_before_
                ? kept_ + std::min(answer.held_bytes - held_before_, kMostOfItem * request.count)
                : kept_ - std::min(held_before_ - answer.held_bytes, kept_);
    held_before_ = answer.held_bytes;
  }
  judge_memory(answer);
  return answer;
}

bool PluginProcess::leaks(std::uint64_t held_bytes) const {
  if (may_keep_ == 0 || held_bytes <= held_at_first_) return false;
  const std::uint64_t kept = std::min(kept_, held_bytes - held_at_first_);
  return kept > may_keep_ && static_cast<double>(kept) > kLeakOfItem * static_cast<double>(items_);
}

void PluginProcess::judge_memory(PluginAnswer& answer) const {
  if (!answer.is_done()) return;
  const bool is_leak = leaks(answer.held_bytes);
  if (!is_leak && answer.held_bytes <= allowed_bytes_) return;
  answer.is_over_memory = true;
  answer.failure =
      is_leak ? fmt::format("holds {} of memory, and ever more", megabytes(answer.held_bytes))
              : fmt::format("holds {} of memory, and may hold {}", megabytes(answer.held_bytes),
                            megabytes(allowed_bytes_));
  if (items_ == 0 || answer.held_bytes <= held_at_first_) return;
  const std::uint64_t more = answer.held_bytes - held_at_first_;
  answer.failure += fmt::format(": {} more than after create(), {} bytes for each of {} items",
                                megabytes(more), more / items_, items_);
  if (is_leak) answer.failure += " (what it needs to keep is allowed by --plugin-memory)";
}

std::string PluginProcess::end() {
  if (!child_) return "";
  if (child_->id() <= 0) return "";
  const std::optional<ChildEnd> end = child_->end();
  if (!end || is_killed_) return "";
  return words_of_destroy(*end);
}

}  // namespace lightproof
