// Densities on a grid of directions, against where samples lie: what is counted in the cells is
// what the densities say.
#pragma once

#include "lightproof/check/density_grid.h"
#include "lightproof/dump/sample_dump.h"
#include "lightproof/results/test_record.h"

namespace lightproof {

/// The record of a dump's samples counted in up to kGateBins blocks of cells, against the
/// probabilities that the densities of the grid give them: the worst block, by a Poisson tail and
/// Bonferroni's bound.
///
/// A grid has densities at centres of cells and says nothing of what lies between. The probability
/// of a block is therefore taken to be anything within one percent, and within half of the second
/// differences of the densities of its cells, times their solid angles: half of a step inside a
/// cell, twelve times the error of the midpoint rule for a smooth density. Where no more than that
/// lies between the centres, a dump of the sampler that has these densities is rejected with at
/// most probability `alpha`. The test is not run where the cells do not tile the sphere, or where
/// blocks of no more than half of the probability are known to a third. `record` has what all
/// records of the run share.
TestRecord judge_grid_histogram(const DensityGrid& grid, const SampleDump& dump, double alpha,
                                TestRecord record);

}  // namespace lightproof
