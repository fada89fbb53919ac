#include "lightproof/dump/text_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/text_escapes.h"

namespace lightproof {
namespace {

/// Rows from which it is taken how exact numbers are.
constexpr std::uint64_t kRowsForRounding = 1000;
/// More than a double has.
constexpr std::int64_t kMostDecimals = 1000;
constexpr std::size_t kBuffered = std::size_t{1} << 16U;

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Numbers on their way to a file.
class NumberWriter {
 public:
  explicit NumberWriter(const std::filesystem::path& file)
      : name_(file.string()), file_(std::fopen(file.c_str(), "wb")) {
    if (!file_) fail();
    buffer_.reserve(kBuffered);
  }

  void add(double number) {
    buffer_.push_back(number);
    if (buffer_.size() == kBuffered) flush();
  }

  void finish() {
    flush();
    if (std::fflush(file_.get()) != 0) fail();
  }

 private:
  void flush() {
    if (std::fwrite(buffer_.data(), sizeof(double), buffer_.size(), file_.get()) !=
        buffer_.size()) {
      fail();
    }
    buffer_.clear();
  }
  [[noreturn]] void fail() const {
    throw InputError(
        fmt::format("{}: cannot be written: the numbers of a text are kept there while it is read; "
                    "TMPDIR names "
                    "another folder",
                    name_));
  }

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<double> buffer_;
};

constexpr std::string_view kBetween = " \t\r,;";

/// The next word of a line, which is taken off it; empty at its end.
std::string_view take_word(std::string_view& line) {
  const std::size_t begin = line.find_first_not_of(kBetween);
  if (begin == std::string_view::npos) return line = {};
  line.remove_prefix(begin);
  const std::string_view word = line.substr(0, line.find_first_of(kBetween));
  line.remove_prefix(word.size());
  return word;
}

bool parse(std::string_view word, double& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (end != word.data() + word.size()) return false;
  if (error != std::errc::result_out_of_range) return error == std::errc();
  // What is too large or too small for a double is an infinity or a zero, which is judged later;
  // from_chars leaves the number as it was.
  number = std::strtod(std::string(word).c_str(), nullptr);
  return true;
}

/// How many places after the decimal point the last digit of a number stands: 3 of "0.125", 8 of
/// "1.5e-7", 0 of "12".
int decimals_of(std::string_view word) {
  const std::size_t exponent_at = word.find_first_of("eE");
  const std::string_view mantissa = word.substr(0, exponent_at);
  std::int64_t exponent = 0;
  if (exponent_at != std::string_view::npos) {
    const char* begin = word.data() + exponent_at + 1;
    if (begin != word.data() + word.size() && *begin == '+') ++begin;
    std::from_chars(begin, word.data() + word.size(), exponent);
  }
  const std::size_t point = mantissa.find('.');
  const std::size_t after = point == std::string_view::npos ? 0 : mantissa.size() - point - 1;
  // Nobody asks for more than some, and a text may say any number.
  exponent = std::clamp<std::int64_t>(exponent, -kMostDecimals, kMostDecimals);
  const auto decimals = static_cast<std::int64_t>(std::min<std::size_t>(after, kMostDecimals));
  return static_cast<int>(std::clamp<std::int64_t>(decimals - exponent, 0, kMostDecimals));
}

std::string unquoted(std::string_view word) {
  if (word.size() >= 2 && word.front() == '"' && word.back() == '"') {
    word = word.substr(1, word.size() - 2);
  }
  return std::string(word);
}

/// The names of a first line of words; empty if it is one of numbers.
std::vector<std::string> names_in(std::string_view line) {
  std::vector<std::string> names;
  bool are_numbers = true;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
    double number = 0.0;
    are_numbers = are_numbers && parse(word, number);
    names.push_back(unquoted(word));
  }
  return are_numbers ? std::vector<std::string>() : names;
}

}  // namespace

TextTable write_numbers(const std::string& name, std::span<const std::byte> bytes,
                        const std::filesystem::path& numbers) {
  NumberWriter writer(numbers);
  TextTable table;
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  bool is_first = true;
  int decimals = 0;
  for (std::uint64_t line_number = 1; !text.empty(); ++line_number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t begin = line.find_first_not_of(kBetween);
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    if (std::exchange(is_first, false)) {
      table.names = names_in(line);
      if (!table.names.empty()) {
        table.columns = table.names.size();
        continue;
      }
    }
    std::size_t columns = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      double number = 0.0;
      if (!parse(word, number)) {
        throw InputError(fmt::format("{}: line {}: \"{}\" is no number", name, line_number,
                                     terminal_text(word.substr(0, 40))));
      }
      writer.add(number);
      if (table.rows < kRowsForRounding) decimals = std::max(decimals, decimals_of(word));
      ++columns;
    }
    if (table.columns == 0) table.columns = columns;
    if (columns != table.columns) {
      throw InputError(fmt::format("{}: line {} has {} numbers, those before it {}", name,
                                   line_number, columns, table.columns));
    }
    ++table.rows;
  }
  writer.finish();
  table.rounding = 0.5 * std::pow(10.0, -std::min(decimals, 16));
  return table;
}

}  // namespace lightproof
