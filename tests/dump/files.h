// Files of numbers as other programs write them.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace lightproof::test {

inline void write_bytes(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/// The header that numpy.save writes: the dictionary is filled up to a multiple of 64 bytes.
inline std::string npy_header(std::string_view type, std::string_view shape,
                              std::string_view fortran_order = "False") {
  std::ostringstream dictionary;
  dictionary << "{'descr': '" << type << "', 'fortran_order': " << fortran_order
             << ", 'shape': " << shape << ", }";
  constexpr std::size_t kBefore = 10;
  const std::size_t length = dictionary.str().size() + 1;
  const std::size_t filled = (kBefore + length + 63) / 64 * 64 - kBefore;
  dictionary << std::string(filled - length, ' ') << '\n';
  std::ostringstream header;
  header << "\x93NUMPY\x01" << '\0' << static_cast<char>(filled & 0xffU)
         << static_cast<char>(filled >> 8U) << dictionary.str();
  return header.str();
}

}  // namespace lightproof::test
