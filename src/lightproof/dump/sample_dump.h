// The samples of a dump as directions with densities per steradian, in Lightproof's frame.
#pragma once

#include <cstdint>
#include <span>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"
#include "lightproof/dump/number_table.h"
#include "lightproof/dump/sample_columns.h"
#include "lightproof/dump/sample_convention.h"

namespace lightproof {

/// A sample that another program drew. What its row cannot mean is not a number: a direction that
/// is no unit vector, coordinates outside of the image.
struct DumpedSample {
  Direction direction;
  PerSteradian pdf;  ///< not a number if the dump has none
};

/// The samples of a file. Many threads may read them.
class SampleDump {
 public:
  /// Throws InputError if the columns are not as many as the table has.
  SampleDump(NumberTable table, SampleColumns columns, SampleConvention convention);

  std::uint64_t count() const { return table_.rows(); }
  bool has_pdf() const { return columns_.pdf.has_value(); }
  /// The axes by which the directions are read.
  const AxisMap& axes() const { return convention_.axes; }
  /// By how much rounding may have moved a direction, in radians.
  double rounding() const;

  /// Reads samples first, first + 1, … .
  void read(std::uint64_t first, std::span<DumpedSample> samples) const;

 private:
  DumpedSample sample_of(std::span<const double> row) const;

  NumberTable table_;
  SampleColumns columns_;
  SampleConvention convention_;
};

}  // namespace lightproof
