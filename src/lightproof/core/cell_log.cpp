#include "lightproof/core/cell_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/file_content.h"
#include "lightproof/core/random.h"
#include "lightproof/core/serialise.h"
#include "lightproof/core/system_call.h"

namespace lightproof {
namespace {

constexpr mode_t kMode = 0666;
/// Of the length and the hash in front of every record.
constexpr std::size_t kHeadBytes = 16;

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
  throw InputError(fmt::format("{}: finished work cannot be kept: {}", file.string(),
                               std::generic_category().message(error)));
}

}  // namespace

CellLog::CellLog(std::filesystem::path file) : path_(std::move(file)) {
  std::size_t whole = 0;
  if (const std::optional<std::string> content = content_of(path_)) whole = read(*content);
  descriptor_ = uninterrupted(
      [&] { return ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kMode); });
  if (descriptor_ < 0) fail(path_, errno);
  if (uninterrupted([&] { return ::ftruncate(descriptor_, static_cast<off_t>(whole)); }) != 0) {
    const int error = errno;
    ::close(descriptor_);
    fail(path_, error);
  }
}

CellLog::~CellLog() { ::close(descriptor_); }

std::size_t CellLog::read(std::string_view content) {
  std::size_t whole = 0;
  try {
    for (;;) {
      ValueReader head(content.substr(whole));
      if (head.is_at_end()) return whole;
      const std::uint64_t bytes = head.number();
      const std::uint64_t hash = head.number();
      const std::string_view rest = content.substr(whole + kHeadBytes);
      if (bytes > rest.size() || hash_text(rest.substr(0, bytes)) != hash) return whole;
      ValueReader record(rest.substr(0, bytes));
      std::string key = record.text();
      records_[std::move(key)] = record.text();
      whole += kHeadBytes + bytes;
    }
  } catch (const std::out_of_range&) {
    return whole;
  }
}

std::optional<std::string> CellLog::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = records_.find(key);
  return found == records_.end() ? std::nullopt : std::optional(found->second);
}

void CellLog::add(const std::string& key, std::string_view bytes) {
  ValueWriter record;
  record.add(std::string_view(key));
  record.add(bytes);
  const std::string content = record.take();
  ValueWriter head;
  head.add(content.size());
  head.add(hash_text(content));
  const std::string whole = head.take() + content;
  const std::lock_guard lock(mutex_);
  std::string_view left = whole;
  while (!left.empty()) {
    const ssize_t written =
        uninterrupted([&] { return ::write(descriptor_, left.data(), left.size()); });
    if (written < 0) fail(path_, errno);
    left.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace lightproof
