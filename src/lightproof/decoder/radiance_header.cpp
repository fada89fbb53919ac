#include "lightproof/decoder/radiance_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "lightproof/decoder/refusal.h"

namespace lightproof {
namespace {

/// A header that goes on for longer is taken for damaged.
constexpr std::uint64_t kLongestHeader = std::uint64_t{1} << 24U;
constexpr std::string_view kName = "Radiance .hdr";
constexpr std::size_t kShownCharacters = 60;
/// Exposures and aspects are products of rounded decimal numbers.
constexpr double kRounding = 1e-6;

/// The line as it is shown in a message, which has one line itself.
std::string shown(std::string_view line) {
  std::string text(line.substr(0, kShownCharacters));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return line.size() > kShownCharacters ? text + "…" : text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

template <class Number>
std::optional<Number> number_in(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

/// Exactly so many finite numbers between blanks; none if there are more, fewer or others.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> numbers_in(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() != kCount) return std::nullopt;
  std::array<double, kCount> numbers{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::optional<double> number = number_in<double>(words[i]);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

/// The next line without its end, LF or CR LF; none if the file ends first.
std::optional<std::string> next_line(ByteReader& bytes) {
  std::string line;
  while (const std::optional<std::uint8_t> byte = bytes.next()) {
    if (*byte == '\n') {
      if (line.ends_with('\r')) line.pop_back();
      return line;
    }
    if (bytes.position() > kLongestHeader) {
      refuse(
          fmt::format("cannot be read as {}: the header does not end within {} "
                      "bytes",
                      kName, kLongestHeader));
    }
    line.push_back(static_cast<char>(*byte));
  }
  return std::nullopt;
}

std::string next_line(ByteReader& bytes, std::string_view missing) {
  if (std::optional<std::string> line = next_line(bytes)) return *std::move(line);
  refuse(fmt::format("cannot be read as {}: the file ends at byte {}, before {}", kName,
                     bytes.size(), missing));
}

void read_format(RadianceHeader& header, std::string_view format) {
  header.says_format = true;
  header.holds_xyz = format == "32-bit_rle_xyze";
  if (header.holds_xyz || format == "32-bit_rle_rgbe") return;
  refuse(
      fmt::format("cannot be read as {}: the header says FORMAT={}, and 32-bit_rle_rgbe and "
                  "32-bit_rle_xyze are read",
                  kName, shown(format)));
}

/// Multiplies by a positive factor, or returns false.
bool multiply(double& product, std::string_view text) {
  const auto factor = numbers_in<1>(text);
  if (!factor || (*factor)[0] <= 0.0) return false;
  product *= (*factor)[0];
  return true;
}

bool read_colour_correction(std::array<double, 3>& product, std::string_view text) {
  const auto factors = numbers_in<3>(text);
  if (!factors) return false;
  for (std::size_t i = 0; i < 3; ++i) product[i] *= (*factors)[i];
  return true;
}

bool read_primaries(std::optional<Chromaticities>& primaries, std::string_view text) {
  const auto xy = numbers_in<8>(text);
  if (!xy) return false;
  const auto& v = *xy;
  primaries = {{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}};
  return is_colour_space(*primaries);
}

bool read_gamma(double& gamma, std::string_view text) {
  const auto value = numbers_in<1>(text);
  if (value) gamma = (*value)[0];
  return value.has_value();
}

/// False if the line has a name that matters and a value that cannot be read.
bool read_variable(RadianceHeader& header, std::string_view name, std::string_view value) {
  if (name == "EXPOSURE") return multiply(header.exposure, value);
  if (name == "PIXASPECT") return multiply(header.pixel_aspect, value);
  if (name == "COLORCORR") return read_colour_correction(header.colour_correction, value);
  if (name == "PRIMARIES") return read_primaries(header.primaries, value);
  if (name == "GAMMA") return read_gamma(header.gamma, value);
  if (name == "VIEW") header.has_view = true;
  return true;
}

void read_line(RadianceHeader& header, std::string_view line) {
  const std::size_t equals = line.find('=');
  const bool is_copy = line.starts_with(' ') || line.starts_with('\t');
  if (equals == std::string_view::npos || is_copy || line.starts_with('#')) return;
  const std::string_view name = trimmed(line.substr(0, equals));
  const std::string_view value = trimmed(line.substr(equals + 1));
  if (name == "FORMAT") {
    read_format(header, value);
  } else if (!read_variable(header, name, value)) {
    header.unreadable.push_back(shown(line));
  }
}

/// "-Y" or "+X" and a number of pixels.
struct Axis {
  bool is_x = false;
  bool grows = false;
  std::int64_t length = 0;
};

std::optional<Axis> axis_of(std::string_view name, std::string_view length) {
  if (name != "-X" && name != "+X" && name != "-Y" && name != "+Y") return std::nullopt;
  const std::optional<std::int64_t> number = number_in<std::int64_t>(length);
  if (!number || length.starts_with('+')) return std::nullopt;
  return Axis{name[1] == 'X', name[0] == '+', *number};
}

RadianceResolution resolution_of(std::string_view line) {
  const std::vector<std::string_view> words = words_of(line);
  std::optional<Axis> slow;
  std::optional<Axis> fast;
  if (words.size() == 4) {
    slow = axis_of(words[0], words[1]);
    fast = axis_of(words[2], words[3]);
  }
  if (!slow || !fast || slow->is_x == fast->is_x) {
    refuse(
        fmt::format("cannot be read as {}: no resolution like \"-Y 512 +X 1024\" "
                    "behind the header's empty line, but \"{}\"",
                    kName, shown(line)));
  }
  const Axis& x = slow->is_x ? *slow : *fast;
  const Axis& y = slow->is_x ? *fast : *slow;
  if (const std::string fault = size_fault(x.length, y.length); !fault.empty()) refuse(fault);
  return {slow->is_x, slow->is_x != slow->grows, fast->is_x != fast->grows,
          static_cast<int>(slow->length), static_cast<int>(fast->length)};
}

bool differs(double value, double expected) {
  return std::abs(value - expected) > kRounding * std::abs(expected);
}

}  // namespace

Extent RadianceResolution::extent() const {
  return columns ? Extent{scanlines, pixels} : Extent{pixels, scanlines};
}

std::string RadianceResolution::text() const {
  // X grows from left to right, Y from the bottom to the top: forwards is -Y or +X.
  const auto axis = [](bool is_x, bool backwards, int length) {
    return fmt::format("{}{} {}", is_x != backwards ? '+' : '-', is_x ? 'X' : 'Y', length);
  };
  return axis(columns, scanlines_backwards, scanlines) + " " +
         axis(!columns, pixels_backwards, pixels);
}

RadianceHeader read_radiance_header(ByteReader& bytes) {
  RadianceHeader header;
  next_line(bytes, "the header's end");  // "#?RADIANCE", by which the file was recognised
  while (true) {
    const std::string line = next_line(bytes, "the empty line that ends the header");
    if (line.empty()) break;
    read_line(header, line);
  }
  header.resolution = resolution_of(next_line(bytes, "the resolution ends"));
  return header;
}

std::vector<std::string> notes_of(const RadianceHeader& header) {
  std::vector<std::string> notes;
  if (!header.says_format) notes.emplace_back("No FORMAT in the header: taken as 32-bit_rle_rgbe.");
  if (differs(header.exposure, 1.0)) {
    notes.push_back(
        fmt::format("EXPOSURE={:.6g} in the header was not divided out.", header.exposure));
  }
  const auto& c = header.colour_correction;
  if (std::ranges::any_of(c, [](double factor) { return differs(factor, 1.0); })) {
    notes.push_back(fmt::format("COLORCORR={:.6g} {:.6g} {:.6g} in the header was not divided out.",
                                c[0], c[1], c[2]));
  }
  if (differs(header.gamma, 1.0)) {
    notes.emplace_back("The gamma in the header was not undone: the values are taken as linear.");
  }
  if (differs(header.pixel_aspect, 1.0)) {
    notes.push_back(
        fmt::format("PIXASPECT={:.6g} in the header was ignored: the shape of pixels "
                    "follows from the mapping of the whole sphere.",
                    header.pixel_aspect));
  }
  if (header.has_view) {
    notes.emplace_back(
        "VIEW in the header was ignored: --preset says how pixels map to "
        "directions.");
  }
  for (const std::string& line : header.unreadable) {
    notes.push_back(
        fmt::format("A line of the header could not be read and was ignored: {}", line));
  }
  return notes;
}

}  // namespace lightproof
