// A synthetic study for the tests: the shape and size of a real one, numbers from formulas.
#pragma once

#include "lightproof/results/study_result.h"

namespace lightproof::testing {

/// Eight maps, six samplers in two densities, 128 convergence records, 15 throughput rows and four
/// renders. The published scan fails on one map, which is called `<script>alert("x")</script>`;
/// everything else agrees with its prediction up to noise.
StudyResult synthetic_study();

/// One accepted chi-square of `sampler` on `map`.
TestRecord accepted_test(const std::string& sampler, const std::string& map);

}  // namespace lightproof::testing
