#include "lightproof/dump/number_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstring>

#include "lightproof/core/error.h"
#include "lightproof/dump/npy_header.h"
#include "lightproof/dump/text_numbers.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kStandardInput = "-";
/// The number of bytes at the start of a file that tell a text from raw numbers.
constexpr std::size_t kTold = std::size_t{1} << 16U;

/// Copies the standard input to a file.
void keep_standard_input(const fs::path& file) {
  std::FILE* const out = std::fopen(file.c_str(), "wb");
  bool is_written = out != nullptr;
  std::vector<char> buffer(std::size_t{1} << 20U);
  for (std::size_t count;
       is_written && (count = std::fread(buffer.data(), 1, buffer.size(), stdin)) > 0;) {
    is_written = std::fwrite(buffer.data(), 1, count, out) == count;
  }
  is_written = out != nullptr && std::fclose(out) == 0 && is_written;
  if (!is_written) {
    throw InputError(fmt::format(
        "{}: cannot be written: the standard input is kept there; TMPDIR names another folder",
        file.string()));
  }
  if (std::ferror(stdin) != 0) throw InputError("the standard input cannot be read");
}

/// Whether bytes are printable ASCII and white space, which numbers of 32 bits that are no letters
/// by chance are not.
bool is_text(std::span<const std::byte> bytes) {
  return std::ranges::all_of(bytes.first(std::min(bytes.size(), kTold)), [](std::byte byte) {
    const auto c = std::to_integer<unsigned char>(byte);
    return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r');
  });
}

NumberFormat format_of(const std::string& file, std::span<const std::byte> bytes) {
  if (is_npy(bytes)) return NumberFormat::npy;
  std::string extension = fs::path(file).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".csv" || extension == ".txt" || extension == ".tsv") return NumberFormat::text;
  if (extension == ".f64") return NumberFormat::doubles;
  if (extension == ".f32") return NumberFormat::floats;
  return is_text(bytes) ? NumberFormat::text : NumberFormat::floats;
}

template <class Number>
void copy_numbers(std::span<const std::byte> bytes, std::span<double> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    Number number;
    std::memcpy(&number, bytes.data() + i * sizeof(Number), sizeof(Number));
    numbers[i] = static_cast<double>(number);
  }
}

}  // namespace

NumberTable::NumberTable(const std::string& file, std::optional<NumberFormat> format,
                         std::size_t columns) {
  std::string name = file;
  if (file == kStandardInput) {
    name = "the standard input";
    folder_ = std::make_unique<TemporaryFolder>();
    keep_standard_input(*folder_ / "samples");
    file_ = std::make_unique<MappedFile>(*folder_ / "samples");
  } else {
    file_ = std::make_unique<MappedFile>(file);
  }
  if (file_->bytes().empty()) throw InputError(name + ": is empty");
  switch (format.value_or(format_of(file, file_->bytes()))) {
    case NumberFormat::npy: {
      if (!is_npy(file_->bytes())) throw InputError(name + ": does not begin as an .npy file does");
      const NpyHeader header = read_npy_header(name, file_->bytes());
      first_byte_ = header.bytes;
      number_size_ = header.number_size;
      rows_ = header.rows;
      if (number_size_ == sizeof(double)) rounding_ = 0x1p-53;
      columns_ = header.columns;
      break;
    }
    case NumberFormat::floats:
      open_raw(name, columns);
      break;
    case NumberFormat::doubles:
      number_size_ = sizeof(double);
      rounding_ = 0x1p-53;
      open_raw(name, columns);
      break;
    case NumberFormat::text:
      open_text(name);
      break;
  }
  // Of a text the columns are those of its rows.
  if (rows_ == 0) throw InputError(name + ": has no rows");
  if (columns != 0 && columns != columns_) {
    throw InputError(
        fmt::format("{}: its rows have {} numbers, --columns names {}", name, columns_, columns));
  }
  const std::uint64_t left = file_->bytes().size() - first_byte_;
  const std::uint64_t row_bytes = columns_ * number_size_;
  if (rows_ > left / row_bytes) {
    throw InputError(
        fmt::format("{}: is cut off: {} rows of {} numbers are announced, it ends in "
                    "row {} (counted from 0)",
                    name, rows_, columns_, left / row_bytes));
  }
  if (const std::uint64_t behind = left - rows_ * row_bytes; behind != 0) {
    throw InputError(
        fmt::format("{}: {} rows of {} numbers are announced, and {} bytes lie behind the last one "
                    "(a second array?): a file holds the samples of one array, as numpy.save "
                    "writes it",
                    name, rows_, columns_, behind));
  }
}

void NumberTable::open_raw(const std::string& name, std::size_t columns) {
  if (columns == 0) {
    throw InputError(name +
                     ": raw numbers do not say how many make a row: those of samples are named by "
                     "--columns, as in --columns x,y,z,pdf; densities are taken from an .npy file, "
                     "a text (.csv) or a picture");
  }
  columns_ = columns;
  const std::uint64_t row_bytes = columns_ * number_size_;
  rows_ = file_->bytes().size() / row_bytes;
  const std::uint64_t rest = file_->bytes().size() % row_bytes;
  if (rest == 0) return;
  throw InputError(
      fmt::format("{}: ends inside row {} (counted from 0): {} bytes are no whole rows "
                  "of {} numbers of {} bytes",
                  name, rows_, file_->bytes().size(), columns_, number_size_));
}

void NumberTable::open_text(const std::string& name) {
  if (!folder_) folder_ = std::make_unique<TemporaryFolder>();
  const fs::path numbers = *folder_ / "numbers";
  const TextTable table = write_numbers(name, file_->bytes(), numbers);
  names_ = table.names;
  columns_ = table.columns;
  rows_ = table.rows;
  number_size_ = sizeof(double);
  rounding_ = table.rounding;
  if (rows_ > 0) file_ = std::make_unique<MappedFile>(numbers);
}

void NumberTable::read(std::uint64_t first, std::span<double> numbers) const {
  const std::size_t begin = first_byte_ + static_cast<std::size_t>(first) * columns_ * number_size_;
  const auto bytes = file_->bytes().subspan(begin, numbers.size() * number_size_);
  if (number_size_ == sizeof(float)) {
    copy_numbers<float>(bytes, numbers);
  } else {
    copy_numbers<double>(bytes, numbers);
  }
  file_->forget(begin, bytes.size());
}

}  // namespace lightproof
