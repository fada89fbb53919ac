// The gate's verdicts as continuous integration reads them.
#pragma once

#include <string>

#include "lightproof/results/gate_result.h"

namespace lightproof {

/// The command that draws the samples of a test's run again, quoted for a shell.
std::string replay_command(const GateResult& gate, const TestRecord& test);
/// The command that draws the samples of a rejected run again, quoted for a shell.
std::string replay_command(const GateResult& gate, const Rejection& rejection);

/// The verdicts as JUnit XML: one test case per sampler, density, map and test, with `p` and
/// `log10_p` (numbers; not there for an exact check), effect, seed and replay command in its
/// properties and, where it failed, in its message. Rejections of samplers with known defects are
/// skipped cases unless they count.
std::string gate_junit(const GateResult& gate, bool count_known_defects);

/// The verdicts as a summary for a pull request in GitHub's Markdown, always below 60,000 bytes:
/// what is left out is counted.
std::string gate_markdown(const GateResult& gate, bool count_known_defects);

/// The verdicts as GitHub workflow commands: one annotation for each rejected sampler on a map,
/// with its worst test, the diagnosis and the command to draw the samples again; the worst nine (a
/// step shows ten at most), and the number of the others.
std::string gate_annotations(const GateResult& gate, bool count_known_defects);

}  // namespace lightproof
