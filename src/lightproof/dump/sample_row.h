// A row of numbers as a sample, and a position as numbers, in the convention of another program.
#pragma once

#include <array>
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

/// What a sample adds to an estimate, in red, green and blue; alike if it is grey.
using SampleWeight = std::array<double, 3>;

/// What rows of these columns are, in this convention.
class SampleRows {
 public:
  SampleRows(SampleColumns columns, SampleConvention convention);

  const SampleColumns& columns() const { return columns_; }
  const SampleConvention& convention() const { return convention_; }

  /// The sample of a row of columns().count numbers.
  DumpedSample sample(std::span<const double> row) const;
  /// The samples of rows, one after the other.
  void set_samples(std::span<const double> rows, std::span<DumpedSample> samples) const;

  bool have_weights() const { return columns_.weight || columns_.red; }
  /// Whether the weights have three channels.
  bool have_coloured_weights() const { return columns_.red.has_value(); }
  /// The weight of a row, which must have one.
  SampleWeight weight(std::span<const double> row) const;

  /// Numbers that name a position: x, y, z, or two image coordinates.
  std::size_t numbers_of_position() const;
  /// Writes a direction as these numbers.
  void put_position(Direction direction, std::span<double> position) const;
  /// What a density that the other program names for a direction is per steradian.
  PerSteradian density(Direction direction, double value) const;

 private:
  /// set_samples() of rows that hold directions.
  void set_directions(std::span<const double> rows, std::span<DumpedSample> samples) const;

  SampleColumns columns_;
  SampleConvention convention_;
  AxisMap to_theirs_;
};

}  // namespace lightproof
