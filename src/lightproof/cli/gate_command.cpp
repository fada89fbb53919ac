// lightproof gate: verdicts only.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <memory>
#include <set>
#include <utility>

#include "common.h"
#include "describe_run.h"
#include "gate_samplers.h"
#include "known_names.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/gate/gate.h"
#include "lightproof/gate/sequential_gate.h"
#include "lightproof/report/gate_summary.h"
#include "lightproof/report/rejection_files.h"
#include "messages.h"
#include "outputs.h"
#include "plugin_options.h"
#include "verdict_outputs.h"
#include "whole_number.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  std::vector<std::string> samplers;
  ChosenPlugins plugins;
  std::string density_space;
  VerdictOutputs outputs;
  std::string rejections;
  bool sequential = false;
  bool nightly = false;
  bool with_published = false;
  bool sound_only = false;  ///< always so; accepted because scripts of earlier versions say it
  bool force = false;
  GateOptions gate;
};

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

/// The names of all files that --rejections may write for these test cases.
std::set<std::string> names_of_rejections(std::span<const TestCase> test_cases) {
  std::set<std::string> names;
  for (const TestCase& test_case : test_cases) {
    for (const SamplerInstance& candidate : test_case.instances) {
      names.merge(rejection_file_names(candidate.name, test_case.density_space, test_case.map));
    }
  }
  return names;
}

/// Progress is shown until it returns.
Judged run_on(std::span<const TestCase> test_cases, const Options& options) {
  GateOptions gate = options.gate;
  gate.seed = options.seed;
  const Progress progress = progress_of(options);
  Judged judged;
  judged.result = options.sequential ? run_sequential_gate(test_cases, gate, progress)
                                     : run_gate(test_cases, gate, progress);
  judged.result.input_options = input_options(options);
  // A sampler with known defects fails a run only if it was asked for by its name.
  judged.verdict.count_known_defects = !options.samplers.empty();
  judged.verdict.overall = overall_outcome(judged.result, judged.verdict.count_known_defects);
  return judged;
}

/// Throws InputError if nothing that was asked for can be tested on one of the maps: no verdict is
/// no acceptance.
void refuse_untested_maps(const std::vector<TestCase>& test_cases,
                          const std::vector<LeftOut>& left_out) {
  for (const LeftOut& first : left_out) {
    const auto is_of_map = [&](const TestCase& test_case) { return test_case.map == first.map; };
    if (std::ranges::any_of(test_cases, is_of_map)) continue;
    throw InputError(fmt::format("{}: nothing is left to test: {} {}: {}, or --resample", first.map,
                                 first.sampler, first.density_space, first.reason));
  }
}

int run(const Options& options) {
  const ThreadLimit threads(options.threads);
  const PluginLibraries plugins = load_plugins(options.plugins, options.seed);
  const auto plugin_notes = std::make_shared<PluginNotes>();
  const ChosenSamplers chosen =
      choose_samplers({options.samplers, options.density_space, options.with_published,
                       !options.maps.empty(), samplers_of(plugins, plugin_notes)});
  const bool stdout_is_taken = check_verdict_outputs(options.outputs);
  if (!options.quiet) print_notes(chosen.notes);
  CheckedMaps maps = check_maps(options);
  const std::vector<TestCase> test_cases =
      test_cases_of(maps.sources, chosen.of_maps, chosen.of_directions);
  std::vector<LeftOut> left_out = left_out_on(maps.sources, chosen.of_maps);
  refuse_untested_maps(test_cases, left_out);
  if (!options.rejections.empty()) {
    check_folder(options.rejections, options.force, names_of_rejections(test_cases),
                 options.command_line);
  }
  Judged judged = run_on(test_cases, options);
  judged.result.left_out = std::move(left_out);
  judged.result.third_party_samplers = third_party_samplers(plugins, options.plugins);
  if (!options.quiet) print_notes(plugin_notes->all());
  print_verdict(options, options.outputs, judged, stdout_is_taken);
  const RunDescription description = describe_run(options, std::move(maps.descriptions));
  write_verdict(options.outputs, judged, description);
  if (!options.rejections.empty()) {
    write_rejections(split_gate(judged.result, judged.verdict.count_known_defects).deciding,
                     options.rejections, description, overwriting(options.force));
  }
  return exit_code_of(judged.verdict.overall);
}

}  // namespace

