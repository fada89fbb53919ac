// Numbers in text, a row a line: CSV, or separated by spaces or semicolons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lightproof {

/// A table that was text.
struct TextTable {
  std::vector<std::string> names;  ///< of columns, from a first line of words; empty without one
  std::size_t columns = 0;
  std::uint64_t rows = 0;
  /// Half a unit of the last decimal of the most exact number: what rounding numbers of about 1 to
  /// text has changed.
  double rounding = 0.5;
};

/// Reads the numbers of a text and writes them, as doubles row by row, to a file. Lines that are
/// empty or begin with '#' are skipped. `name` is what messages call the text. Throws InputError,
/// with the line, for what is no number and for lines of another length.
TextTable write_numbers(const std::string& name, std::span<const std::byte> text,
                        const std::filesystem::path& numbers);

}  // namespace lightproof
