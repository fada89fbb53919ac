// lightproof stability: hard inputs, method by method, and where each method first fails.
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "common.h"
#include "describe_run.h"
#include "lightproof/core/parallel.h"
#include "lightproof/report/report_page.h"
#include "lightproof/report/stability_json.h"
#include "lightproof/report/stability_tables.h"
#include "lightproof/stability/stability.h"
#include "outputs.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  std::vector<std::string> cases;
  std::vector<std::string> methods;
  bool breaking_points = false;
  bool thorough = false;
  std::string json;
  std::string html;
};

bool keeps_claims(const StabilityResult& result) {
  for (const StabilityRecord& record : result.records) {
    if (breaks_claim(record)) return false;
  }
  return true;
}

int run(const Options& options) {
  const ThreadLimit threads(options.threads);
  const std::string outputs[] = {options.json, options.html};
  const bool stdout_is_taken = check_outputs(outputs);
  const StabilityMethods methods = all_stability_methods();
  const StabilityResult result =
      run_stability(methods,
                    {.trial = {.seed = options.seed, .thorough = options.thorough},
                     .cases = options.cases,
                     .methods = options.methods,
                     .breaking_points = options.breaking_points},
                    progress_of(options));
  if (!stdout_is_taken && !options.quiet) {
    for (const std::string& line : stability_lines(result)) fmt::print("{}\n", line);
  }
  const RunDescription run = describe_run(options.command_line);
  write_output(options.json, options.json.empty()
                                 ? std::string()
                                 : stability_json(result, {options.seed, options.thorough}, run));
  write_output(options.html,
               options.html.empty() ? std::string() : stability_page(result, run.version));
  return keeps_claims(result) ? kPassed : kRejected;
}

}  // namespace

void add_stability(CLI::App& app, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->command_line = line;
  CLI::App* command = app.add_subcommand(
      "stability", "Hard inputs, method by method: right, wrong by how much, NaN, out of range");
  command
      ->add_option("--only", options->cases,
                   "a case, by name or number; may be given several times")
      ->type_name("CASE");
  command
      ->add_option("--method", options->methods,
                   "a method: a sampler of maps with or without /A, /B or /C, a material, an "
                   "estimator …; may be given several times")
      ->type_name("NAME");
  command->add_flag("--breaking-points", options->breaking_points,
                    "search for where each method first fails as inputs are made harder");
  command->add_flag("--thorough", options->thorough, "larger inputs, which take minutes");
  add_run_options(*command, *options);
  add_output(*command, "--json", options->json, "write what was found as JSON");
  add_output(*command, "--html", options->html, "write what was found as a page with charts");
  command->footer(
      "Methods are those of the registries; published ones are run as they are listed. Exit "
      "codes:\n"
      "0 every claim is kept, 1 one is not, 2 usage or input, 70 internal error, 71 not enough\n"
      "memory, 128 + N ended by signal N.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
