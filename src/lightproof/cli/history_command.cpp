// lightproof history: has it become slower?
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <cstdio>
#include <memory>

#include "common.h"
#include "describe_run.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/history/comparison.h"
#include "lightproof/history/comparison_text.h"
#include "lightproof/history/google_benchmark.h"
#include "lightproof/history/store.h"
#include "lightproof/history/trend_page.h"
#include "messages.h"
#include "outputs.h"

namespace lightproof::cli {
namespace {

struct AddOptions {
  std::vector<std::string> files;
  std::string database;
  std::string commit;
  std::string session;
  bool quiet = false;
};

struct CompareOptions {
  CommandLine command_line;
  std::string base;
  std::string head;
  std::string database;
  std::string json;
  std::string markdown;
  bool github = false;
  bool quiet = false;
};

struct TrendOptions {
  std::string database;
  std::string output;
};

/// "2026-01-31T12:00:00.123456Z": calls of `history add` are sessions of their own.
std::string session_of_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto micro = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  const std::time_t seconds = micro / 1000000;
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  return fmt::format("{}.{:06}Z", text.data(), micro % 1000000);
}

/// All files are read before the first is added: a bad one among them changes nothing.
int add(const AddOptions& options) {
  const std::string session = options.session.empty() ? session_of_now() : options.session;
  std::vector<BenchmarkRun> runs;
  for (const std::string& file : options.files) {
    runs.push_back(read_google_benchmark(file, options.commit));
    runs.back().session = session;
  }
  HistoryStore store = HistoryStore::open_to_write(options.database);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    throw_if_interrupted();
    const std::optional<std::int64_t> id = store.add(runs[i]);
    if (options.quiet) continue;
    if (id) {
      fmt::print("{}: run {} of {}, {} values\n", terminal_text(options.files[i]), *id,
                 terminal_text(runs[i].commit), runs[i].measurements.size());
    } else {
      fmt::print("{}: is there already\n", terminal_text(options.files[i]));
    }
    std::fflush(stdout);
  }
  return kPassed;
}

int compare_commits(const CompareOptions& options) {
  const bool stdout_is_taken =
      check_outputs(std::vector<std::string>{options.json, options.markdown});
  const std::vector<BenchmarkRun> runs = HistoryStore::open_to_read(options.database).runs();
  const Comparison comparison = compare(runs, options.base, options.head);
  std::FILE* const for_people = stdout_is_taken ? stderr : stdout;
  if (!options.quiet) show(for_people, comparison_table(comparison));
  if (options.github) show(for_people, comparison_annotations(comparison));
  write_output(options.json, comparison_json(comparison, describe_run(options.command_line)));
  write_output(options.markdown, comparison_markdown(comparison));
  return count_of(comparison, RowVerdict::regressed) > 0 ? kRejected : kPassed;
}

int trend(const TrendOptions& options) {
  check_outputs(std::vector<std::string>{options.output});
  const std::vector<BenchmarkRun> runs = HistoryStore::open_to_read(options.database).runs();
  write_output(options.output, trend_page(trend_lines(runs), LIGHTPROOF_VERSION));
  return kPassed;
}

void add_database(CLI::App& command, std::string& database) {
  add_path(command, "--db", database, "the history, an SQLite file")->required();
}

void register_add(CLI::App& history, int& exit_code) {
  auto options = std::make_shared<AddOptions>();
  CLI::App* command = history.add_subcommand("add", "Add results of Google Benchmark");
  add_path(*command, "--commit", options->commit,
           "the commit that was measured (default: the one that the file names)")
      ->type_name("TEXT");
  command
      ->add_option("RESULT", options->files,
                   "files of --benchmark_out, one for each process; runs of one call belong to "
                   "one session")
      ->required();
  add_database(*command, options->database);
  add_path(*command, "--session", options->session,
           "the session of interleaved runs that the files belong to (default: a new one)")
      ->type_name("TEXT");
  command->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  command->callback([options, &exit_code] { exit_code = add(*options); });
}

void register_compare(CLI::App& history, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<CompareOptions>();
  options->command_line = line;
  CLI::App* command =
      history.add_subcommand("compare", "Has HEAD become slower than BASE on interleaved runs?");
  command->add_option("BASE", options->base, "commit, or its beginning")->required();
  command->add_option("HEAD", options->head, "commit, or its beginning")->required();
  add_database(*command, options->database);
  add_output(*command, "--json", options->json, "write every row to this file");
  add_output(*command, "--markdown", options->markdown,
             "a table for a pull request or $GITHUB_STEP_SUMMARY");
  command->add_flag("--github", options->github,
                    "print annotations for GitHub Actions: an error for each measurement that "
                    "regressed, a warning for each that is suspected, even if quiet");
  command->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  command->footer(
      "A benchmark has regressed if two sessions in a row find it slower: by a one-sided\n"
      "Mann-Whitney test at .001 and by more than 5 % and three times the A/A noise; or if it\n"
      "executes over 1 % more instructions, or if one of its errors has grown. Slower in one "
      "session\n"
      "alone it is suspected: measure both commits again, as another session. Exit codes: 0 "
      "nothing regressed (though some may "
      "be\nsuspected), 1 regressed, 2 usage or input, 70 internal error, 71 not enough memory.");
  command->callback([options, &exit_code] { exit_code = compare_commits(*options); });
}

void register_trend(CLI::App& history, int& exit_code) {
  auto options = std::make_shared<TrendOptions>();
  CLI::App* command =
      history.add_subcommand("trend", "Every benchmark over commits, as a self-contained page");
  add_database(*command, options->database);
  add_output(*command, "-o,--output", options->output, "the HTML file")->required();
  command->callback([options, &exit_code] { exit_code = trend(*options); });
}

}  // namespace

void add_history(CLI::App& app, const CommandLine& line, int& exit_code) {
  CLI::App* history = app.add_subcommand("history", "Performance over commits: has it got slower?");
  history->require_subcommand(1);
  register_add(*history, exit_code);
  register_compare(*history, line, exit_code);
  register_trend(*history, exit_code);
}

}  // namespace lightproof::cli
