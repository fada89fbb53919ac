// Samplers of other processes may fail to answer at all.
#pragma once

#include <stdexcept>

namespace lightproof {

/// A sampler that runs elsewhere did not answer a call: its process ended, took too long or too
/// much. That is a verdict on the sampler, not an error of this program. The message says in words
/// what became of which call, and the input that it had.
class SamplerFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace lightproof
