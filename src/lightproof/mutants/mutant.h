// Samplers with one planted defect each: what the gate must find. `gate --sampler NAME` runs them
// like any other.
#pragma once

#include <span>
#include <string_view>

#include "lightproof/suite/law_sampler.h"
#include "lightproof/suite/subject.h"

namespace lightproof {

/// What differs from a sound sampler; null parts are sound.
struct Mutant {
  std::string_view name;       ///< "t-flipped-in-sample"
  std::string_view defect;     ///< what was done, in words
  std::string_view diagnosis;  ///< what the gate should say that it looks like
  std::string_view oracle;     ///< the oracle that must reject it
  /// What a map must have for the defect to do harm; empty: nothing that real maps lack.
  std::string_view needs = {};
  /// An alternative law that is drawn, its density returned; empty: the declared one.
  std::string_view law = {};
  /// The random numbers that are used in place of the i-th of a batch.
  SquarePoint (*numbers)(std::span<const SquarePoint> batch, std::size_t i) = nullptr;
  /// In place of LawSampler::sample.
  TexelSample (*draw)(const LawSampler&, SquarePoint u) = nullptr;
  /// Applied to what was drawn.
  void (*sample)(TexelSample&, const LawSampler&) = nullptr;
  /// In place of LawSampler::pdf, for the density asked for; returned densities are not touched.
  PerSquare (*pdf)(const LawSampler&, SquarePoint) = nullptr;
  /// Of all densities, returned and asked for.
  double (*pdf_factor)(const LawSampler&) = nullptr;
};

std::span<const Mutant> mutants();

/// Under a weighting; declares Rec. 709 grey.
Subject subject_of(const Mutant& mutant, Weighting weighting);

}  // namespace lightproof
