// A dump against a distribution over directions that needs no map, as a test case of the gate.
#pragma once

#include <memory>

#include "lightproof/check/direction_target.h"
#include "lightproof/check/dump_test_case.h"
#include "lightproof/dump/sample_dump.h"
#include "lightproof/gate/test_case.h"

namespace lightproof {

/// The test case of a dump that is declared to have this distribution; of the claim, `target` is
/// left alone. A direction that could not be drawn, but lies within its rounding of one that could,
/// counts as that one.
TestCase direction_test_case(std::shared_ptr<const SampleDump> dump, const DirectionTarget& target,
                             const DumpClaim& claim);

/// Compares the density that comes with every sample, of up to 2^22 that are spread over the dump,
/// with the declared one in its direction. Densities may be off by `tolerance`, relative, and by as
/// much as the declared one changes within the rounding of the direction.
DensityComparison compare_direction_density(const SampleDump& dump, const DirectionTarget& target,
                                            const Expectation& expectation, double tolerance);

}  // namespace lightproof
