#include "lightproof/decoder/embedded_profile.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace lightproof {
namespace {

constexpr std::size_t kTagTable = 128;
constexpr std::size_t kTagBytes = 12;
constexpr std::size_t kMostTags = 100;
constexpr std::size_t kLongestName = 100;
constexpr std::string_view kNone = "without a name";

using Bytes = std::span<const std::uint8_t>;

std::uint32_t number_at(Bytes bytes, std::size_t offset) {
  if (bytes.size() < 4 || offset > bytes.size() - 4) return 0;
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8U | bytes[offset + i];
  return number;
}

bool says(Bytes bytes, std::size_t offset, std::string_view word) {
  return offset <= bytes.size() && word.size() <= bytes.size() - offset &&
         std::equal(word.begin(), word.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
}

/// The tag's data; empty if there is no such tag.
Bytes tag(Bytes profile, std::string_view name) {
  const std::size_t tags = std::min<std::size_t>(number_at(profile, kTagTable), kMostTags);
  for (std::size_t i = 0; i < tags; ++i) {
    const std::size_t entry = kTagTable + 4 + i * kTagBytes;
    if (!says(profile, entry, name)) continue;
    const std::size_t offset = number_at(profile, entry + 4);
    const std::size_t size = number_at(profile, entry + 8);
    if (offset > profile.size() || size > profile.size() - offset) return {};
    return profile.subspan(offset, size);
  }
  return {};
}

/// Every `step`-th byte, as far as it is printable ASCII.
std::string printable(Bytes bytes, std::size_t step) {
  std::string text;
  for (std::size_t i = step - 1; i < bytes.size() && text.size() < kLongestName; i += step) {
    if (bytes[i] == 0) break;
    text += bytes[i] >= 0x20 && bytes[i] < 0x7f ? static_cast<char>(bytes[i]) : '?';
  }
  return text;
}

}  // namespace

std::string profile_name(Bytes profile) {
  const Bytes description = tag(profile, "desc");
  std::string name;
  if (says(description, 0, "desc") && description.size() > 12) {
    const std::size_t length =
        std::min<std::size_t>(number_at(description, 8), description.size() - 12);
    name = printable(description.subspan(12, length), 1);
  } else if (says(description, 0, "mluc")) {
    // The first of the languages, in UTF-16.
    const std::size_t length = number_at(description, 20);
    const std::size_t offset = number_at(description, 24);
    if (offset <= description.size() && length <= description.size() - offset) {
      name = printable(description.subspan(offset, length), 2);
    }
  }
  return name.empty() ? std::string(kNone) : name;
}

}  // namespace lightproof
