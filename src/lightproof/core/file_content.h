// A file as the text that it is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace lightproof {

/// All bytes of a file; none if it cannot be read: it is not there, it is a folder, the disk fails.
std::optional<std::string> content_of(const std::filesystem::path& file);

}  // namespace lightproof
