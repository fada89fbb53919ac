// A row of numbers as a sample, and a position as numbers, in the convention of another program.
#pragma once

#include <cstddef>
#include <span>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"
#include "lightproof/dump/sample_columns.h"
#include "lightproof/dump/sample_convention.h"

namespace lightproof {

/// A sample that another program drew. What its row cannot mean is not a number: a direction that
/// is no unit vector, coordinates outside of the image.
struct DumpedSample {
  Direction direction;
  PerSteradian pdf;  ///< not a number if no column holds it
};

/// What rows of these columns are, in this convention.
class SampleRows {
 public:
  SampleRows(SampleColumns columns, SampleConvention convention);

  const SampleColumns& columns() const { return columns_; }
  const SampleConvention& convention() const { return convention_; }

  /// The sample of a row of columns().count numbers.
  DumpedSample sample(std::span<const double> row) const;

  /// Numbers that name a position: x, y, z, or two image coordinates.
  std::size_t numbers_of_position() const;
  /// Writes a direction as these numbers.
  void put_position(Direction direction, std::span<double> position) const;
  /// What a density that the other program names for a direction is per steradian.
  PerSteradian density(Direction direction, double value) const;

 private:
  SampleColumns columns_;
  SampleConvention convention_;
  AxisMap to_theirs_;
};

}  // namespace lightproof
