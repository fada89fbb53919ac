// lightproof study: the main job.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>

#include "common.h"
#include "describe_run.h"
#include "kept_measurements.h"
#include "lightproof/core/error.h"
#include "lightproof/core/kept_file.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/running_program.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/recommend/survey.h"
#include "lightproof/report/report.h"
#include "lightproof/self_test/kept_self_test.h"
#include "lightproof/stability/stability.h"
#include "lightproof/study/frame_study.h"
#include "lightproof/study/level_costs.h"
#include "lightproof/study/method_regimes.h"
#include "lightproof/study/point_study.h"
#include "lightproof/study/study.h"
#include "lightproof/systems/comparisons.h"
#include "outputs.h"
#include "plugin_options.h"
#include "unfinished_run.h"
#include "whole_number.h"

namespace lightproof::cli {
namespace fs = std::filesystem;
namespace {

struct Options : CommonOptions {
  std::string output = "out";
  std::string throughput;
  bool force = false;
  bool resume = false;
  bool no_throughput = false;
  bool no_self_test = false;
  bool no_stability = false;
  bool measure_again = false;
  std::uint64_t largest_width = 8192;
  std::vector<std::string> materials = {"ggx:0.3"};
  std::vector<std::string> receivers = {"sphere", "sphere-on-plane"};
  std::string quality = "draft";
  bool no_accuracy = false;
  bool no_regimes = false;
  ChosenPlugins plugins;
  StudyOptions study;
};

/// A script gets the path as it is, a terminal without what would control it.
std::string path_text(const fs::path& path) {
  return isatty(STDOUT_FILENO) != 0 ? terminal_text(path.string()) : path.string();
}

/// The benchmark program is built beside this one.
std::optional<fs::path> benchmark_program(const Options& options) {
  if (options.no_throughput || !options.throughput.empty()) return std::nullopt;
  std::error_code error;
  const fs::path program = running_program().parent_path() / "lightproof_bench";
  if (fs::exists(program, error)) return program;
  throw InputError(fmt::format(
      "{}: the benchmark program is not there; give its results with --throughput FILE or leave "
      "them out with --no-throughput",
      program.string()));
}

/// Every receiver in every material.
std::vector<AccuracyScene> accuracy_scenes(const Options& options) {
  std::vector<AccuracyScene> scenes;
  if (options.no_accuracy) return scenes;
  for (const std::string& material : options.materials) {
    for (const std::string& receiver : options.receivers) {
      scenes.push_back({&receiver_by_name(receiver), {material, material_of(material)}});
    }
  }
  return scenes;
}

/// What no map of a study changes, and what levels cost on its maps; each is kept as it ends.
void add_kept_measurements(const Options& options, const UnfinishedWork& unfinished,
                           const Progress& progress, StudyResult& result) {
  const MeasurementCache& cache = options.study.cache;
  if (!options.no_accuracy && !options.no_regimes) {
    result.method_regimes =
        unfinished.stage<MethodRegimes>("method-regimes", [&](const Communicator& /*alone*/) {
          return kept_method_regimes(options.seed, cache, progress);
        });
  }
  result.points = unfinished.stage<PointStudy>("points", [&](const Communicator& /*alone*/) {
    return kept_points(options.seed, cache, progress);
  });
  if (!options.no_throughput) {
    result.level_costs =
        unfinished.stage<LevelCosts>("level-costs", [&](const Communicator& /*alone*/) {
          return kept_level_costs(result.maps, {.threads = thread_count(options.threads)}, cache,
                                  progress);
        });
  }
  auto forms = unfinished.stage<PublishedForms>(
      "published-forms",
      [&](const Communicator& /*alone*/) { return kept_published_forms(cache, progress); });
  result.published_forms = std::move(forms.comparisons);
  result.published_pictures = std::move(forms.pictures);
  if (!options.no_stability) {
    result.stability =
        unfinished.stage<StabilityResult>("stability", [&](const Communicator& /*alone*/) {
          return kept_stability(options.seed, cache, progress);
        });
  }
  if (!options.no_self_test) {
    result.self_test =
        unfinished.stage<SelfTestResult>("self-test", [&](const Communicator& /*alone*/) {
          return kept_self_test(result.maps, self_test_options(options.seed), cache, progress);
        });
  }
}

/// All that goes into the report. Progress is shown until it returns.
StudyResult run_on(std::vector<EnvironmentMap> maps, const Options& options,
                   const UnfinishedWork& unfinished) {
  const Progress progress = progress_of(options);
  StudyResult result = run_study(std::move(maps), options.study, progress, unfinished);
  result.gate.input_options = input_options(options);
  result.frames = study_frames();
  if (!options.no_accuracy) {
    result.recommendation_survey = kept_survey(options.study.cache.folder);
  }
  add_kept_measurements(options, unfinished, progress, result);
  return result;
}

/// What the results depend on, but for times.
std::vector<RunInput> inputs_of(const Options& options, std::span<const EnvironmentMap> maps,
                                std::vector<RunInput> from_options) {
  std::vector<RunInput> inputs = program_inputs();
  for (RunInput& map : map_inputs(maps)) inputs.push_back(std::move(map));
  for (RunInput& option : from_options) inputs.push_back(std::move(option));
  if (!options.throughput.empty()) {
    const auto hash = hash_of_file(options.throughput);
    inputs.push_back({"the content of --throughput", fmt::format("{:016x}", hash.value_or(0))});
  }
  for (const std::string& plugin : options.plugins.files) {
    const auto hash = hash_of_file(plugin);
    inputs.push_back({fmt::format("the content of --plugin {}", plugin),
                      fmt::format("{:016x}", hash.value_or(0))});
  }
  return inputs;
}

int run(Options options, std::vector<RunInput> from_options) {
  const ThreadLimit threads(options.threads);
  const PluginLibraries plugins = load_plugins(options.plugins, options.seed);
  const auto plugin_notes = std::make_shared<PluginNotes>();
  add_plugins(samplers_of(plugins, plugin_notes), options.study.samplers);
  if (const auto program = benchmark_program(options)) {
    options.study.throughput = {*program,
                                options.largest_width,
                                cache_folder(),
                                options.measure_again,
                                {options.plugins.files.begin(), options.plugins.files.end()}};
  }
  options.study.gate.seed = options.study.convergence.seed = options.study.renders.seed =
      options.study.accuracy.seed = options.seed;
  options.study.accuracy.quality = accuracy_quality_by_name(options.quality);
  options.study.accuracy_scenes = accuracy_scenes(options);
  Throughput throughput;
  if (!options.throughput.empty()) throughput = read_throughput(options.throughput);
  std::vector<EnvironmentMap> maps = load_maps(options);
  const RunFolder folder = {options.output, options.force, options.resume};
  const bool replaces = check_run_folder(folder, report_file_names(), options.command_line);
  UnfinishedWork unfinished =
      begin_work(folder, inputs_of(options, maps, std::move(from_options)), options.command_line);
  const RunDescription description = describe_run(options, maps);
  options.study.cache = kept_measurements(description.commit, options.measure_again);
  keeping_parts(unfinished, folder, [&] {
    StudyResult result = run_on(std::move(maps), options, unfinished);
    result.gate.third_party_samplers = third_party_samplers(plugins, options.plugins);
    if (!throughput.samplers.empty()) set_throughput(result, std::move(throughput));
    write_report(result, options.output, description, overwriting(replaces));
  });
  unfinished.remove();
  if (!options.quiet) print_notes(plugin_notes->all());
  if (!options.quiet) fmt::print("{}\n", path_text(fs::path(options.output) / "report.html"));
  return kPassed;
}

/// What is charted of speed against accuracy.
void add_accuracy_options(CLI::App& command, Options& options) {
  auto* material =
      command
          .add_option("--material", options.materials,
                      "a material in which speed is charted against accuracy: a name of `list "
                      "materials`, phong:N or ggx:R; may be given again")
          ->type_name("NAME")
          ->capture_default_str();
  auto* receiver = command
                       .add_option("--receiver", options.receivers,
                                   "a receiver on which it is charted: point, sphere, plane or "
                                   "sphere-on-plane; may be given again")
                       ->type_name("NAME")
                       ->capture_default_str();
  auto* quality = command
                      .add_option("--quality", options.quality,
                                  "how thoroughly it is charted: draft, default or paper")
                      ->type_name("NAME")
                      ->capture_default_str();
  command.add_flag("--no-accuracy", options.no_accuracy, "leave that chart out")
      ->excludes(material)
      ->excludes(receiver)
      ->excludes(quality);
}

}  // namespace

void add_study(CLI::App& app, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->command_line = line;
  CLI::App* command = app.add_subcommand(
      "study", "The main job: gate, convergence, variance, throughput and renders as one report");
  add_common_options(*command, *options);
  add_path(*command, "-o,--output", options->output,
           "folder of the report, which must be new or empty unless --force is given")
      ->capture_default_str();
  add_force(*command, options->force);
  add_resume(*command, options->resume);
  add_number(*command, "-n,--samples", options->study.gate.samples, 1024, kMostSamples,
             fmt::format("samples of each gate test; {}", kWholeNumberForms));
  auto* file = add_path(*command, "--throughput", options->throughput,
                        "take throughput from this output of lightproof_bench");
  command->add_flag("--no-throughput", options->no_throughput, "leave throughput out")
      ->excludes(file);
  add_number(*command, "--largest", options->largest_width, 512, 16384,
             "width of the largest map that throughput is measured on; 16384 takes 8 GB")
      ->excludes(file);
  command
      ->add_flag("--measure-again", options->measure_again,
                 "measure what is kept of this program and machine: throughput, self-test, first "
                 "tests of warps and materials, costs of levels, point sets, published forms, hard "
                 "inputs, which method wins where")
      ->excludes(file);
  add_plugin_options(*command, options->plugins);
  add_accuracy_options(*command, *options);
  command->add_flag("--all-pictures", options->study.renders.every_estimator,
                    "picture every estimator in equal time, not one of each kind");
  command->add_flag("--no-regimes", options->no_regimes,
                    "leave out which method wins where, over the width of light and lobe: a minute "
                    "at the first study");
  command->add_flag("--no-stability", options->no_stability,
                    "try no hard inputs (once for each seed, some seconds, and kept)");
  command->add_flag("--no-self-test", options->no_self_test,
                    "leave out the test of the gate itself (mutants, calibration, power)");
  command->footer(
      "Writes report.html, results.json, CSV, EXR and PNG files, and manifest.json, which lists\n"
      "them.\n"
      "Exit codes: 0 done, 2 usage or input,\n"
      "70 internal error, 71 not enough memory, 128 + N ended by signal N.");
  command->callback([options, command, &exit_code] {
    exit_code = run(*options, option_inputs(*command, {"--measure-again"}));
  });
}

}  // namespace lightproof::cli
