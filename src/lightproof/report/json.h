// Results for other programs.
//
// Numbers that JSON cannot hold, in both documents: NaN is null, the infinities are 1e308 and
// -1e308 (an impossible sample has log10_p -1e308). Text that is not UTF-8 (file names may be
// anything) has its bad bytes replaced by U+FFFD.
#pragma once

#include <string>

#include "lightproof/suite/results.h"

namespace lightproof {

/// Keys: outcome, family_alpha, samples, seed, tests: [sampler, weighting, map, oracle, test,
/// samples, statistic, dof, log10_p (null for a deterministic check), effect, detectable_effect
/// (null where there is none), outcome, known_defect, detail]. `overall` is the verdict on the
/// whole run: the caller decides whether known defects count.
std::string gate_json(const GateResult& gate, Outcome overall);

/// One of its rejections: sampler, weighting, map, looks_like, diagnosis, worst_bins,
/// row_divergence, replay.
std::string rejection_json(const GateResult& gate, const Rejection& rejection);

/// Everything in the study but the pixels, which lie in the EXR files that it names. Tests of
/// samplers with known defects do not count towards gate.outcome.
std::string study_json(const StudyResult& study);

}  // namespace lightproof
