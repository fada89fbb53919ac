// What a file beside a dump says of it.
#pragma once

#include <optional>
#include <string>

namespace lightproof::cli {

/// What is said of a dump by options, or by a JSON file beside it; empty where nothing is said.
struct DumpDescription {
  std::string columns;    ///< names, separated by commas
  std::string format;     ///< npy, f32, f64 or csv
  std::string axes;       ///< "x,-z,y"
  std::string preset;     ///< the preset of image coordinates, and whose axes directions have
  std::string measure;    ///< "solid-angle" or "square"
  std::string density;    ///< A, B or C
  std::string luminance;  ///< rec709, published, average, max, file
  std::string target;     ///< "none", a distribution over directions, or a picture of a density
};

/// What the file "DUMP.json" beside a dump says: an object with the keys columns (an array of
/// names), format, axes, preset, measure, density, luminance, target, all optional; others (a seed,
/// a note) are left alone. None if there is no such file. Throws InputError if it is no such
/// object.
std::optional<DumpDescription> read_side_car(const std::string& dump);

/// What options say, and where they say nothing, what the side-car says.
DumpDescription with_side_car(DumpDescription options, const DumpDescription& side_car);

}  // namespace lightproof::cli
