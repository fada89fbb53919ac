#include "lightproof/core/kept_file.h"

#include <fmt/format.h>

#include <exception>
#include <stdexcept>

#include "lightproof/core/atomic_file.h"
#include "lightproof/core/file_content.h"
#include "lightproof/core/random.h"
#include "lightproof/core/serialise.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMark = "lightproof kept file 1";

}  // namespace

fs::path path_of(const KeptFile& file) {
  return file.folder / fmt::format("{}-{:016x}.bin", file.name, hash_text(file.identity));
}

std::optional<std::string> read_kept(const KeptFile& file) {
  if (file.folder.empty()) return std::nullopt;
  const std::optional<std::string> bytes = content_of(path_of(file));
  if (!bytes) return std::nullopt;
  try {
    ValueReader reader(*bytes);
    if (reader.text() != kMark || reader.text() != file.identity) return std::nullopt;
    const std::uint64_t hash = reader.number();
    std::string content = reader.text();
    const bool is_whole = reader.is_at_end() && hash == hash_text(content);
    return is_whole ? std::optional(std::move(content)) : std::nullopt;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

void write_kept(const KeptFile& file, std::string_view content) {
  ValueWriter writer;
  writer.add(kMark);
  writer.add(std::string_view(file.identity));
  writer.add(hash_text(content));
  writer.add(content);
  write_file(path_of(file), writer.take());
}

bool keep(const KeptFile& file, std::string_view content) {
  if (file.folder.empty()) return false;
  try {
    fs::create_directories(file.folder);
    write_kept(file, content);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

std::optional<std::uint64_t> hash_of_file(const fs::path& file) {
  const std::optional<std::string> content = content_of(file);
  return content ? std::optional(hash_text(*content)) : std::nullopt;
}

}  // namespace lightproof
