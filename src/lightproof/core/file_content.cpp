#include "lightproof/core/file_content.h"

#include <fstream>
#include <ios>
#include <iterator>

namespace lightproof {

std::optional<std::string> content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  try {
    return std::string{std::istreambuf_iterator<char>(in), {}};
  } catch (const std::ios_base::failure&) {  // whatever the state of the stream asks for
    return std::nullopt;
  }
}

}  // namespace lightproof
