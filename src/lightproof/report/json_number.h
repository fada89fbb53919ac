// Numbers in JSON documents.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "lightproof/core/grid.h"

namespace lightproof::json_parts {

/// NaN is left to the library, which writes null. JSON has no infinity: readers who compare with a
/// threshold get a number beyond any.
inline nlohmann::ordered_json number(double value) { return std::clamp(value, -1e308, 1e308); }

inline nlohmann::ordered_json number(const std::optional<double>& value) {
  return value ? number(*value) : nlohmann::ordered_json(nullptr);
}

/// [width, height].
inline nlohmann::ordered_json size(Extent extent) {
  return nlohmann::ordered_json::array({extent.width, extent.height});
}

}  // namespace lightproof::json_parts
