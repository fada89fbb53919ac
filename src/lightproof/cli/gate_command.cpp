// lightproof gate: verdicts only.
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>

#include "common.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/pending_file.h"
#include "lightproof/report/json.h"
#include "lightproof/report/table.h"
#include "lightproof/suite/gate.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  std::vector<std::string> samplers;
  std::string weighting;
  std::string json;
  GateOptions gate;
};

std::vector<Subject> chosen_subjects(const Options& options) {
  for (const std::string& name : options.samplers) sampler_by_name(name);
  std::vector<Subject> subjects;
  for (const Subject& subject : all_subjects()) {
    const bool named = options.samplers.empty() ||
                       std::find(options.samplers.begin(), options.samplers.end(), subject.name) !=
                           options.samplers.end();
    const bool weighted =
        options.weighting.empty() || options.weighting == to_string(subject.target.weighting);
    if (named && weighted) subjects.push_back(subject);
  }
  return subjects;
}

int run(const Options& options) {
  const ThreadLimit threads(options.threads);
  const std::vector<Subject> subjects = chosen_subjects(options);
  if (!options.json.empty()) check_writable(options.json);
  const std::vector<EnvironmentMap> maps = load_maps(options);
  GateOptions gate = options.gate;
  gate.seed = options.seed;
  const GateResult result = run_gate(maps, subjects, gate, progress_bar(options));
  // A sampler with known defects fails a run only if it was asked for.
  const bool count_known_defects = !options.samplers.empty();
  const Outcome outcome = overall_outcome(result, count_known_defects);
  if (!options.quiet) {
    const Colour colour = use_color(options) ? Colour::ansi : Colour::off;
    fmt::print("{}", gate_table(result, count_known_defects, colour));
  }
  if (!options.json.empty()) write_file(options.json, gate_json(result, outcome));
  switch (outcome) {
    case Outcome::accept:
      return kPassed;
    case Outcome::reject:
      return kRejected;
    case Outcome::inconclusive:
      break;
  }
  return kInconclusive;
}

}  // namespace

void add_gate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("gate", "Test samplers on maps: does each draw the right distribution?");
  add_common_options(*command, *options);
  add_number(*command, "-n,--samples", options->gate.samples, 1024, kMostSamples,
             "samples per sampler and map");
  command
      ->add_option("--sampler", options->samplers,
                   "test only this one (may be repeated; see `lightproof list samplers`)")
      ->allow_extra_args(false);
  command->add_option("--weighting", options->weighting, "test only this weighting")
      ->check(CLI::IsMember({"A", "B"}));
  add_path(*command, "--json", options->json, "write every test to this file");
  command->footer(
      "Without MAP every built-in map is tested. Exit codes: 0 all accepted, 1 rejected,\n"
      "2 usage or input, 3 inconclusive. Samplers with known defects are shown, but decide\n"
      "the exit code only if named by --sampler.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
