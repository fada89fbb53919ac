#include "lightproof/image/file_format.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "lightproof/core/error.h"
#include "lightproof/core/system_call.h"
#include "lightproof/core/text_escapes.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

constexpr FileFormat kFormats[] = {
    {PictureFormat::openexr, "\x76\x2f\x31\x01", "OpenEXR"},
    {PictureFormat::radiance, "#?", kRadianceFormat},
    {PictureFormat::png, "\x89PNG\r\n\x1a\n", "PNG"},
    {PictureFormat::jpeg, "\xff\xd8\xff", "JPEG"},
};
constexpr std::size_t kLongestMagic = 8;

[[noreturn]] void refuse_error(const fs::path& path, int error) {
  if (error == ENOENT || error == ENOTDIR) refuse(path, "no such file");
  refuse(path, std::generic_category().message(error));
}

}  // namespace

void refuse(const fs::path& file, std::string_view reason) {
  throw InputError(fmt::format("{}: {}", file.string(), terminal_text(reason)));
}

const FileFormat& info(PictureFormat format) {
  return *std::ranges::find(kFormats, format, &FileFormat::format);
}

OpenFile::OpenFile(const fs::path& path) {
  struct stat status = {};
  // Looked at first: opening a pipe would wait for whoever writes to it.
  if (::stat(path.c_str(), &status) != 0) refuse_error(path, errno);
  if (S_ISDIR(status.st_mode)) refuse(path, "is a folder, a picture needed");
  if (!S_ISREG(status.st_mode)) refuse(path, "is not a regular file");
  if (status.st_size == 0) refuse(path, "the file is empty (0 bytes)");
  descriptor_ = uninterrupted(
      [&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY); });
  if (descriptor_ < 0) refuse_error(path, errno);
  size_ = static_cast<std::uint64_t>(status.st_size);
}

OpenFile::~OpenFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

const FileFormat& recognise_file(const fs::path& path, const OpenFile& file) {
  std::string head(kLongestMagic, '\0');
  const ssize_t got =
      uninterrupted([&] { return ::pread(file.descriptor(), head.data(), head.size(), 0); });
  if (got < 0) refuse_error(path, errno);
  head.resize(static_cast<std::size_t>(got));
  for (const FileFormat& format : kFormats) {
    if (head.starts_with(format.magic)) return format;
  }
  refuse(path, "not a picture that is read here: OpenEXR, Radiance .hdr, PNG or JPEG needed");
}

void check_length(const fs::path& file, std::uint64_t bytes, std::uint64_t least_bytes,
                  std::string_view what) {
  if (bytes >= least_bytes) return;
  refuse(file, fmt::format("the file is cut off or its header is damaged: {} take at least {} "
                           "bytes, and the file has {}",
                           what, least_bytes, bytes));
}

}  // namespace lightproof
