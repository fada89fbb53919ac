#include "verdict_outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <vector>

#include "lightproof/report/ci_outputs.h"
#include "lightproof/report/gate_table.h"
#include "messages.h"
#include "outputs.h"

namespace lightproof::cli {

void add_verdict_outputs(CLI::App& command, VerdictOutputs& outputs) {
  add_output(command, "--json", outputs.json, "write every test to this file");
  add_output(command, "--junit", outputs.junit, "the same as JUnit XML, one case a test");
  add_output(command, "--markdown", outputs.markdown,
             "a summary for a pull request or $GITHUB_STEP_SUMMARY");
  command.add_flag("--github", outputs.github,
                   "print annotations for GitHub Actions: one for each rejected sampler on a map, "
                   "nine at most, even if quiet");
}

void add_must_detect(CLI::App& command, double& must_detect) {
  command
      .add_option("--must-detect", must_detect,
                  "relative root mean square deviation of the bins over (phi, theta) that an "
                  "accepting run must have been able to see with 99 % probability; else it is "
                  "inconclusive")
      ->check(CLI::Range(1e-9, 1e9))
      ->type_name("W")
      ->capture_default_str();
}

bool check_verdict_outputs(const VerdictOutputs& outputs) {
  return check_outputs(std::vector<std::string>{outputs.json, outputs.junit, outputs.markdown});
}

void print_verdict(const CommonOptions& options, const VerdictOutputs& outputs,
                   const Judged& judged, bool stdout_is_taken) {
  std::FILE* const stream = stdout_is_taken ? stderr : stdout;
  const bool counts = judged.verdict.count_known_defects;
  if (!options.quiet) {
    const bool colours = use_color(options, stdout_is_taken ? STDERR_FILENO : STDOUT_FILENO);
    show(stream, gate_table(judged.result, counts, colours ? Colour::ansi : Colour::off));
  }
  if (outputs.github) show(stream, gate_annotations(judged.result, counts));
}

void write_verdict(const VerdictOutputs& outputs, const Judged& judged, const RunDescription& run) {
  const bool counts = judged.verdict.count_known_defects;
  if (!outputs.json.empty()) {
    write_output(outputs.json, gate_json(judged.result, judged.verdict, run));
  }
  if (!outputs.junit.empty()) write_output(outputs.junit, gate_junit(judged.result, counts));
  if (!outputs.markdown.empty()) {
    write_output(outputs.markdown, gate_markdown(judged.result, counts));
  }
}

ExitCode exit_code_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::accept:
    case Outcome::resolution_limited:
      return kPassed;
    case Outcome::reject:
      return kRejected;
    case Outcome::inconclusive:
    case Outcome::not_run:
      break;
  }
  return kInconclusive;
}

}  // namespace lightproof::cli
