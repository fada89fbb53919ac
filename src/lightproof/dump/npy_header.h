// The header of NumPy's .npy files (NumPy Enhancement Proposal 1): a dictionary as Python writes
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace lightproof {

/// What stands in front of the numbers of an .npy file.
struct NpyHeader {
  std::size_t bytes = 0;        ///< of the header, after which the numbers begin
  std::size_t number_size = 4;  ///< bytes of a number: 4 or 8
  std::uint64_t rows = 0;
  std::size_t columns = 1;
};

/// Whether these bytes begin as an .npy file does.
bool is_npy(std::span<const std::byte> bytes);

/// Reads the header of an array of little-endian floats, `<f4` or `<f8`, of one or two dimensions
/// in row-major order. Throws InputError, with the name of the file, for anything else.
NpyHeader read_npy_header(const std::string& file, std::span<const std::byte> bytes);

}  // namespace lightproof
