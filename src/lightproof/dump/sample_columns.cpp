#include "lightproof/dump/sample_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lightproof/core/error.h"
#include "lightproof/core/text_escapes.h"

namespace lightproof {
namespace {

constexpr std::array kNames = {
    ColumnName{"x", ColumnRole::x, "x of the direction, a unit vector"},
    ColumnName{"y", ColumnRole::y, "y of the direction"},
    ColumnName{"z", ColumnRole::z, "z of the direction"},
    ColumnName{"s", ColumnRole::s, "image coordinate from the left, 0 to 1, in place of x, y, z"},
    ColumnName{"t", ColumnRole::t, "image coordinate from the bottom, 0 to 1"},
    ColumnName{"u", ColumnRole::s, "the same as s"},
    ColumnName{"v", ColumnRole::v, "image coordinate from the top, in place of t"},
    ColumnName{"pdf", ColumnRole::pdf, "density with which the sample was drawn"},
    ColumnName{"weight", ColumnRole::weight,
               "what the sample adds to an estimate of the light: luminance over pdf"},
    ColumnName{"wr", ColumnRole::red, "red of the weight"},
    ColumnName{"wg", ColumnRole::green, "green of the weight"},
    ColumnName{"wb", ColumnRole::blue, "blue of the weight"},
    ColumnName{"-", ColumnRole::ignored, "a column that is not read"},
};

std::string all_names() {
  std::string names;
  for (const ColumnName& column : kNames) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", column.name);
  }
  return names;
}

std::optional<std::size_t>& index_of(SampleColumns& columns, ColumnRole role) {
  switch (role) {
    case ColumnRole::x:
      return columns.x;
    case ColumnRole::y:
      return columns.y;
    case ColumnRole::z:
      return columns.z;
    case ColumnRole::s:
      return columns.s;
    case ColumnRole::t:
    case ColumnRole::v:
      return columns.t;
    case ColumnRole::weight:
      return columns.weight;
    case ColumnRole::red:
      return columns.red;
    case ColumnRole::green:
      return columns.green;
    case ColumnRole::blue:
      return columns.blue;
    case ColumnRole::pdf:
    case ColumnRole::ignored:
      break;
  }
  return columns.pdf;
}

void check_parts(const SampleColumns& columns) {
  const int channels = (columns.red ? 1 : 0) + (columns.green ? 1 : 0) + (columns.blue ? 1 : 0);
  if (channels != 0 && (channels != 3 || columns.weight)) {
    throw InputError("a weight has three channels, wr, wg and wb, or is one column, weight");
  }
  const int parts = (columns.x ? 1 : 0) + (columns.y ? 1 : 0) + (columns.z ? 1 : 0);
  const int coordinates = (columns.s ? 1 : 0) + (columns.t ? 1 : 0);
  if (parts == 3 && coordinates == 0) return;
  if (parts == 0 && coordinates == 2) return;
  throw InputError(
      "columns name no sample: x, y and z are needed, or s and t (or u and v) in their place");
}

}  // namespace

std::span<const ColumnName> column_names() { return kNames; }

SampleColumns sample_columns(std::span<const std::string> names) {
  SampleColumns columns;
  columns.count = names.size();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto known = std::find_if(kNames.begin(), kNames.end(), [&](const ColumnName& column) {
      return column.name == names[i];
    });
    if (known == kNames.end()) {
      throw InputError(fmt::format("no column is called \"{}\": the names are {}",
                                   terminal_text(names[i]), all_names()));
    }
    if (known->role == ColumnRole::ignored) continue;
    auto& index = index_of(columns, known->role);
    if (index) throw InputError(fmt::format("two columns are {}", known->name));
    index = i;
    if (known->role == ColumnRole::v) columns.t_is_from_top = true;
  }
  check_parts(columns);
  return columns;
}

std::vector<std::string> default_columns(std::size_t count) {
  if (count < 3) {
    throw InputError(fmt::format(
        "rows of {} number{} are no directions: name what they hold by --columns, as in --columns "
        "s,t",
        count, count == 1 ? "" : "s"));
  }
  std::vector<std::string> names = {"x", "y", "z", "pdf"};
  names.resize(count, "-");
  return names;
}

}  // namespace lightproof
