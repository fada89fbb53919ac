// Frames, point sets and costs of levels as a study might have measured them, with all that is hard
// to draw: values that are not finite, zeros, a set without an exponent.
#pragma once

#include <vector>

#include "lightproof/results/frame_record.h"
#include "lightproof/results/level_cost.h"
#include "lightproof/results/point_study.h"
#include "lightproof/results/stability_result.h"

namespace lightproof::testing {

/// Two constructions, of which "bent" errs by the distance around -z and is not finite at 1e-6.
std::vector<FrameErrorRecord> synthetic_frames();

/// Three sets on a smooth integrand and on one with an edge; "steep" falls fastest, "exact" has no
/// errors. "shaky" decays.
PointStudy synthetic_points();

/// Three methods on two maps; "slow and wrong" is beaten by both others.
LevelCosts synthetic_level_costs();

/// Two cases; "steady" passes both, "published" and "limited" fail, "broken" breaks its claim.
/// Three breaking points: one is found, one lies at the easiest value, one beyond the hardest.
StabilityResult synthetic_stability();

}  // namespace lightproof::testing
