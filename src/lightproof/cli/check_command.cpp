// lightproof check: the gate's verdict on samples that another program drew.
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "common.h"
#include "describe_run.h"
#include "known_names.h"
#include "lightproof/check/density_grid.h"
#include "lightproof/check/direction_dump.h"
#include "lightproof/check/direction_target.h"
#include "lightproof/check/dump_test_case.h"
#include "lightproof/check/given_estimates.h"
#include "lightproof/check/grid_histogram.h"
#include "lightproof/check/recognition.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/dump/sample_dump.h"
#include "lightproof/gate/gate.h"
#include "lightproof/gate/sequential_gate.h"
#include "lightproof/image/largest_channel.h"
#include "lightproof/image/reader.h"
#include "lightproof/results/verdict.h"
#include "side_car.h"
#include "verdict_outputs.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  std::string dump;
  DumpDescription said;
  double pdf_tolerance = DumpClaim{}.pdf_tolerance;
  bool is_sequential = false;
  std::string densities;  ///< a file
  VerdictOutputs outputs;
  GateOptions gate;
};

/// Extensions of pictures of densities; all else is a table.
constexpr std::array<std::string_view, 2> kPictures = {".exr", ".hdr"};

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

std::optional<Preset> preset_named(const std::string& name) {
  if (name.empty()) return std::nullopt;
  const auto preset = preset_by_name(name);
  if (preset) return preset;
  throw InputError(fmt::format("--samples-preset: {} (see `lightproof list presets`)",
                               no_such_name("preset", name, names_of(presets()))));
}

DensityMeasure measure_named(const std::string& name) {
  constexpr std::array<std::pair<const char*, DensityMeasure>, 2> kMeasures = {
      {{"solid-angle", DensityMeasure::solid_angle}, {"square", DensityMeasure::square}}};
  return name.empty() ? DensityMeasure::solid_angle : chosen("--measure", name, kMeasures);
}

