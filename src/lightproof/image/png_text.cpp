#include "lightproof/image/png_text.h"

#include <boost/crc.hpp>
#include <cstdint>
#include <string_view>

namespace lightproof {
namespace {

/// The signature, and the chunk IHDR.
constexpr std::size_t kHeaderEnd = 8 + 12 + 13;

std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes += static_cast<char>(number >> shift & 0xffU);
  }
  return bytes;
}

std::string chunk(std::string_view type, std::string_view data) {
  const std::string typed = std::string(type) + std::string(data);
  boost::crc_32_type crc;
  crc.process_bytes(typed.data(), typed.size());
  return big_endian(static_cast<std::uint32_t>(data.size())) + typed + big_endian(crc.checksum());
}

}  // namespace

std::string with_text(std::string png, const Attributes& attributes) {
  std::string chunks;
  for (const Attribute& attribute : attributes) {
    // Keyword, not compressed, no language, no translated keyword, text.
    const std::string head = file_name_of(attribute) + std::string(5, '\0');
    chunks += chunk("iTXt", head + line_of(attribute));
  }
  return png.insert(kHeaderEnd, chunks);
}

}  // namespace lightproof
