// What took long to find out, kept in a file until anything that it depends on changes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace lightproof {

/// The place of something that is kept.
struct KeptFile {
  std::filesystem::path folder;  ///< empty: nothing is kept
  std::string name;              ///< of its kind, with which the file's name begins: "self-test"
  std::string identity;          ///< all that it depends on; another identity has another file
};

/// What is kept under this name and identity; none if it is not there, damaged, or not what keep()
/// wrote.
std::optional<std::string> read_kept(const KeptFile& file);

/// Where it is kept: "folder/self-test-0123456789abcdef.bin".
std::filesystem::path path_of(const KeptFile& file);

/// Keeps this content in place of what was there, in a folder that is there. Throws InputError if
/// it cannot.
void write_kept(const KeptFile& file, std::string_view content);

/// Keeps this content in place of what was there. Returns whether it could: a folder that cannot be
/// written to is no reason to lose what was found out.
bool keep(const KeptFile& file, std::string_view content);

/// Tells programs and other files apart by their content; none if the file cannot be read.
std::optional<std::uint64_t> hash_of_file(const std::filesystem::path& file);

}  // namespace lightproof
