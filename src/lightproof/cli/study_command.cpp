// lightproof study: the main job.
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>

#include "common.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/pending_file.h"
#include "lightproof/mutants/self_test.h"
#include "lightproof/report/report.h"
#include "lightproof/suite/study.h"

namespace lightproof::cli {
namespace fs = std::filesystem;
namespace {

struct Options : CommonOptions {
  std::string output;
  std::string throughput;
  bool no_throughput = false;
  bool no_self_test = false;
  StudyOptions study;
};

/// The folder for the report. Throws InputError if it may not be written over.
fs::path output_folder(const Options& options) {
  fs::path folder = options.output.empty() ? "out" : options.output;
  std::error_code error;  // what cannot be looked at is reported when it is written to
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw InputError(fmt::format("{}: is not a folder; name another with -o", folder.string()));
  }
  if (options.output.empty() && fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    throw InputError(fmt::format(
        "{}: is not empty; say `-o {}` to write over a report in it, or name another folder",
        folder.string(), folder.string()));
  }
  return folder;
}

/// Makes the folder and tries it, before minutes are spent on what goes there.
void prepare(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  }
  check_writable(folder / "report.html");
}

/// The benchmark program is built beside this one.
std::optional<fs::path> benchmark_program(const Options& options) {
  if (options.no_throughput || !options.throughput.empty()) return std::nullopt;
  std::error_code error;
  const fs::path program =
      fs::read_symlink("/proc/self/exe", error).parent_path() / "lightproof_bench";
  if (!error && fs::exists(program)) return program;
  throw InputError(fmt::format(
      "{}: the benchmark program is not there; give its results with --throughput FILE or leave "
      "them out with --no-throughput",
      program.string()));
}

int run(Options options) {
  const ThreadLimit threads(options.threads);
  const fs::path folder = output_folder(options);
  options.study.benchmarks = benchmark_program(options);
  options.study.gate.seed = options.study.convergence.seed = options.study.renders.seed =
      options.seed;
  Throughput throughput;
  if (!options.throughput.empty()) throughput = read_throughput(options.throughput);
  std::vector<EnvironmentMap> maps = load_maps(options);
  prepare(folder);
  StudyResult result = run_study(std::move(maps), options.study, progress_bar(options));
  result.gate.input_options = input_options(options);
  if (!throughput.samplers.empty()) set_throughput(result, std::move(throughput));
  if (!options.no_self_test) {
    result.self_test = run_self_test(options.seed, progress_bar(options));
  }
  write_report(result, folder);
  if (!options.quiet) fmt::print("{}\n", (folder / "report.html").string());
  return kPassed;
}

}  // namespace

void add_study(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "study", "The main job: gate, convergence, variance, throughput and renders as one report");
  add_common_options(*command, *options);
  add_path(*command, "-o,--output", options->output,
           "folder of the report (default: out, which must then be empty)");
  add_number(*command, "-n,--samples", options->study.gate.samples, 1024, kMostSamples,
             "samples of each gate test");
  auto* file = add_path(*command, "--throughput", options->throughput,
                        "take throughput from this output of lightproof_bench");
  command->add_flag("--no-throughput", options->no_throughput, "leave throughput out")
      ->excludes(file);
  add_number(*command, "--largest", options->study.largest_width, 512, 16384,
             "width of the largest map that throughput is measured on; 16384 takes 8 GB")
      ->excludes(file);
  command->add_flag("--no-self-test", options->no_self_test,
                    "leave out the test of the gate itself (mutants, calibration, power)");
  command->footer(
      "Writes report.html, results.json, CSV, EXR and PNG files.\nExit codes: 0 done, 2 usage or "
      "input,\n70 internal error, 71 not enough memory, 128 + N ended by signal N.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
