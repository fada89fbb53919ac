#include "lightproof/core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/system_call.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, int error) {
  throw InputError(
      fmt::format("{}: cannot write: {}", path.string(), std::generic_category().message(error)));
}

/// Some file systems report a full disk only here.
void flush_to_disk(const fs::path& path) {
  const int file = uninterrupted([&] { return ::open(path.c_str(), O_WRONLY | O_CLOEXEC); });
  if (file < 0) fail(path, errno);
  const int flushed = uninterrupted([&] { return ::fsync(file); });
  const int error = errno;
  const int closed = ::close(file);
  if (flushed != 0 && error != EINVAL && error != EROFS) fail(path, error);
  if (closed != 0 && errno != EINTR) fail(path, errno);
}

/// Where links lead to; the path itself if it is none or leads nowhere.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

/// A pipe, device or socket: nothing that could be replaced by renaming.
bool is_stream(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// Writes to `path`; errors name `target`.
void write_bytes(const fs::path& path, const fs::path& target, std::string_view content) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) fail(target, errno != 0 ? errno : EIO);
}

}  // namespace

bool is_part(std::string_view name) {
  const std::size_t mark = name.rfind(".part");
  if (!name.starts_with('.') || mark == std::string_view::npos) return false;
  const std::string_view extension = name.substr(mark + std::string_view(".part").size());
  if (!extension.empty() && extension.front() != '.') return false;
  const std::string_view before = name.substr(0, mark);
  const std::string_view process = before.substr(before.rfind('.') + 1);
  return !process.empty() && process.find_first_not_of("0123456789") == std::string_view::npos;
}

fs::path part_of(const fs::path& target) {
  return target.parent_path() / fmt::format(".{}.{}.part{}", target.stem().string(), ::getpid(),
                                            target.extension().string());
}

void remove_abandoned_parts(const fs::path& folder) {
  std::vector<fs::path> parts;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_part(entry->path().filename().string())) parts.push_back(entry->path());
  }
  for (const fs::path& part : parts) fs::remove_all(part, error);
}

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  temporary_ = part_of(target_);
  errno = 0;
  std::ofstream probe(temporary_, std::ios::binary);
  probe.close();
  if (!probe) fail(target_, errno != 0 ? errno : EIO);
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  flush_to_disk(temporary_);
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(target_, error.value());
  committed_ = true;
}

AtomicFolder::AtomicFolder(fs::path target) : target_(std::move(target)) {
  std::error_code error;
  fs::create_directories(target_, error);
  if (error) {
    throw InputError(
        fmt::format("{}: cannot create the folder: {}", target_.string(), error.message()));
  }
  lock_ = FolderLock(target_);
  if (lock_.holds()) remove_abandoned_parts(target_);
  temporary_ = target_ / fmt::format(".{}.part", ::getpid());
  fs::create_directory(temporary_, error);
  if (error) fail(target_, error.value());
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void AtomicFolder::commit() {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(temporary_, error), end; !error && entry != end;
       entry.increment(error)) {
    files.push_back(entry->path());
  }
  if (error) fail(target_, error.value());
  for (const fs::path& file : files) {
    fs::rename(file, target_ / file.filename(), error);
    if (error) fail(target_ / file.filename(), error.value());
  }
}

void write_file(const fs::path& path, std::string_view content) {
  const fs::path target = resolved(path);
  if (is_stream(target)) return write_bytes(target, target, content);
  AtomicFile pending(target);
  write_bytes(pending.temporary(), target, content);
  pending.commit();
}

void check_writable(const fs::path& path) {
  const fs::path target = resolved(path);
  std::error_code error;  // of what cannot be looked at, writing it will say why
  if (fs::is_directory(target, error)) fail(target, EISDIR);
  if (!is_stream(target)) const AtomicFile probe(target);
}

}  // namespace lightproof
