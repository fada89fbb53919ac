// lightproof gate: verdicts only.
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <memory>

#include "common.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/pending_file.h"
#include "lightproof/mutants/direction_mutant.h"
#include "lightproof/mutants/mutant.h"
#include "lightproof/report/ci_outputs.h"
#include "lightproof/report/json.h"
#include "lightproof/report/rejection_files.h"
#include "lightproof/report/table.h"
#include "lightproof/suite/direction_sampler.h"
#include "lightproof/suite/gate.h"
#include "lightproof/suite/sequential_gate.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  std::vector<std::string> samplers;
  std::string weighting;
  std::string json;
  std::string junit;
  std::string markdown;
  std::string rejections;
  bool github = false;
  bool sequential = false;
  bool nightly = false;
  bool sound_only = false;
  GateOptions gate;
};

/// What is tested: samplers of maps, which need some, and samplers of directions, which need none.
struct Chosen {
  std::vector<Subject> of_maps;
  std::vector<DirectionSampler> of_directions;
};

template <class Range>
auto find_named(Range& range, const std::string& name) {
  return std::find_if(range.begin(), range.end(),
                      [&](const auto& item) { return item.name == name; });
}

/// Adds the samplers or mutants of this name. Throws InputError if there are none.
void add_named(Chosen& chosen, const std::string& name) {
  for (std::vector<DirectionSampler> all : {direction_samplers(), direction_mutant_samplers()}) {
    const auto found = find_named(all, name);
    if (found == all.end()) continue;
    chosen.of_directions.push_back(std::move(*found));
    return;
  }
  const std::span<const Mutant> all_mutants = mutants();
  const auto mutant = find_named(all_mutants, name);
  for (const Weighting weighting : {Weighting::A, Weighting::B}) {
    chosen.of_maps.push_back(mutant != all_mutants.end()
                                 ? subject_of(*mutant, weighting)
                                 : subject_of(sampler_by_name(name), weighting));
  }
}

Chosen chosen_samplers(const Options& options) {
  Chosen chosen;
  for (const std::string& name : options.samplers) add_named(chosen, name);
  if (options.samplers.empty()) {
    chosen.of_maps = all_subjects();
    if (options.maps.empty()) chosen.of_directions = direction_samplers();
  }
  if (options.sound_only) {
    std::erase_if(chosen.of_maps, [](const Subject& subject) { return subject.known_defects; });
  }
  if (options.weighting.empty()) return chosen;
  chosen.of_directions.clear();
  std::erase_if(chosen.of_maps, [&](const Subject& subject) {
    return options.weighting != to_string(subject.target.weighting);
  });
  return chosen;
}

/// Samples per sampler and map.
std::uint64_t samples_of(const std::string& level) {
  if (level == "quick") return std::uint64_t{1} << 19U;
  return level == "full" ? GateOptions{}.samples : std::uint64_t{1} << 26U;
}

/// 20260131 on 31 January 2026 (UTC): other samples every night, and the report says which.
std::uint64_t seed_of_today() {
  const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day date(today);
  const auto year = static_cast<std::uint64_t>(static_cast<int>(date.year()));
  const std::uint64_t month = static_cast<unsigned>(date.month());
  const std::uint64_t day = static_cast<unsigned>(date.day());
  return 10000 * year + 100 * month + day;
}

void write_outputs(const Options& options, const GateResult& result, Outcome outcome,
                   bool count_known_defects) {
  if (!options.json.empty()) write_file(options.json, gate_json(result, outcome));
  if (!options.junit.empty()) write_file(options.junit, gate_junit(result, count_known_defects));
  if (!options.markdown.empty()) {
    write_file(options.markdown, gate_markdown(result, count_known_defects));
  }
  if (!options.rejections.empty()) write_rejections(result, options.rejections);
  if (options.github) fmt::print("{}", gate_annotations(result, count_known_defects));
}

int run(const Options& options) {
  const ThreadLimit threads(options.threads);
  const Chosen chosen = chosen_samplers(options);
  for (const std::string& file : {options.json, options.junit, options.markdown}) {
    if (!file.empty()) check_writable(file);
  }
  const std::vector<EnvironmentMap> maps = load_maps(options);
  GateOptions gate = options.gate;
  gate.seed = options.seed;
  const std::vector<Problem> problems = problems_of(maps, chosen.of_maps, chosen.of_directions);
  const Progress progress = progress_bar(options);
  GateResult result = options.sequential ? run_sequential_gate(problems, gate, progress)
                                         : run_gate(problems, gate, progress);
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
    case Outcome::resolution_limited:
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
  auto* samples = add_number(*command, "-n,--samples", options->gate.samples, 1024, kMostSamples,
                             "samples per sampler and map");
  CLI::Option* sampler = command
                             ->add_option("--sampler", options->samplers,
                                          "test only this one (may be repeated; see `lightproof "
                                          "list samplers` and `list mutants`)")
                             ->allow_extra_args(false);
  command
      ->add_flag("--sound-only", options->sound_only,
                 "leave out samplers that are kept with known defects")
      ->excludes(sampler);
  command->add_option("--weighting", options->weighting, "test only this weighting")
      ->check(CLI::IsMember({"A", "B"}));
  command
      ->add_option_function<std::string>(
          "--level",
          [options](const std::string& level) {
            options->gate.samples = samples_of(level);
            options->nightly = level == "nightly";
          },
          "samples by name: quick 2^19, full 2^22 (as without), nightly 2^26; nightly takes the "
          "date for the seed unless --seed is given")
      ->check(CLI::IsMember({"quick", "full", "nightly"}))
      ->excludes(samples);
  command->add_flag(
      "--sequential", options->sequential,
      "stop drawing as soon as a sampler is known to be wrong; tests counts and exact checks only");
  add_number(
      *command, "--family", options->gate.family, 0, std::uint64_t{1} << 53U,
      "p-values (with --sequential: samplers) that share the error probability, if more than "
      "this run has: to judge a part of a run as the whole did");
  add_path(*command, "--json", options->json, "write every test to this file");
  add_path(*command, "--junit", options->junit, "the same as JUnit XML, one case a test");
  add_path(*command, "--markdown", options->markdown, "a summary for a pull request");
  add_path(
      *command, "--rejections", options->rejections,
      "write residual maps, worst bins and divergence by row of what is rejected to this folder");
  command->add_flag("--github", options->github, "print annotations for GitHub Actions");
  command->footer(
      "Without MAP the samplers are tested on every built-in map, and the warps and materials\n"
      "as well. Exit codes: 0 none rejected, 1 rejected, 2 usage or input, 3 inconclusive,\n"
      "70 internal error, 71 not enough memory, 128 + N ended by signal N.\n"
      "Samplers with known defects are shown, but decide the exit code only if named by\n"
      "--sampler.");
  const CLI::Option* seed = command->get_option("--seed");
  command->callback([options, seed, &exit_code] {
    if (options->nightly && seed->count() == 0) options->seed = seed_of_today();
    exit_code = run(*options);
  });
}

}  // namespace lightproof::cli
