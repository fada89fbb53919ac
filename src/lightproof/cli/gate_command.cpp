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
#include "lightproof/mutants/mutant.h"
#include "lightproof/report/ci_outputs.h"
#include "lightproof/report/json.h"
#include "lightproof/report/table.h"
#include "lightproof/suite/gate.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  std::vector<std::string> samplers;
  std::string weighting;
  std::string json;
  std::string junit;
  std::string markdown;
  bool github = false;
  std::string level = "full";
  GateOptions gate;
};

/// Of the registry or of the mutants. Throws InputError if neither has the name.
std::vector<Subject> subjects_named(const std::string& name) {
  std::vector<Subject> subjects;
  const auto mutant = std::find_if(mutants().begin(), mutants().end(),
                                   [&](const Mutant& m) { return m.name == name; });
  for (const Weighting weighting : {Weighting::A, Weighting::B}) {
    subjects.push_back(mutant != mutants().end() ? subject_of(*mutant, weighting)
                                                 : subject_of(sampler_by_name(name), weighting));
  }
  return subjects;
}

std::vector<Subject> chosen_subjects(const Options& options) {
  std::vector<Subject> subjects;
  for (const std::string& name : options.samplers) {
    for (Subject& subject : subjects_named(name)) subjects.push_back(std::move(subject));
  }
  if (options.samplers.empty()) subjects = all_subjects();
  std::erase_if(subjects, [&](const Subject& subject) {
    return !options.weighting.empty() && options.weighting != to_string(subject.target.weighting);
  });
  return subjects;
}

/// Samples per configuration by level; --samples wins.
std::uint64_t samples_of(const Options& options) {
  if (options.gate.samples != GateOptions{}.samples || options.level == "full") {
    return options.gate.samples;
  }
  return options.level == "quick" ? std::uint64_t{1} << 20U : std::uint64_t{1} << 26U;
}

void write_outputs(const Options& options, const GateResult& result, Outcome outcome,
                   bool count_known_defects) {
  if (!options.json.empty()) write_file(options.json, gate_json(result, outcome));
  if (!options.junit.empty()) write_file(options.junit, gate_junit(result, count_known_defects));
  if (!options.markdown.empty()) {
    write_file(options.markdown, gate_markdown(result, count_known_defects));
  }
  if (options.github) fmt::print("{}", gate_annotations(result, count_known_defects));
}

int run(const Options& options) {
  const ThreadLimit threads(options.threads);
  const std::vector<Subject> subjects = chosen_subjects(options);
  for (const std::string& file : {options.json, options.junit, options.markdown}) {
    if (!file.empty()) check_writable(file);
  }
  const std::vector<EnvironmentMap> maps = load_maps(options);
  GateOptions gate = options.gate;
  gate.seed = options.seed;
  gate.samples = samples_of(options);
  GateResult result = run_gate(maps, subjects, gate, progress_bar(options));
  result.input_options = input_options(options);
  // A sampler with known defects fails a run only if it was asked for.
  const bool count_known_defects = !options.samplers.empty();
  const Outcome outcome = overall_outcome(result, count_known_defects);
  if (!options.quiet) {
    const Colour colour = use_color(options) ? Colour::ansi : Colour::off;
    fmt::print("{}", gate_table(result, count_known_defects, colour));
  }
  write_outputs(options, result, outcome, count_known_defects);
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
             "samples per sampler and map; overrides --level");
  command
      ->add_option(
          "--sampler", options->samplers,
          "test only this one (may be repeated; see `lightproof list samplers` and `list mutants`)")
      ->allow_extra_args(false);
  command->add_option("--weighting", options->weighting, "test only this weighting")
      ->check(CLI::IsMember({"A", "B"}));
  command
      ->add_option("--level", options->level,
                   "samples per sampler and map: quick 2^20, full 2^22, nightly 2^26")
      ->check(CLI::IsMember({"quick", "full", "nightly"}))
      ->default_str("full");
  add_path(*command, "--json", options->json, "write every test to this file");
  add_path(*command, "--junit", options->junit, "the same as JUnit XML, one case a test");
  add_path(*command, "--markdown", options->markdown, "a summary for a pull request");
  command->add_flag("--github", options->github, "print annotations for GitHub Actions");
  command->footer(
      "Without MAP every built-in map is tested. Exit codes: 0 all accepted, 1 rejected,\n"
      "2 usage or input, 3 inconclusive. Samplers with known defects are shown, but decide\n"
      "the exit code only if named by --sampler.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
