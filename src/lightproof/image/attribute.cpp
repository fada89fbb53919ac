#include "lightproof/image/attribute.h"

#include <algorithm>
#include <cassert>
#include <cctype>

#include "lightproof/core/text_escapes.h"

namespace lightproof {
namespace {

[[maybe_unused]] bool is_name(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

bool is_control(unsigned char c) { return c < 0x20 || c == 0x7f; }

}  // namespace

Attributes merged(Attributes attributes, const Attributes& later) {
  for (const Attribute& attribute : later) {
    const auto found = std::ranges::find(attributes, attribute.name, &Attribute::name);
    if (found == attributes.end()) {
      attributes.push_back(attribute);
    } else {
      found->value = attribute.value;
    }
  }
  return attributes;
}

std::string file_name_of(const Attribute& attribute) {
  assert(is_name(attribute.name));
  return std::string(kAttributePrefix) + attribute.name;
}

std::string line_of(const Attribute& attribute) {
  std::string line = attribute.value;
  std::ranges::replace_if(line, is_control, ' ');
  return well_formed_text(line);
}

}  // namespace lightproof
