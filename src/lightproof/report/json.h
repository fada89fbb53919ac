// Results for other programs. Every key is described, with its unit and measure, by a JSON Schema
// in docs/schema: gate.schema.json, rejection.schema.json, study.schema.json. `format_version`
// grows when a key changes its meaning or goes away.
//
// Numbers that JSON cannot hold: NaN is null, the infinities are 1e308 and -1e308 (an impossible
// sample has log10_p -1e308). Text that is not UTF-8 (file names may be anything) has its bad bytes
// replaced by U+FFFD.
#pragma once

#include <string>
#include <vector>

#include "lightproof/core/run_description.h"
#include "lightproof/results/study_result.h"

namespace lightproof {

/// Version of the format of gate_json() and rejection_json().
inline constexpr int kGateFormatVersion = 2;
/// Version of the format of study_json().
inline constexpr int kStudyFormatVersion = 2;

/// The verdict on a whole run: the caller decides whether known defects count.
struct GateVerdict {
  Outcome overall = Outcome::inconclusive;
  bool count_known_defects = false;
};

/// A gate's result as JSON, every test of it; `rejections` holds those that count, `known_defects`
/// those of samplers that are kept as published and do not.
std::string gate_json(const GateResult& gate, GateVerdict verdict, const RunDescription& run);

/// One rejection of a gate's result as JSON, with the command that draws the same samples again. Of
/// `run` it takes version, commit and command.
std::string rejection_json(const GateResult& gate, const Rejection& rejection,
                           const RunDescription& run);

/// A study as JSON, everything in it but the pixels, which lie in the EXR files that it names.
/// Tests of samplers with known defects do not count towards gate.outcome. Of `run` it takes commit
/// and command.
std::string study_json(const StudyResult& study, const RunDescription& run);

}  // namespace lightproof