/// Image coordinates name directions in Lightproof's axes, whatever the preset.
SampleConvention convention_of(const DumpDescription& said, bool are_directions) {
  SampleConvention convention;
  if (const auto preset = preset_named(said.preset)) {
    convention.preset = *preset;
    if (are_directions) convention.axes = axes_of(*preset);
  }
  if (!said.axes.empty()) convention.axes = AxisMap::parse(said.axes);
  convention.measure = measure_named(said.measure);
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

/// Calls a function, in whose errors the file is named.
template <class Function>
auto named_in_errors(const std::string& file, const Function& function) {
  try {
    return function();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
}

std::shared_ptr<const SampleDump> open_dump(const std::string& file, const DumpDescription& said) {
  const std::vector<std::string> named =
      said.columns.empty() ? std::vector<std::string>() : names_in(said.columns);
  NumberTable table(file, format_of(said.format), named.size());
  return named_in_errors(file, [&] {
    std::vector<std::string> names = named;
    if (names.empty()) {
      names = table.names().empty() ? default_columns(table.columns()) : table.names();
    }
    const SampleColumns columns = sample_columns(names);
    return std::make_shared<const SampleDump>(std::move(table), columns,
                                              convention_of(said, columns.are_directions()));
  });
}

std::string name_of(const std::string& dump) {
  return dump == "-" ? "samples" : std::filesystem::path(dump).stem().string();
}

/// The target of a sampler whose density is its own affair.
constexpr std::string_view kNoTarget = "none";

/// What a dump is held against.
struct Declared {
  std::vector<EnvironmentMap> maps;           ///< at most one
  std::optional<DirectionTarget> directions;  ///< there if no map is
  /// The map in its colours, if `maps` holds a grey one of its largest channel.
  std::optional<EnvironmentMap> colours = {};
  bool has_density = true;  ///< else the samples' density is the sampler's own affair

  const EnvironmentMap& map() const { return maps.front(); }
  const EnvironmentMap& coloured() const { return colours ? *colours : maps.front(); }
};

void load_map(Declared& declared, const Options& options) {
  declared.maps = load_maps(options);
  if (options.luminance != "max") return;
  declared.colours = declared.maps.front();
  declared.maps.front() = map_of_largest_channel(std::move(declared.maps.front()));
}

/// A picture of a density over (phi, theta), whose luminance is in proportion to it per steradian.
constexpr const char* kDensityOfPicture = "B";

/// Says once, by an error, what of the options and the side-car does not go together.
Declared declared_by(Options& options, DumpDescription& said) {
  Declared declared;
  declared.has_density = said.target != kNoTarget;
  if (said.target.empty() || !declared.has_density) {
    if (options.maps.empty()) {
      throw InputError(
          "what were the samples drawn from? --map names an environment map, --target a "
          "distribution over directions (see `lightproof list targets`)");
    }
    if (!declared.has_density && !said.density.empty()) {
      throw InputError("--density declares a density, --target none says that there is none");
    }
    if (!declared.has_density && options.is_sequential) {
      throw InputError(
          "--sequential tests counts against a density: with --target none there is "
          "none");
    }
    load_map(declared, options);
    return declared;
  }
  if (!options.maps.empty()) {
    throw InputError(
        fmt::format("--target {} needs no map: --map says what samples of a light are "
                    "drawn from",
                    terminal_text(said.target)));
  }
  if (!said.density.empty()) {
    throw InputError("--density belongs to --map: the density of a target is its own");
  }
  declared.directions = direction_target(said.target);
  if (declared.directions) return declared;
  std::error_code unreadable;
  if (!std::filesystem::exists(said.target, unreadable) && !is_built_in(said.target)) {
    std::vector<std::string> names = names_of(direction_targets());
    names.emplace_back("none");
    throw InputError(fmt::format("--target: {}, and no such file (see `lightproof list targets`)",
                                 no_such_name("target", said.target, names)));
  }
  options.maps = {said.target};
  said.density = kDensityOfPicture;
  load_map(declared, options);
  return declared;
}

std::vector<Recognition> recognise_in(const SampleDump& dump, const Declared& declared,
                                      const DumpClaim& claim) {
  if (declared.directions) return recognise(dump, *declared.directions);
  const EnvironmentMap& map = declared.map();
  return recognise(
      dump, {&map, on_map(claim.target, map), declared.colours ? &*declared.colours : nullptr});
}

/// The gate over a dump whose density is declared.
GateResult judge_samples(const std::shared_ptr<const SampleDump>& dump, const Declared& declared,
                         const DumpClaim& claim, const GateOptions& gate, const Options& options) {
  const TestCase test_case = declared.directions
                                 ? direction_test_case(dump, *declared.directions, claim)
                                 : dump_test_case(dump, declared.map(), claim);
  if (!options.is_sequential) return run_gate({&test_case, 1}, gate, progress_of(options));
  GateOptions all = gate;
  all.samples = dump->count();
  return run_sequential_gate({&test_case, 1}, all, progress_of(options));
}

/// Adds the tests of given densities and weights.
void add_estimates(GateResult& result, const SampleDump& dump, const Declared& declared,
                   const DumpClaim& claim, double alpha) {
  const EstimateClaim of_estimates = {
      claim.name,
      declared.has_density ? std::string(to_string(claim.target.density_space)) : std::string(),
      !declared.has_density, claim.pdf_tolerance};
  EstimateFindings found = judge_estimates(dump, declared.map(), declared.coloured(), of_estimates,
                                           {alpha, result.must_detect, result.seed});
  std::ranges::move(found.tests, std::back_inserter(result.tests));
  std::ranges::move(found.rejections, std::back_inserter(result.rejections));
}

/// What rows without names hold in a table of densities.
std::vector<std::string> columns_of_densities(std::size_t count) {
  if (count == 3) return {"s", "t", "pdf"};
  if (count == 4) return {"x", "y", "z", "pdf"};
  throw InputError(
      fmt::format("rows of {} numbers without names are no densities: three numbers are s,t,pdf, "
                  "four are x,y,z,pdf; the first line of a text may name others",
                  count));
}

/// What a file of densities holds: a picture, or a table in the conventions of the dump.
DensityGrid read_densities(const Options& options, const DumpDescription& said) {
  const std::string& file = options.densities;
  std::string extension = std::filesystem::path(file).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::ranges::count(kPictures, extension) != 0) {
    ReadOptions read{.any_aspect = true};
    read.preset = preset_named(said.preset);
    return density_grid_of(read_environment_map(file, read), measure_named(said.measure));
  }
  NumberTable table(file, std::nullopt, 0);
  return named_in_errors(file, [&] {
    std::vector<std::string> names = table.names();
    if (names.empty()) names = columns_of_densities(table.columns());
    const SampleColumns columns = sample_columns(names);
    return density_grid_of(
        SampleDump(std::move(table), columns, convention_of(said, columns.are_directions())));
  });
}

/// Adds the tests of densities on a grid of directions. Where no density is declared they are held
/// against the samples, with half of the run's error probability.
void add_densities(GateResult& result, const SampleDump& dump, const Declared& declared,
                   const DumpClaim& claim, const DensityGrid& grid, const TestRecord& record) {
  DeclaredDensity density;
  if (declared.directions) {
    density = declared_density_of(*declared.directions);
  } else if (declared.has_density) {
    density = declared_density_of(std::make_shared<const Expectation>(
        texel_expectation_of(declared.map(), on_map(claim.target, declared.map()))));
  }
  std::vector<TestRecord> found = judge_density_grid(grid, density, claim.pdf_tolerance, record);
  if (!density) {
    found.push_back(judge_grid_histogram(grid, dump, 0.5 * result.family_alpha, record));
  }
  const bool is_rejected = std::ranges::any_of(
      found, [](const TestRecord& test) { return test.outcome == Outcome::reject; });
  std::ranges::move(found, std::back_inserter(result.tests));
  if (!is_rejected) return;
  result.rejections.push_back({record.sampler,
                               record.density_space,
                               record.map,
                               "pdf-mismatch",
                               density ? "the densities on the grid are not the declared ones"
                                       : "the densities on the grid are not those of the samples",
                               Grid<double>(kGateBins),
                               {},
                               ""});
}

Judged judge(const std::shared_ptr<const SampleDump>& dump, const Declared& declared,
             const DumpClaim& claim, const std::optional<DensityGrid>& densities,
             const Options& options) {
  GateOptions gate = spending(options.gate, dump->count());
  gate.seed = options.seed;
  const bool judges_estimates =
      !declared.directions && (!declared.has_density || dump->has_weights());
  const double alpha = gate.family_alpha;
  // What is tested in two ways has half of the error probability for each.
  if (judges_estimates && declared.has_density) gate.family_alpha = 0.5 * alpha;
  Judged judged;
  if (declared.has_density) {
    judged.result = judge_samples(dump, declared, claim, gate, options);
  } else {
    judged.result = {alpha, dump->count(), gate.seed, {}, {}};
    judged.result.must_detect = gate.must_detect;
  }
  judged.result.family_alpha = alpha;
  if (judges_estimates) {
    add_estimates(judged.result, *dump, declared, claim,
                  declared.has_density || densities ? 0.5 * alpha : alpha);
  }
  if (densities) {
    TestRecord record;
    record.sampler = claim.name;
    record.map = declared.directions ? std::string(kDirections) : declared.map().name;
    record.source = declared.directions ? declared.directions->name : declared.map().source;
    if (!declared.directions && declared.has_density) {
      record.density_space = to_string(claim.target.density_space);
    }
    record.seed = options.seed;
    add_densities(judged.result, *dump, declared, claim, *densities, record);
  }
  judged.result.replay = text_of(options.command_line);
  judged.verdict.overall = overall_outcome(judged.result, false);
  if (judged.verdict.overall == Outcome::reject && declared.has_density) {
    judged.result.recognitions = recognise_in(*dump, declared, claim);
  }
  return judged;
}

int run(Options options) {
  const ThreadLimit threads(options.threads);
  const bool stdout_is_taken = check_verdict_outputs(options.outputs);
  DumpDescription of_side_car = read_side_car(options.dump).value_or(DumpDescription{});
  // A map of the command line stands against what else the side-car says that samples come from.
  if (!options.maps.empty() && of_side_car.target != kNoTarget) of_side_car.target.clear();
  // So does a target against its density, which belongs to a map, and a density against its none.
  if (!options.said.target.empty()) of_side_car.density.clear();
  if (!options.said.density.empty() && of_side_car.target == kNoTarget) of_side_car.target.clear();
  DumpDescription said = with_side_car(options.said, of_side_car);
  if (!said.luminance.empty()) options.luminance = said.luminance;
  const Declared declared = declared_by(options, said);
  const DumpClaim claim = {name_of(options.dump), target_of(said), options.pdf_tolerance};
  const auto dump = open_dump(options.dump, said);
  if (!declared.has_density && !dump->has_pdf()) {
    throw InputError(fmt::format(
        "{}: --target none judges the density that comes with every sample: a column pdf is needed",
        terminal_text(options.dump)));
  }
  if (declared.directions && dump->has_weights()) {
    throw InputError(
        fmt::format("{}: weights are held against the light of a map, and --target {} "
                    "has none: name the column -, so that it is not read",
                    terminal_text(options.dump), terminal_text(said.target)));
  }
  std::optional<DensityGrid> densities;
  if (!options.densities.empty()) densities = read_densities(options, said);
  const Judged judged = judge(dump, declared, claim, densities, options);
  print_verdict(options, options.outputs, judged, stdout_is_taken);
  write_verdict(options.outputs, judged,
                declared.colours ? describe_run(options, {&*declared.colours, 1})
                                 : describe_run(options, declared.maps));
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
      ->expected(1);
  command
      .add_option("--target", said.target,
                  "what they are drawn from where it is no map: a distribution over directions, as "
                  "in cosine, phong:50, ggx:0.3@60 (roughness 0.3, seen at 60 degrees to the "
                  "normal, from the side of +x; see `lightproof list targets`), or a picture of a "
                  "density over (phi, theta), its luminance per steradian; none, with --map: the "
                  "density is the sampler's own affair, its pdf and what it estimates are judged")
      ->type_name("NAME|FILE|none");
  command
      .add_option(
          "--columns", said.columns,
          "what a row holds: x,y,z or s,t (from the left, from the bottom of the image) "
          "or u,v (v from the top), pdf, weight or wr,wg,wb (light over pdf), and - for what "
          "is not read; without, the names in the file, or x,y,z,pdf")
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
  command.add_flag("--sequential", options.is_sequential,
                   "test the rows as they come, by evidence that is valid whenever one stops, and "
                   "stop as soon as they are known to be wrong");
  add_path(command, "--densities", options.densities,
           "densities of the sampler on a grid of directions: a table (.npy, .csv) of x,y,z,pdf or "
           "s,t,pdf in the dump's axes and measure, or a picture (.exr, .hdr) whose preset and "
           "measure are the samples': compared with the declared density (without one: with where "
           "samples lie), and integrated");
  add_must_detect(command, options.gate.must_detect);
}

}  // namespace

void add_check(CLI::App& app, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->command_line = line;
  options->allows_max = true;
  CLI::App* command = app.add_subcommand(
      "check", "Test samples that another program drew: do they come from the map?");
  add_dump_options(*command, *options);
  add_shared_options(*command, *options);
  add_verdict_outputs(*command, options->outputs);
  command->footer(
      "A file DUMP.json beside the dump may say what the options say: columns (an array), format,\n"
      "axes, preset, measure, density, luminance, target. The first fifth of the samples screens,\n"
      "the rest confirms. Exit codes: 0 not rejected, 1 rejected, 2 usage or input, 3 inconclusive "
      "(too "
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