namespace {

void add_sampler_options(CLI::App& command, Options& options) {
  CLI::Option* sampler = command
                             .add_option("--sampler", options.samplers,
                                         "test only this one (may be repeated; see `lightproof "
                                         "list samplers` and `list mutants`); `directions` are "
                                         "the warps and materials that run without MAP, "
                                         "`all_directions` every one at every roughness and angle")
                             ->allow_extra_args(false);
  command
      .add_flag("--with-published", options.with_published,
                "show samplers that are kept with known defects as well; they decide nothing")
      ->excludes(sampler);
  command.add_flag("--sound-only", options.sound_only)->group("");
  std::vector<std::string> labels;
  std::string words;
  for (const DensityInfo& density : kDensities) {
    labels.emplace_back(density.label);
    words += fmt::format("{}{}, {}: {}", words.empty() ? "" : "; ", density.label, density.name,
                         density.words);
  }
  command
      .add_option("--density", options.density_space,
                  fmt::format("test only this target density: {}", words))
      ->check(one_of("density", labels))
      ->type_name(fmt::format("{}", fmt::join(labels, "|")));
}

void add_output_options(CLI::App& command, Options& options) {
  add_verdict_outputs(command, options.outputs);
  add_path(command, "--rejections", options.rejections,
           "write residual maps, worst bins and the cumulative divergence of rows of what is "
           "rejected to this folder");
  add_force(command, options.force);
}

void add_sample_options(CLI::App& command, const std::shared_ptr<Options>& options) {
  auto* samples = add_number(command, "-n,--samples", options->gate.samples, 1024, kMostSamples,
                             fmt::format("samples per sampler and map; {}", kWholeNumberForms));
  command
      .add_option_function<std::string>(
          "--level",
          [options](const std::string& level) {
            options->gate.samples = samples_of(level);
            options->nightly = level == "nightly";
          },
          "samples by name: quick 2^19, full 2^22 (as without), nightly 2^26; nightly takes the "
          "date for the seed unless --seed is given")
      ->check(one_of("level", {"quick", "full", "nightly"}))
      ->type_name("quick|full|nightly")
      ->excludes(samples);
  command.add_flag(
      "--sequential", options->sequential,
      "stop drawing as soon as a sampler is known to be wrong; tests counts and exact checks only");
  add_number(command, "--family", options->gate.family, 0, std::uint64_t{1} << 53U,
             "p-values (with --sequential: samplers) that share the error probability, if more "
             "than this run has: to judge a part of a run as the whole did");
  add_must_detect(command, options->gate.must_detect);
}

}  // namespace

void add_gate(CLI::App& app, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->command_line = line;
  CLI::App* command =
      app.add_subcommand("gate", "Test samplers on maps: does each draw the right distribution?");
  add_common_options(*command, *options);
  add_sample_options(*command, options);
  add_sampler_options(*command, *options);
  add_plugin_options(*command, options->plugins);
  add_output_options(*command, *options);
  command->footer(
      "Without MAP the samplers are tested on every built-in map, and the warps and materials\n"
      "as well. With --plugin its samplers alone are tested, and those named by --sampler.\n"
      " Exit codes: 0 none rejected, 1 rejected, 2 usage or input, 3 inconclusive,\n"
      "70 internal error, 71 not enough memory, 128 + N ended by signal N.\n"
      "Samplers with known defects are tested with --with-published, and decide the exit code\n"
      "only if named by --sampler.");
  const CLI::Option* seed = command->get_option("--seed");
  command->callback([options, seed, &exit_code] {
    if (options->nightly && seed->count() == 0) options->seed = seed_of_today();
    exit_code = run(*options);
  });
}

}  // namespace lightproof::cli
