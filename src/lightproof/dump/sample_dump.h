// The samples of a dump as directions with densities per steradian, in Lightproof's frame.
#pragma once

#include <cstdint>
#include <span>

#include "lightproof/dump/number_table.h"
#include "lightproof/dump/sample_columns.h"
#include "lightproof/dump/sample_convention.h"
#include "lightproof/dump/sample_row.h"

namespace lightproof {

/// The samples of a file. Many threads may read them.
class SampleDump {
 public:
  /// Throws InputError if the columns are not as many as the table has.
  SampleDump(NumberTable table, SampleColumns columns, SampleConvention convention);

  std::uint64_t count() const { return table_.rows(); }
  bool has_pdf() const { return rows_.columns().pdf.has_value(); }
  bool has_weights() const { return rows_.have_weights(); }
  /// Whether the weights have three channels.
  bool has_coloured_weights() const { return rows_.have_coloured_weights(); }
  /// What the densities of the file are per.
  DensityMeasure measure() const { return rows_.convention().measure; }
  /// The axes by which the directions are read.
  const AxisMap& axes() const { return rows_.convention().axes; }
  /// By how much rounding may have moved a direction, in radians.
  double rounding() const;

  /// Reads samples first, first + 1, … .
  void read(std::uint64_t first, std::span<DumpedSample> samples) const;
  /// Reads their weights, which they must have.
  void read_weights(std::uint64_t first, std::span<SampleWeight> weights) const;

 private:
  NumberTable table_;
  SampleRows rows_;
};

}  // namespace lightproof
