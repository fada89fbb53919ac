// lightproof precompute: the maps that a real-time engine loads.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "common.h"
#include "describe_run.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/image/map_files.h"
#include "lightproof/precompute/chain_choice.h"
#include "lightproof/precompute/inputs.h"
#include "lightproof/precompute/precompute.h"
#include "lightproof/precompute/snapshots.h"
#include "lightproof/report/contact_sheet.h"
#include "lightproof/report/precompute_json.h"
#include "lightproof/report/precompute_table.h"
#include "lightproof/report/result_folder.h"
#include "messages.h"
#include "outputs.h"
#include "unfinished_run.h"
#include "whole_number.h"

namespace lightproof::cli {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kPreviewName = "preview.html";
constexpr std::string_view kResultsName = "precompute.json";

struct Options : CommonOptions {
  std::string output;
  bool force = false;
  bool resume = false;
  bool clamp = false;
  bool check = false;
  bool snapshots = false;
  std::vector<Product> products;
  std::string product_size;
  std::uint64_t levels = 0;
  std::uint64_t samples = 1024;
  std::uint64_t degree = 8;
  std::uint64_t check_texels = 16;
  std::optional<double> max_error;
  std::string method = "fast";
  std::string projection = "latlong";
  std::string format = "exr";
  std::string masking = "height-correlated";
};

PrecomputeRequest request_of(const Options& options) {
  PrecomputeRequest request;
  request.method = {prefilter_method_by_name(options.method), static_cast<int>(options.samples),
                    static_cast<int>(options.degree)};
  request.projection = *projection_by_name(options.projection);
  request.masking = masking_by_name(options.masking);
  std::vector<Product> wanted = options.products;
  if (wanted.empty()) {
    for (const ProductInfo& info : products()) wanted.push_back(info.product);
  }
  for (const Product product : wanted) {
    ProductRequest& made = request.products.emplace_back(ProductRequest{product});
    const bool is_chain = product == Product::specular || product == Product::reflectivity;
    if (is_chain && options.levels > 0) made.levels = static_cast<int>(options.levels);
    if (!options.product_size.empty() && (is_chain || wanted.size() == 1)) {
      made.extent = parse_size(options.product_size);
    }
  }
  return request;
}

/// Sets the smallest sizes and numbers of levels that reach --max-error, unless --size or --levels
/// says them.
void choose_sizes(const EnvironmentMap& map, const Options& options, PrecomputeRequest& request) {
  if (!options.max_error || !options.product_size.empty() || options.levels > 0) return;
  for (ProductRequest& product : request.products) {
    if (product.product == Product::brdf_map) continue;
    const ChainChoice choice =
        choose_chain(map, request, product.product, *options.max_error, options.seed);
    product.extent = choice.extent;
    product.levels = choice.levels;
    if (options.quiet) continue;
    tell(
        "{}: {}x{} with {} level{}: looked up anywhere, the worst level errs by {:.2g}, the "
        "worst roughness between two levels by {:.2g}\n",
        name_of(product.product), choice.extent.width, choice.extent.height, choice.levels,
        choice.levels == 1 ? "" : "s", choice.look_up_error, choice.roughness_error);
  }
}

/// All files that a request makes, for a look at the folder before the work.
std::set<std::string> file_names(const PrecomputeRequest& request, MapFormat format) {
  std::set<std::string> names = {std::string(kPreviewName), std::string(kResultsName)};
  for (const ProductRequest& product : request.products) {
    const std::string stem(name_of(product.product));
    if (product.product == Product::brdf_map) {
      names.insert(fmt::format("{}.{}", stem, info(brdf_format(format)).name));
      continue;
    }
    const auto levels = static_cast<int>(plan_levels(product, request.projection).size());
    for (const std::string& name : map_file_names(stem, request.projection, levels, format)) {
      names.insert(name);
    }
  }
  return names;
}

void write_maps(Precomputation& made, const Options& options, MapFormat format,
                const fs::path& folder) {
  const OutOfRange out_of_range = options.clamp ? OutOfRange::clamped : OutOfRange::refused;
  for (PrecomputedMap& map : made.maps) {
    const auto levels = static_cast<int>(map.map.levels.size());
    map.files = map_file_names(map.name, map.map.projection, levels, format);
    const FormatLoss loss = loss_in(format, map.map);
    const std::string lost = describe(loss, format, map.map);
    if (!lost.empty()) {
      if (loss.is_refused() && !options.clamp) {
        throw Refusal(fmt::format("{}: {} Take another --format, or --clamp them", map.name, lost),
                      with_flags(options.command_line, {"--clamp", "--resume"}));
      }
      map.notes.push_back(lost);
      if (!options.quiet) tell("{}: {}\n", map.name, terminal_text(lost));
    }
    write_map(folder, map.name, map.map, format, out_of_range);
  }
  if (!made.brdf_map) return;
  const MapFormat own = brdf_format(format);
  made.brdf_map->files = {fmt::format("{}.{}", made.brdf_map->name, info(own).name)};
  write_brdf_map(folder, made.brdf_map->name, made.brdf_map->map, own);
}

/// The frames that have `samples` samples a texel in all.
std::vector<PrecomputedMap> snapshots_of(const EnvironmentMap& map,
                                         const PrecomputeRequest& request, const Options& options,
                                         const Progress& progress) {
  if (!options.snapshots) return {};
  SnapshotOptions snapshots{.seed = options.seed};
  snapshots.frames = std::max(1, request.method.samples / snapshots.samples_per_frame);
  return make_snapshots(map, request, snapshots, progress);
}

std::vector<RunInput> all_inputs(const EnvironmentMap& map, const PrecomputeRequest& request) {
  std::vector<RunInput> inputs = program_inputs();
  for (RunInput& input : inputs_of(map, request)) inputs.push_back(std::move(input));
  return inputs;
}

/// All maps with their errors, as far as these are asked for.
Precomputation make_maps(const EnvironmentMap& map, const PrecomputeRequest& request,
                         const Options& options, const UnfinishedWork& unfinished) {
  const Progress progress = progress_of(options);
  return precompute(map, request, unfinished,
                    {options.check ? options.check_texels : 0, options.seed}, progress);
}

void add_snapshots(const EnvironmentMap& map, const PrecomputeRequest& request,
                   const Options& options, Precomputation& made) {
  const Progress progress = progress_of(options);
  for (PrecomputedMap& snapshot : snapshots_of(map, request, options, progress)) {
    made.maps.push_back(std::move(snapshot));
  }
}

void write_results(Precomputation& made, const Options& options, MapFormat format,
                   const RunDescription& description, Overwriting overwriting) {
  ResultFolder folder(options.output, overwriting);
  write_maps(made, options, format, folder.temporary());
  write_file(folder.temporary() / kPreviewName, contact_sheet(made));
  write_file(folder.temporary() / kResultsName, precompute_json(made, description));
  folder.commit(description);
}

int run(const Options& options) {
  const ThreadLimit threads(options.threads);
  const MapFormat format = *map_format_by_name(options.format);
  PrecomputeRequest request = request_of(options);
  const std::vector<EnvironmentMap> maps = load_maps(options, TexelsOfMaps::lat_long);
  const EnvironmentMap& map = maps.front();
  choose_sizes(map, options, request);
  const RunFolder folder = {options.output, options.force, options.resume};
  const bool replaces = check_run_folder(folder, file_names(request, format), options.command_line);
  UnfinishedWork unfinished = begin_work(folder, all_inputs(map, request), options.command_line);
  const RunDescription description = describe_run(options, maps);
  Precomputation made;
  std::optional<double> worst;
  keeping_parts(unfinished, folder, [&] {
    made = make_maps(map, request, options, unfinished);
    made.version = description.version;
    worst = largest_error(made);
    add_snapshots(map, request, options, made);
    write_results(made, options, format, description, overwriting(replaces));
  });
  unfinished.remove();
  if (!options.quiet) fmt::print("{}", precompute_table(made));
  if (!options.max_error || !worst || *worst <= *options.max_error) return kPassed;
  tell("lightproof: the largest error, {:.3g}, is above --max-error {:.3g}\n", *worst,
       *options.max_error);
  return kRejected;
}

/// "a, b or c" of a registry's names.
template <class Range>
std::vector<std::string> names_of(const Range& range) {
  std::vector<std::string> names;
  for (const auto& item : range) names.emplace_back(item.name);
  return names;
}

void add_products(CLI::App& command, Options& options) {
  for (const ProductInfo& info : products()) {
    command.add_flag_callback(
        fmt::format("--{}", info.name),
        [&options, product = info.product] { options.products.push_back(product); },
        fmt::format("make this map: {}", info.description));
  }
}

void add_shape(CLI::App& command, Options& options) {
  command
      .add_option(
          "--size", options.product_size,
          "WxH of level 0, of one face of a cube; of irradiance and BRDF maps only if "
          "nothing else is made; default 512x256 (faces 128x128), irradiance 64x32 (16x16), "
          "BRDF 256x256")
      ->type_name("WxH");
  add_number(command, "--levels", options.levels, 1, 16,
             "levels of specular maps (default 9, roughness i/(N-1)) and reflectivity maps "
             "(default 7, roughness (i+1/2)/N)");
  command
      .add_option("--projection", options.projection, "latitude-longitude, or the faces of a cube")
      ->check(CLI::IsMember(names_of(projections())))
      ->capture_default_str();
  command.add_option("--format", options.format, "of the files")
      ->check(CLI::IsMember(names_of(map_formats())))
      ->capture_default_str();
  command.add_flag("--clamp", options.clamp,
                   "clamp what the format cannot hold, and say how much; else it is refused");
}

void add_methods(CLI::App& command, Options& options) {
  command.add_option("--method", options.method, "how levels are made")
      ->check(CLI::IsMember(names_of(prefilter_methods())))
      ->capture_default_str();
  add_number(command, "-n,--samples", options.samples, 1, 1U << 24U,
             fmt::format("samples a texel, of methods that sample; {}", kWholeNumberForms));
  add_number(command, "--degree", options.degree, 0, 255,
             "of the method spherical-harmonics: the last degree of the series");
  command.add_flag(
      "--snapshots", options.snapshots,
      "keep irradiance and reflectivity maps as they look after 1, 2, 4 … frames of 16 "
      "samples a texel, up to --samples");
  command
      .add_option("--masking", options.masking,
                  "of the BRDF map: karis, separable or height-correlated")
      ->capture_default_str();
}

void add_checks(CLI::App& command, Options& options) {
  command.add_flag("--check", options.check,
                   "measure every level against quadrature, at texels drawn at random");
  add_number(command, "--check-texels", options.check_texels, 2, 1U << 20U,
             "texels of each level that --check looks at");
  command
      .add_option("--max-error", options.max_error,
                  "with --check, exit with 1 above this error (relative to the map's mean "
                  "radiance); without --size and --levels, take the smallest ones that reach it")
      ->check(CLI::Range(1e-7, 1e3));
}

}  // namespace

void add_precompute(CLI::App& app, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->command_line = line;
  CLI::App* command = app.add_subcommand(
      "precompute", "The maps that a real-time engine loads: irradiance, specular, BRDF");
  add_common_options(*command, *options, "--map-size");
  command->get_option("MAP")->required()->expected(1);
  add_path(*command, "-o,--output", options->output,
           "folder of the maps, which must be new or empty unless --force is given")
      ->required();
  add_force(*command, options->force);
  add_resume(*command, options->resume);
  add_products(*command, *options);
  add_shape(*command, *options);
  add_methods(*command, *options);
  add_checks(*command, *options);
  command->footer(
      "Makes all four maps unless some are named. Writes them, preview.html, precompute.json and\n"
      "manifest.json. Exit codes: 0 done, 1 the error is above --max-error, 2 usage or input,\n"
      "70 internal error, 71 not enough memory, 128 + N ended by signal N.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
