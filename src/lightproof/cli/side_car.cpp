#include "side_car.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "lightproof/core/error.h"
#include "lightproof/core/file_content.h"
#include "lightproof/core/json_text.h"

namespace lightproof::cli {
namespace {

using Json = nlohmann::json;

std::string text_of(const std::string& file, const Json& document, const char* key) {
  const auto found = document.find(key);
  if (found == document.end()) return "";
  if (!found->is_string()) throw InputError(fmt::format("{}: \"{}\" is no text", file, key));
  return found->get<std::string>();
}

std::string columns_of(const std::string& file, const Json& document) {
  const auto found = document.find("columns");
  if (found == document.end()) return "";
  std::string names;
  const bool are_names =
      found->is_array() &&
      std::all_of(found->begin(), found->end(), [](const Json& name) { return name.is_string(); });
  if (!are_names) {
    throw InputError(fmt::format(
        "{}: \"columns\" is no array of names, as in [\"x\", \"y\", \"z\", \"pdf\"]", file));
  }
  for (const Json& name : *found) {
    names += (names.empty() ? "" : ",") + name.get<std::string>();
  }
  return names;
}

}  // namespace

std::optional<DumpDescription> read_side_car(const std::string& dump) {
  const std::string file = dump + ".json";
  std::error_code unreadable;
  if (dump == "-" || !std::filesystem::exists(file, unreadable)) return std::nullopt;
  const std::string text = content_of(file).value_or("");
  const Json document =
      json_depth(text) > kDeepestJson ? Json() : Json::parse(text, nullptr, false);
  if (!document.is_object()) {
    throw InputError(
        fmt::format("{}: is no JSON object; it lies beside the dump, and would say what "
                    "its numbers mean",
                    file));
  }
  return DumpDescription{columns_of(file, document),           text_of(file, document, "format"),
                         text_of(file, document, "axes"),      text_of(file, document, "preset"),
                         text_of(file, document, "measure"),   text_of(file, document, "density"),
                         text_of(file, document, "luminance"), text_of(file, document, "target")};
}

DumpDescription with_side_car(DumpDescription options, const DumpDescription& side_car) {
  const auto fill = [](std::string& text, const std::string& other) {
    if (text.empty()) text = other;
  };
  fill(options.columns, side_car.columns);
  fill(options.format, side_car.format);
  fill(options.axes, side_car.axes);
  fill(options.preset, side_car.preset);
  fill(options.measure, side_car.measure);
  fill(options.density, side_car.density);
  fill(options.luminance, side_car.luminance);
  fill(options.target, side_car.target);
  return options;
}

}  // namespace lightproof::cli
