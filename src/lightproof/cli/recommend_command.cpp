// lightproof recommend: the least that a scene needs.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <charconv>
#include <cmath>
#include <memory>

#include "common.h"
#include "describe_run.h"
#include "kept_measurements.h"
#include "lightproof/accuracy/method_costs.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/recommend/recommend.h"
#include "lightproof/report/recommendation_json.h"
#include "lightproof/results/percent.h"
#include "outputs.h"
#include "whole_number.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  std::string material;
  std::string receiver = "sphere";
  std::string error;
  double budget_ms = 1.0;
  std::uint64_t memory = 0;  ///< 0: as much as it takes
  std::uint64_t shading_points = MethodDemand{}.shading_points;
  bool no_verify = false;
  bool measure_again = false;
  std::string json;
};

constexpr double kMostError = 10.0;

/// "2%" or "0.02", above 0 and below kMostError.
double error_of(const std::string& text) {
  const bool is_percent = !text.empty() && text.back() == '%';
  const std::string_view number =
      std::string_view(text).substr(0, text.size() - (is_percent ? 1 : 0));
  double error = 0.0;
  const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), error);
  if (is_percent) error /= 100.0;
  const bool is_number = status == std::errc() && end == number.data() + number.size();
  if (!is_number || !(error > 0.0)) {
    throw InputError(
        fmt::format("--error: \"{}\" is no error above 0, as in 2% or 0.02", terminal_text(text)));
  }
  if (error >= kMostError) {
    const std::string meant =
        is_percent ? "" : fmt::format("; {:g} % is written {:g}%", error, error);
    throw InputError(fmt::format("--error: \"{}\" is {:g} %, and errors are below {:g} %{}",
                                 terminal_text(text), 100.0 * error, 100.0 * kMostError, meant));
  }
  return error;
}

std::string samples_text(const RecommendedMethod& method) {
  if (!method.has_samples) return "";
  return method.samples == 1 ? ", 1 sample" : fmt::format(", {} samples", method.samples);
}

/// "of at most 5 % predicted, 4.9 % measured".
std::string errors_text(const RecommendedMethod& method) {
  std::string text = std::isfinite(method.predicted_error)
                         ? fmt::format("{}{} predicted", method.is_upper_bound ? "of at most " : "",
                                       plain_percent(method.predicted_error))
                         : "not predicted";
  if (std::isfinite(method.measured_error)) {
    text += fmt::format(", {} measured", plain_percent(method.measured_error));
  }
  return text;
}

/// "3.1 µs a shading point measured, 3 µs predicted".
std::string times_text(const RecommendedMethod& method) {
  const double predicted = 1e3 * method.predicted_time.point;
  const double measured = 1e3 * method.measured_time.point;
  if (!std::isfinite(measured)) return fmt::format("{:.2g} \u00b5s a shading point", predicted);
  return fmt::format("{:.2g} \u00b5s a shading point measured, {:.2g} \u00b5s predicted", measured,
                     predicted);
}

/// One line: what, its errors, what it takes.
std::string line_of(const RecommendedMethod& method) {
  std::string table;
  if (method.table.width > 0) {
    table = fmt::format(", table of {}x{}", method.table.width, method.table.height);
  }
  return fmt::format("{}{}; error {}; {}, set-up {:.2g} ms, {:.2g} MB{}", method.estimator,
                     samples_text(method), errors_text(method), times_text(method),
                     method.known_time().set_up, 1e-6 * static_cast<double>(method.bytes), table);
}

void print(const Recommendation& recommendation) {
  const RecommendationQuestion& question = recommendation.question;
  fmt::print("{}: for {} error: {}\n", question.map, plain_percent(question.error),
             line_of(recommendation.choice));
  if (recommendation.runner_up) fmt::print("runner-up: {}\n", line_of(*recommendation.runner_up));
  fmt::print("reason: {}\n", recommendation.reason);
  if (!recommendation.warning.empty()) fmt::print("warning: {}\n", recommendation.warning);
  for (const UnpredictedMethod& method : recommendation.unpredicted) {
    fmt::print("not predicted: {}: {}\n", method.estimator, method.reason);
  }
}

int run(const Options& options) {
  const ThreadLimit threads(options.threads);
  RecommendOptions asked = {.receiver = &receiver_by_name(options.receiver),
                            .material = {options.material, material_of(options.material)},
                            .demand = {.error = error_of(options.error),
                                       .budget_seconds = 1e-3 * options.budget_ms,
                                       .shading_points = options.shading_points},
                            .verify = !options.no_verify,
                            .seed = options.seed};
  if (options.memory > 0) asked.demand.memory = options.memory;
  const std::string outputs[] = {options.json};
  const bool stdout_is_taken = check_outputs(outputs);
  const std::vector<EnvironmentMap> maps = load_maps(options);
  require_lat_long(maps.front(), "a recommendation");
  const RunDescription description = describe_run(options, maps);
  const Progress progress = progress_of(options);
  const MethodCosts costs =
      kept_method_costs(asked.material.material, *asked.receiver,
                        kept_measurements(description.commit, options.measure_again), progress)
          .value;
  const Recommendation recommendation = recommend(maps.front(), asked, costs, progress);
  if (!stdout_is_taken) print(recommendation);
  write_output(options.json, recommendation_json(recommendation, description));
  return kPassed;
}

void add_demand(CLI::App& command, Options& options) {
  command
      .add_option("--material", options.material,
                  "a name of `list materials`, phong:N with an exponent, or ggx:R with a roughness")
      ->type_name("NAME")
      ->required();
  command
      .add_option("--error", options.error,
                  "the expected root mean square error over the receiver's pixels, bias included, "
                  "over the mean of the reference: 2% or 0.02")
      ->type_name("E")
      ->required();
  command
      .add_option("--receiver", options.receiver,
                  "what is lit: point, sphere, plane or sphere-on-plane")
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--budget-ms", options.budget_ms,
                  "the most that a shading point may take, in milliseconds, its part of the set-up "
                  "among it")
      ->check(CLI::PositiveNumber)
      ->type_name("T")
      ->capture_default_str();
  add_number(command, "--memory", options.memory, 1, std::uint64_t{1} << 50U,
             fmt::format("the most bytes beside the map; {}", kWholeNumberForms));
  add_number(command, "--shading-points", options.shading_points, 1, std::uint64_t{1} << 50U,
             fmt::format("over which a set-up is shared out; {}", kWholeNumberForms));
}

}  // namespace

void add_recommend(CLI::App& app, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->command_line = line;
  CLI::App* command = app.add_subcommand(
      "recommend", "The cheapest method, number of samples and table that reach an error on a map");
  command->add_option("MAP", options->maps, "environment map: a file, or a name of `list maps`")
      ->required()
      ->expected(1);
  add_demand(*command, *options);
  add_shared_options(*command, *options);
  command->add_flag("--no-verify", options->no_verify, "predict only, run nothing");
  command->add_flag("--measure-again", options->measure_again,
                    "measure what estimators take on this machine anew");
  add_output(*command, "--json", options->json, "write the recommendation as JSON");
  command->footer(
      "What is in the way of light is not predicted, but measured. What estimators take on this\n"
      "machine is measured at the first call, some seconds, and kept. Exit codes: 0 done, 2 usage "
      "or\n"
      "input, or no method reaches the error: what stops each family is told; 70 internal error,\n"
      "71 not enough memory, 128 + N ended by signal N.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
