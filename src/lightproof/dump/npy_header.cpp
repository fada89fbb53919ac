#include "lightproof/dump/npy_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/text_escapes.h"

namespace lightproof {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kVersionEnd = 8;
constexpr std::size_t kShownCharacters = 40;

[[noreturn]] void refuse_header(const std::string& file, std::string_view reason) {
  throw InputError(fmt::format("{}: {}", file, reason));
}

/// What stands behind 'key': in the dictionary, up to its end.
std::optional<std::string_view> value_of(std::string_view dictionary, std::string_view key) {
  for (const char quote : {'\'', '"'}) {
    const std::string quoted = fmt::format("{}{}{}", quote, key, quote);
    const std::size_t at = dictionary.find(quoted);
    if (at == std::string_view::npos) continue;
    std::string_view rest = dictionary.substr(at + quoted.size());
    const std::size_t begin = rest.find_first_not_of(" :");
    return begin == std::string_view::npos ? std::string_view() : rest.substr(begin);
  }
  return std::nullopt;
}

std::string_view quoted_text(std::string_view value) {
  if (value.empty() || (value.front() != '\'' && value.front() != '"')) return {};
  const std::size_t end = value.find(value.front(), 1);
  return end == std::string_view::npos ? std::string_view() : value.substr(1, end - 1);
}

/// The numbers of a tuple, "(1000, 4)"; none if it is not one.
std::optional<std::vector<std::uint64_t>> tuple_of(std::string_view value) {
  const std::size_t end = value.find(')');
  if (value.empty() || value.front() != '(' || end == std::string_view::npos) return std::nullopt;
  std::vector<std::uint64_t> numbers;
  std::string_view rest = value.substr(1, end - 1);
  while (true) {
    const std::size_t begin = rest.find_first_not_of(" ,");
    if (begin == std::string_view::npos) return numbers;
    rest.remove_prefix(begin);
    std::uint64_t number = 0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error != std::errc()) return std::nullopt;
    numbers.push_back(number);
    rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
  }
}

std::uint32_t little_endian(std::span<const std::byte> bytes) {
  std::uint32_t number = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    number = number << 8U | std::to_integer<std::uint32_t>(bytes[i]);
  }
  return number;
}

/// Where the dictionary lies.
std::string_view dictionary_of(const std::string& file, std::span<const std::byte> bytes) {
  if (bytes.size() < 12) refuse_header(file, "ends inside the header of an .npy file");
  const auto version = std::to_integer<int>(bytes[6]);
  if (version < 1 || version > 3) {
    refuse_header(file,
                  fmt::format("is an .npy file of version {}: 1, 2 and 3 are known", version));
  }
  const std::size_t digits = version == 1 ? 2 : 4;
  const std::size_t length = little_endian(bytes.subspan(kVersionEnd, digits));
  const std::size_t begin = kVersionEnd + digits;
  if (length > bytes.size() - begin) refuse_header(file, "ends inside the header of an .npy file");
  return {reinterpret_cast<const char*>(bytes.data()) + begin, length};
}

}  // namespace

bool is_npy(std::span<const std::byte> bytes) {
  return bytes.size() >= kMagic.size() &&
         std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

NpyHeader read_npy_header(const std::string& file, std::span<const std::byte> bytes) {
  const std::string_view dictionary = dictionary_of(file, bytes);
  NpyHeader header;
  header.bytes = static_cast<std::size_t>(dictionary.data() + dictionary.size() -
                                          reinterpret_cast<const char*>(bytes.data()));
  const auto type = value_of(dictionary, "descr");
  const std::string_view name = type ? quoted_text(*type) : std::string_view();
  if (name != "<f4" && name != "<f8") {
    refuse_header(file,
                  fmt::format("holds numbers of NumPy's type {}: little-endian floats, <f4 or "
                              "<f8, are needed; numpy.asarray(samples, '<f4') makes them",
                              name.empty() ? "that is not named"
                                           : terminal_text(name.substr(0, kShownCharacters))));
  }
  header.number_size = name == "<f4" ? 4 : 8;
  const auto order = value_of(dictionary, "fortran_order");
  if (!order || !order->starts_with("False")) {
    refuse_header(file,
                  "lies column by column (fortran_order): numpy.ascontiguousarray(samples) "
                  "lies row by row");
  }
  const auto shape = value_of(dictionary, "shape");
  const auto sides = shape ? tuple_of(*shape) : std::nullopt;
  if (!sides || sides->empty() || sides->size() > 2) {
    refuse_header(file, "has not the shape of a table, (rows, columns)");
  }
  header.rows = sides->front();
  const std::uint64_t columns = sides->size() == 2 ? sides->back() : 1;
  if (columns < 1 || columns > 64) {
    refuse_header(file, fmt::format("has {} columns: 1 to 64 are taken", columns));
  }
  header.columns = static_cast<std::size_t>(columns);
  return header;
}

}  // namespace lightproof
