// What a file says about how it was made: names and values, whatever its format.
#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace lightproof {

/// A name of ASCII letters, digits, '-' and '_', and any text. In files the name is preceded by
/// kAttributePrefix: "lightproof.method".
struct Attribute {
  std::string name;
  std::string value;
  friend bool operator==(const Attribute&, const Attribute&) = default;
  static auto fields(auto& a) { return std::tie(a.name, a.value); }
};

using Attributes = std::vector<Attribute>;

/// Keeps the names apart from those that a format defines.
inline constexpr std::string_view kAttributePrefix = "lightproof.";

/// Both lists; of a name that both have, the later value at the earlier place.
Attributes merged(Attributes attributes, const Attributes& later);

/// The name as it stands in a file.
std::string file_name_of(const Attribute& attribute);

/// The value as well-formed UTF-8 of one line: line breaks and other control characters are spaces.
std::string line_of(const Attribute& attribute);

}  // namespace lightproof
