// Rows of numbers in a file of another program: NumPy's .npy, raw floats, or text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightproof/core/temporary_folder.h"
#include "lightproof/dump/mapped_file.h"

namespace lightproof {

/// How the numbers of a file are coded.
enum class NumberFormat {
  npy,      ///< NumPy's .npy, of `<f4` or `<f8`
  floats,   ///< little-endian floats of 32 bits without a header
  doubles,  ///< little-endian floats of 64 bits without a header
  text,     ///< a row a line: CSV
};

/// A file of samples, opened. Its rows may be read by many threads; of a file of any size no more
/// than some blocks are in memory.
class NumberTable {
 public:
  /// Opens a file; "-" is the standard input, whose bytes are kept in a temporary file. Without a
  /// format it is told by the first bytes (.npy), by the extension in any case (.csv, .txt, .tsv,
  /// .f32, .f64), and else by whether the first bytes are those of a text; what is not is raw
  /// floats. `columns` is how many a row has, where the file does not say: 0 if it must.
  /// Throws InputError if the file cannot be read, is cut off inside a row, holds more than the
  /// rows that it announces, or says otherwise.
  NumberTable(const std::string& file, std::optional<NumberFormat> format, std::size_t columns);

  std::uint64_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  /// Names of columns, if the file has them: as many as columns, or none.
  const std::vector<std::string>& names() const { return names_; }
  /// What rounding has changed of numbers of about 1: 2^-24 of floats, 2^-53 of doubles, half a
  /// unit of the last decimal of text.
  double rounding() const { return rounding_; }

  /// Reads rows first, first + 1, … one after the other: as many as `numbers` holds, whose size is
  /// a multiple of columns().
  void read(std::uint64_t first, std::span<double> numbers) const;

 private:
  void open_text(const std::string& name);
  void open_raw(const std::string& name, std::size_t columns);

  std::unique_ptr<TemporaryFolder> folder_;  ///< of the standard input, or of the numbers of a text
  std::unique_ptr<MappedFile> file_;
  std::size_t first_byte_ = 0;
  std::size_t number_size_ = 4;
  std::uint64_t rows_ = 0;
  std::size_t columns_ = 0;
  std::vector<std::string> names_;
  double rounding_ = 0x1p-24;
};

}  // namespace lightproof
