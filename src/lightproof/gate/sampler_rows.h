// Rows of a map at which a sampler is asked something.
#pragma once

#include <cstddef>

#include "lightproof/core/parallel.h"
#include "lightproof/gate/sampler_failure.h"

namespace lightproof {

/// Runs ask(row) for so many rows, in parallel. Throws the failure of the first row in their order
/// whose sampler fails: which one fails first is chance.
template <class Ask>
void for_rows(std::size_t rows, const Ask& ask) {
  try {
    parallel_for(rows, ask);
  } catch (const SamplerFailure&) {
    for (std::size_t row = 0; row < rows; ++row) ask(row);
    throw;
  }
}

}  // namespace lightproof
