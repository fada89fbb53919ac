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
#include "lightproof/report/report.h"
#include "lightproof/suite/study.h"
#include "lightproof/suite/throughput.h"

namespace lightproof::cli {
namespace fs = std::filesystem;
namespace {

struct Options : CommonOptions {
  std::string output;
  std::string throughput;
  bool no_throughput = false;
  StudyOptions study;
};

/// The folder for the report, made and tried before minutes are spent on it.
fs::path prepare_output(const Options& options) {
  const fs::path folder = options.output.empty() ? "out" : options.output;
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: is not a folder; name another with -o", folder.string()));
  }
  if (options.output.empty() && fs::exists(folder) && !fs::is_empty(folder)) {
    throw InputError(fmt::format(
        "{}: is not empty; say `-o {}` to write over a report in it, or name another folder",
        folder.string(), folder.string()));
  }
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  }
  const PendingFile probe(folder / "report.html");  // throws if nothing can be written here
  return folder;
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
  const fs::path folder = prepare_output(options);
  options.study.benchmarks = benchmark_program(options);
  options.study.gate.seed = options.study.convergence.seed = options.study.renders.seed =
      options.seed;
  StudyResult result;
  {
    const Progress progress = progress_bar(options);
    result = run_study(load_maps(options), options.study, progress);
  }
  if (!options.throughput.empty()) {
    result.throughput = read_throughput(options.throughput);
    result.growth = growth_of(result.throughput);
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
  command->add_option("-o,--output", options->output,
                      "folder of the report (default: out, which must then be empty)");
  command->add_option("-n,--samples", options->study.gate.samples, "samples of each gate test")
      ->check(CLI::Range(std::uint64_t{1024}, std::uint64_t{1} << 40U))
      ->capture_default_str();
  auto* file = command->add_option("--throughput", options->throughput,
                                   "take throughput from this output of lightproof_bench");
  command->add_flag("--no-throughput", options->no_throughput, "leave throughput out")
      ->excludes(file);
  command->footer("Writes report.html, results.json, CSV and EXR files. Exit codes: 0, 2.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
