// lightproof check: the gate's verdict on samples that another program drew.
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "common.h"
#include "describe_run.h"
#include "known_names.h"
#include "lightproof/check/dump_test_case.h"
#include "lightproof/check/recognition.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/dump/sample_dump.h"
#include "lightproof/gate/gate.h"
#include "lightproof/results/verdict.h"
#include "side_car.h"
#include "verdict_outputs.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  std::string dump;
  DumpDescription said;
  double pdf_tolerance = DumpClaim{}.pdf_tolerance;
  VerdictOutputs outputs;
  GateOptions gate;
};

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    names.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

/// What a name stands for; throws InputError, which lists the names, for another one.
template <class Value, std::size_t kCount>
Value chosen(const char* option, const std::string& name,
             const std::array<std::pair<const char*, Value>, kCount>& values) {
  std::string known;
  for (const auto& [its, value] : values) {
    if (name == its) return value;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", its);
  }
  throw InputError(fmt::format("{}: \"{}\" is none of {}", option, terminal_text(name), known));
}

std::optional<NumberFormat> format_of(const std::string& name) {
  if (name.empty()) return std::nullopt;
  constexpr std::array<std::pair<const char*, NumberFormat>, 4> kFormats = {
      {{"npy", NumberFormat::npy},
       {"f32", NumberFormat::floats},
       {"f64", NumberFormat::doubles},
       {"csv", NumberFormat::text}}};
  return chosen("--format", name, kFormats);
}

/// Image coordinates name directions in Lightproof's axes, whatever the preset.
SampleConvention convention_of(const DumpDescription& said, bool are_directions) {
  SampleConvention convention;
  if (!said.preset.empty()) {
    const auto preset = preset_by_name(said.preset);
    if (!preset) {
      throw InputError(fmt::format("--samples-preset: {} (see `lightproof list presets`)",
                                   no_such_name("preset", said.preset, names_of(presets()))));
    }
    convention.preset = *preset;
    if (are_directions) convention.axes = axes_of(*preset);
  }
  if (!said.axes.empty()) convention.axes = AxisMap::parse(said.axes);
  constexpr std::array<std::pair<const char*, DensityMeasure>, 2> kMeasures = {
      {{"solid-angle", DensityMeasure::solid_angle}, {"square", DensityMeasure::square}}};
  if (!said.measure.empty()) convention.measure = chosen("--measure", said.measure, kMeasures);
  return convention;
}

TargetDensity target_of(const DumpDescription& said) {
  if (said.density.empty()) return {DensitySpace::sine_weighted};
  std::string known;
  for (const DensityInfo& density : kDensities) {
    if (density.label == said.density) return {density.density_space};
    known += fmt::format("{}{}", known.empty() ? "" : ", ", density.label);
  }
  throw InputError(
      fmt::format("--density: \"{}\" is none of {}", terminal_text(said.density), known));
}

