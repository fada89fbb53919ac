// A study made up for the tests: the shape and size of a real one, numbers from formulas.
#pragma once

#include "lightproof/suite/results.h"

namespace lightproof::testing {

/// Eight maps, six samplers in two weightings, 128 convergence records, 15 throughput rows and four
/// renders. The published scan fails on one map, which is called `<script>alert("x")</script>`;
/// everything else agrees with its prediction up to noise.
StudyResult made_up_study();

/// One accepted chi-square of `sampler` on `map`.
TestRecord accepted_test(const std::string& sampler, const std::string& map);

}  // namespace lightproof::testing
