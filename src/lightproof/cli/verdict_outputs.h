// What the commands that give a verdict share: where it is written, how it is shown, and the exit
// code.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "common.h"
#include "lightproof/core/run_description.h"
#include "lightproof/report/json.h"
#include "lightproof/results/gate_result.h"

namespace lightproof::cli {

/// Files that a verdict is written to; empty ones are not asked for.
struct VerdictOutputs {
  std::string json;
  std::string junit;
  std::string markdown;
  bool github = false;  ///< whether annotations for GitHub Actions are printed
};

/// Adds --json, --junit, --markdown and --github.
void add_verdict_outputs(CLI::App& command, VerdictOutputs& outputs);

/// Adds --must-detect.
void add_must_detect(CLI::App& command, double& must_detect);

/// Whether one of them is the standard output; throws as check_outputs() does.
bool check_verdict_outputs(const VerdictOutputs& outputs);

/// A gate's result, and how it is judged.
struct Judged {
  GateResult result;
  GateVerdict verdict;
};

/// Prints what people read, unless quiet: to stderr if the standard output is one of the files.
void print_verdict(const CommonOptions& options, const VerdictOutputs& outputs,
                   const Judged& judged, bool stdout_is_taken);

/// Writes the files.
void write_verdict(const VerdictOutputs& outputs, const Judged& judged, const RunDescription& run);

/// 0, 1 or 3.
ExitCode exit_code_of(Outcome outcome);

}  // namespace lightproof::cli