std::shared_ptr<const SampleDump> open_dump(const std::string& file, const DumpDescription& said) {
  const std::vector<std::string> named =
      said.columns.empty() ? std::vector<std::string>() : names_in(said.columns);
  NumberTable table(file, format_of(said.format), named.size());
  std::vector<std::string> names = named;
  if (names.empty()) {
    names = table.names().empty() ? default_columns(table.columns()) : table.names();
  }
  try {
    const SampleColumns columns = sample_columns(names);
    return std::make_shared<const SampleDump>(std::move(table), columns,
                                              convention_of(said, columns.are_directions()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
}

std::string name_of(const std::string& dump) {
  return dump == "-" ? "samples" : std::filesystem::path(dump).stem().string();
}

Judged judge(const std::shared_ptr<const SampleDump>& dump, const EnvironmentMap& map,
             const DumpClaim& claim, const Options& options) {
  GateOptions gate = spending(options.gate, dump->count());
  gate.seed = options.seed;
  const TestCase test_case = dump_test_case(dump, map, claim);
  Judged judged;
  judged.result = run_gate({&test_case, 1}, gate, progress_of(options));
  judged.result.replay = text_of(options.command_line);
  judged.verdict.overall = overall_outcome(judged.result, false);
  if (judged.verdict.overall == Outcome::reject) {
    judged.result.recognitions = recognise(*dump, map, on_map(claim.target, map));
  }
  return judged;
}

int run(Options options) {
  const ThreadLimit threads(options.threads);
  const bool stdout_is_taken = check_verdict_outputs(options.outputs);
  const DumpDescription said =
      with_side_car(options.said, read_side_car(options.dump).value_or(DumpDescription{}));
  if (!said.luminance.empty()) options.luminance = said.luminance;
  const DumpClaim claim = {name_of(options.dump), target_of(said), options.pdf_tolerance};
  const auto dump = open_dump(options.dump, said);
  const std::vector<EnvironmentMap> maps = load_maps(options);
  const Judged judged = judge(dump, maps.front(), claim, options);
  print_verdict(options, options.outputs, judged, stdout_is_taken);
  write_verdict(options.outputs, judged, describe_run(options, maps));
  return exit_code_of(judged.verdict.overall);
}

void add_dump_options(CLI::App& command, Options& options) {
  DumpDescription& said = options.said;
  command
      .add_option("DUMP", options.dump,
                  "samples, a row each: NumPy's .npy (<f4 or <f8), raw little-endian floats "
                  "(.f32, .f64), text (.csv); - is the standard input")
      ->required();
  command.add_option("--map", options.maps, "the environment map that they are drawn from")
      ->required()
      ->expected(1);
  command
      .add_option("--columns", said.columns,
                  "what a row holds: x,y,z or s,t (from the left, from the bottom of the image) "
                  "or u,v (v from the top), pdf, and - for what is not read; without, the names "
                  "in the file, or x,y,z,pdf")
      ->type_name("NAMES");
  command.add_option("--format", said.format, "npy, f32, f64 or csv, where the name does not tell")
      ->type_name("npy|f32|f64|csv");
  command
      .add_option("--axes", said.axes,
                  "which of the samples' axes Lightproof's x, y and z (up) are, as in x,-z,y")
      ->type_name("AXES");
  command.add_option("--samples-preset", said.preset,
                     "the preset whose image coordinates s, t, u, v are, and whose axes directions "
                     "have; z-up without (see `lightproof list presets`)");
  command
      .add_option("--measure", said.measure,
                  "what the pdf is per: steradian (solid-angle, as without), or the unit square "
                  "of the image (square)")
      ->type_name("solid-angle|square");
  command
      .add_option("--density", said.density,
                  "the density that the samples are declared to have: A, B, or C (as without), "
                  "that of most renderers")
      ->type_name("A|B|C");
  command
      .add_option("--pdf-tolerance", options.pdf_tolerance,
                  "by how much the pdf may differ from the declared density, relative")
      ->check(CLI::Range(1e-12, 1.0))
      ->type_name("E")
      ->capture_default_str();
  add_must_detect(command, options.gate.must_detect);
}

}  // namespace

void add_check(CLI::App& app, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->command_line = line;
  CLI::App* command = app.add_subcommand(
      "check", "Test samples that another program drew: do they come from the map?");
  add_dump_options(*command, *options);
  add_shared_options(*command, *options);
  add_verdict_outputs(*command, options->outputs);
  command->footer(
      "A file DUMP.json beside the dump may say what the options say: columns (an array), format,\n"
      "axes, preset, measure, density, luminance. The first fifth of the samples screens, the "
      "rest\n"
      "confirms. Exit codes: 0 not rejected, 1 rejected, 2 usage or input, 3 inconclusive (too "
      "few\n"
      "samples), 70 internal error, 71 not enough memory, 128 + N ended by signal N.");
  const CLI::Option* luminance = command->get_option("--luminance");
  command->callback([options, luminance, &exit_code] {
    // What stands there without the option says nothing against a side-car.
    if (luminance->count() > 0) options->said.luminance = options->luminance;
    exit_code = run(*options);
  });
}

}  // namespace lightproof::cli
