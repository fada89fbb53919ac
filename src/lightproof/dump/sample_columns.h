// What the columns of a table of samples mean.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightproof {

/// What a column holds.
enum class ColumnRole {
  x,        ///< x of a direction
  y,        ///< y of a direction
  z,        ///< z of a direction
  s,        ///< image coordinate from the left, in [0,1]
  t,        ///< image coordinate from the bottom, in [0,1]
  v,        ///< image coordinate from the top, in [0,1]
  pdf,      ///< density of the sample
  weight,   ///< what the sample adds to an estimate, in grey
  red,      ///< of the weight
  green,    ///< of the weight
  blue,     ///< of the weight
  ignored,  ///< not read
};

/// A name of a column on the command line, and what it means.
struct ColumnName {
  std::string_view name;
  ColumnRole role;
  std::string_view description;
};

/// All names of columns.
std::span<const ColumnName> column_names();

/// Where the parts of a sample stand in a row: a direction or a position, and perhaps a density and
/// a weight.
struct SampleColumns {
  std::size_t count = 0;               ///< numbers of a row
  std::optional<std::size_t> x, y, z;  ///< all three or none
  std::optional<std::size_t> s, t;     ///< both or neither; none if x, y, z are there
  bool t_is_from_top = false;          ///< the column of t counts from the top
  std::optional<std::size_t> pdf;
  std::optional<std::size_t> weight;            ///< none if the weight has three channels
  std::optional<std::size_t> red, green, blue;  ///< of the weight: all three or none

  bool are_directions() const { return x.has_value(); }
};

/// The columns of these names, in their order. Throws InputError, which lists the names, if one is
/// unknown or twice there, or if they name no sample.
SampleColumns sample_columns(std::span<const std::string> names);

/// What rows of so many numbers hold where nobody says: x y z, or x y z pdf, and further numbers
/// that are not read. Throws InputError for fewer than three.
std::vector<std::string> default_columns(std::size_t count);

}  // namespace lightproof
