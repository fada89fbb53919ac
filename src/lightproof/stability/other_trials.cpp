#include "lightproof/stability/other_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/image/map_files.h"
#include "lightproof/image/reader.h"
#include "lightproof/image/writer.h"
#include "lightproof/points/float_decay.h"
#include "lightproof/render/scene.h"
#include "lightproof/stability/hard_maps.h"

namespace lightproof {
namespace {

constexpr Extent kMap = {32, 16};
constexpr std::uint64_t kSamples = 64;

const Scene& nothing() {
  static const Scene scene({false, false});
  return scene;
}

/// The first material that an estimator serves.
const Material& material_for(const EstimatorInfo& method) {
  for (const MaterialInfo& info : materials()) {
    if (method.serves(info.material)) return info.material;
  }
  throw InputError(fmt::format("{} serves no material", method.name));
}

/// What two points in the open reflect, one that looks up and one that looks aside.
std::array<Rgb, 2> reflected(const EstimatorInfo& method, const EnvironmentMap& map,
                             std::uint64_t seed) {
  const BoundEstimator estimator = method.prepare(map).bind(nothing(), material_for(method));
  std::array<Rgb, 2> values;
  const std::array<Direction, 2> normals = {Direction(0.0, 0.0, 1.0), Direction(0.6, 0.0, -0.8)};
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Frame frame = frame_around(normals[i]);
    const ShadingPoint at = {glm::dvec3(0.0), frame, frame.to_world({0.6, 0.0, 0.8})};
    values[i] =
        estimator.integrate(at, RandomStream("stability/estimator", seed), {0, kSamples}, {});
  }
  return values;
}

bool is_radiance(Rgb v) {
  return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b) && v.r >= 0.0F &&
         v.g >= 0.0F && v.b >= 0.0F;
}

std::string text_of(const std::array<Rgb, 2>& values) {
  return fmt::format("({:.5g}, {:.5g}, {:.5g}) and ({:.5g}, {:.5g}, {:.5g})", values[0].r,
                     values[0].g, values[0].b, values[1].r, values[1].g, values[1].b);
}

/// Not a number, or all that is claimed of finite ones.
Finding finite_or_not(const std::array<Rgb, 2>& values, std::string put_in) {
  Finding found{.put_in = std::move(put_in), .came_out = text_of(values)};
  if (!std::ranges::all_of(values, is_radiance)) found.outcome = StabilityOutcome::not_a_number;
  return found;
}

double relative_difference(const std::array<Rgb, 2>& a, const std::array<Rgb, 2>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const auto scale = static_cast<double>(std::max(std::abs(a[i][c]), std::abs(b[i][c])));
      if (scale == 0.0) continue;
      largest = std::max(largest, static_cast<double>(std::abs(a[i][c] - b[i][c])) / scale);
    }
  }
  return largest;
}

/// The picture, row 0 at the top, of a map that is 1 but for one texel.
Grid<Rgb> picture_with(float value) {
  EnvironmentMap map = hard_maps::constant(kMap);
  map.radiance(5, 2) = Rgb(value);
  return flip_rows(map.radiance);
}

MapLevels levels_of(const EnvironmentMap& map) {
  return {.levels = {lat_long_level(map.radiance)}};
}

/// A texel that no radiance can have: the format refuses it, or the reader does, who repairs it on
/// request and says so.
Finding faulty_texel(const MapFormatInfo& method, float value) {
  EnvironmentMap map = hard_maps::constant(kMap);
  map.radiance(5, 2) = Rgb(value);
  check_range("map", method.format, levels_of(map), OutOfRange::refused);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "map.exr";
  write_exr(file, picture_with(value));
  const EnvironmentMap repaired = read_environment_map(file, {.repair = Repair::zero});
  if (repaired.notes.empty() || repaired.radiance(5, 2) != Rgb(0.0F)) {
    return {.outcome = StabilityOutcome::wrong,
            .amount = static_cast<double>(repaired.radiance(5, 2).r),
            .came_out = "not repaired on request, or not reported"};
  }
  read_environment_map(file);
  return {.outcome = StabilityOutcome::wrong, .came_out = "read as it is"};
}

std::string file_of(const MapFormatInfo& method) {
  return map_file_names("map", Projection::lat_long, 1, method.format).front();
}

Finding not_a_map() {
  return {.outcome = StabilityOutcome::not_applicable,
          .came_out = "a picture to look at, in 8 bits of c / (1 + c)"};
}

/// Above this relative error a value counts as lost: the 8-bit mantissa of .hdr leaves less.
constexpr double kToldFrom = 0.01;

double relative_error(float found, float expected) {
  return std::abs(static_cast<double>(found) / static_cast<double>(expected) - 1.0);
}

/// The nearest number that has 11 significant bits and is a multiple of 2^-24, of a positive one: a
/// half float, whose largest is 65504.
float as_half(float single) {
  const auto value = static_cast<double>(single);
  if (value >= 65520.0) return HUGE_VALF;
  const double step = std::max(0x1p-24, std::exp2(std::floor(std::log2(value)) - 10.0));
  return static_cast<float>(std::nearbyint(value / step) * step);
}

/// What a reader gets of a map that was written. KTX 2.0 files, which nothing here reads, hold half
/// floats.
Grid<Rgb> read_back(const MapFormatInfo& method, const EnvironmentMap& map) {
  if (method.format == MapFormat::ktx2) {
    Grid<Rgb> held = map.radiance;
    for (Rgb& v : held.values()) v = {as_half(v.r), as_half(v.g), as_half(v.b)};
    return held;
  }
  const TemporaryFolder folder;
  write_map(folder / "", "map", levels_of(map), method.format);
  return read_environment_map(folder / file_of(method)).radiance;
}

}  // namespace

Finding check_points(const PointSetInfo& method, std::uint64_t first, std::uint64_t window) {
  const AnyPointSet set = method.prepare(kMostPoints);
  std::vector<SquarePoint> points(static_cast<std::size_t>(window));
  fill_points(set, first, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [s, t] = points[i];
    if (s >= 0.0 && s < 1.0 && t >= 0.0 && t < 1.0) continue;
    return {.outcome =
                std::isnan(s + t) ? StabilityOutcome::not_a_number : StabilityOutcome::out_of_range,
            .put_in = fmt::format("index {}", first + i),
            .came_out = fmt::format("({:.9g}, {:.9g})", s, t)};
  }
  const std::uint64_t distinct = float_decay_at(method, first, window).distinct;
  Finding found{.amount = 1.0 - static_cast<double>(distinct) / static_cast<double>(window),
                .put_in = fmt::format("{} points from index {} on", window, first),
                .came_out = fmt::format("{} different points", distinct)};
  if (distinct < window) found.outcome = StabilityOutcome::wrong;
  return found;
}

namespace trials {

Finding black_map(const EstimatorInfo& method, const TrialOptions& options) {
  const auto values = reflected(method, hard_maps::constant(kMap, 0.0F), options.seed);
  Finding found = finite_or_not(values, "a black map");
  if (found.outcome == StabilityOutcome::right && values != std::array{Rgb(0.0F), Rgb(0.0F)}) {
    found.outcome = StabilityOutcome::wrong;
  }
  return found;
}

Finding exposure(const EstimatorInfo& method, const TrialOptions& options) {
  const EnvironmentMap map = hard_maps::lognormal(kMap, 1.0, options.seed);
  const auto plain = reflected(method, map, options.seed);
  // Powers of two change no digit of a radiance, so that the same texels are drawn.
  constexpr float kFactor = 0x1p30F;
  double worst = 0.0;
  for (const float factor : {kFactor, 1.0F / kFactor}) {
    auto other = reflected(method, hard_maps::scaled(map, factor), options.seed);
    for (Rgb& v : other) v /= factor;
    worst = std::max(worst, relative_difference(plain, other));
  }
  Finding found = finite_or_not(plain, "radiances times 2^30 and 2^-30");
  found.amount = worst;
  found.bound = 1e-5;
  found.came_out = fmt::format("the same to {:.2g}", worst);
  if (!(worst <= found.bound)) found.outcome = StabilityOutcome::wrong;
  return found;
}

Finding odd_sizes(const EstimatorInfo& method, const TrialOptions& options) {
  Finding found;
  for (const Extent extent :
       {Extent{1, 1}, Extent{1, 7}, Extent{7, 1}, Extent{2, 1}, Extent{33, 17}}) {
    found = finite_or_not(
        reflected(method, hard_maps::lognormal(extent, 1.0, options.seed), options.seed),
        fmt::format("a map of {}x{}", extent.width, extent.height));
    if (found.outcome != StabilityOutcome::right) return found;
  }
  found.put_in = "maps of 1x1, 1x7, 7x1, 2x1 and 33x17";
  found.came_out = "finite";
  return found;
}

Finding pure_colours(const EstimatorInfo& method, const TrialOptions& options) {
  for (int channel = 0; channel < 3; ++channel) {
    EnvironmentMap map = hard_maps::lognormal(kMap, 1.0, options.seed);
    for (Rgb& v : map.radiance.values()) {
      for (int other = 0; other < 3; ++other) v[other] = other == channel ? v[other] : 0.0F;
    }
    const auto values = reflected(method, map, options.seed);
    Finding found = finite_or_not(values, fmt::format("light in channel {} alone", channel));
    for (const Rgb& v : values) {
      for (int other = 0; other < 3; ++other) {
        if (other == channel || v[other] == 0.0F || std::isnan(v[other])) continue;
        found.outcome = StabilityOutcome::wrong;
      }
    }
    if (found.outcome != StabilityOutcome::right) return found;
  }
  return {.came_out = "finite, and black in the other channels"};
}

Finding denormal_map(const EstimatorInfo& method, const TrialOptions& options) {
  const auto values = reflected(method, hard_maps::constant(kMap, 1e-39F), options.seed);
  Finding found = finite_or_not(values, "1e-39 everywhere");
  // As black, or as it is: no material reflects more than it receives, but estimates scatter.
  for (const Rgb& v : values) {
    if (v.r > 1e-37F) found.outcome = StabilityOutcome::wrong;
  }
  return found;
}

Finding compensated(const EstimatorInfo& method, const TrialOptions& options) {
  if (!method.combined || method.combined->compensation == 0.0) {
    return {.outcome = StabilityOutcome::not_applicable, .came_out = "it compensates nothing"};
  }
  const auto black = reflected(method, hard_maps::constant(kMap, 0.0F), options.seed);
  Finding found = finite_or_not(black, "a black map");
  if (found.outcome != StabilityOutcome::right) return found;
  // Nothing is left of a constant map: what is drawn must be something else, and reach all light.
  const auto constant = reflected(method, hard_maps::constant(kMap), options.seed);
  found = finite_or_not(constant, "a constant map, of which compensation leaves nothing");
  for (const Rgb& v : constant) {
    if (!(v.r > 0.0F)) found.outcome = StabilityOutcome::wrong;
  }
  return found;
}

Finding two_maps(const EstimatorInfo& method, const TrialOptions& options) {
  const EnvironmentMap large = hard_maps::lognormal(kMap, 1.0, options.seed);
  const EnvironmentMap small = hard_maps::lognormal({17, 9}, 1.0, options.seed);
  const auto before = reflected(method, large, options.seed);
  reflected(method, small, options.seed);
  const auto after = reflected(method, large, options.seed);
  Finding found = finite_or_not(after, "a map of 32x16, then one of 17x9, then the first again");
  found.amount = relative_difference(before, after);
  found.came_out = before == after ? "the same bits before and after"
                                   : fmt::format("{}, before {}", text_of(after), text_of(before));
  if (found.outcome == StabilityOutcome::right && before != after) {
    found.outcome = StabilityOutcome::wrong;
  }
  return found;
}

Finding late_frames(const PointSetInfo& method, const TrialOptions& /*options*/) {
  if (method.is_finite) {
    return {.outcome = StabilityOutcome::not_applicable,
            .came_out = "a finite set is even as a whole, not from an index on"};
  }
  Finding found;
  for (const std::uint64_t first : {std::uint64_t{1} << 24U, std::uint64_t{1'000'000'000}}) {
    found = check_points(method, first, kPointWindow);
    if (found.outcome != StabilityOutcome::right) return found;
    // Pearson's statistic of 16 x 16 cells of 256 points each. That of independent points has the
    // mean 255 and the standard deviation sqrt(510); of even ones it is smaller.
    constexpr std::size_t kCells = 16;
    std::vector<SquarePoint> points(kPointWindow);
    fill_points(method.prepare(kMostPoints), first, points);
    std::array<double, kCells * kCells> counts{};
    for (const auto [s, t] : points) {
      counts[static_cast<std::size_t>(t * kCells) * kCells +
             static_cast<std::size_t>(s * kCells)] += 1.0;
    }
    constexpr double kExpected = static_cast<double>(kPointWindow) / (kCells * kCells);
    double statistic = 0.0;
    for (const double count : counts)
      statistic += (count - kExpected) * (count - kExpected) / kExpected;
    found.amount = statistic;
    found.bound = 255.0 + 6.0 * std::sqrt(510.0);
    found.came_out += fmt::format("; chi-square {:.0f} of 255 degrees of freedom", statistic);
    if (!(statistic <= found.bound)) {
      found.outcome = StabilityOutcome::wrong;
      return found;
    }
  }
  return found;
}

Finding all_indices(const PointSetInfo& method, const TrialOptions& options) {
  Finding found;
  const unsigned step = options.thorough ? 1 : 4;
  for (unsigned power = 16; power <= 32; power += step) {
    const std::uint64_t end = std::uint64_t{1} << power;
    found = check_points(method, end - kPointWindow, kPointWindow);
    if (found.outcome != StabilityOutcome::right) return found;
  }
  found.put_in = "windows of 65536 points that end at 2^16 to 2^32";
  found.came_out = "all different, and below 1";
  return found;
}

Finding nan_texel(const MapFormatInfo& method, const TrialOptions& /*options*/) {
  return faulty_texel(method, std::nanf(""));
}

Finding infinite_texel(const MapFormatInfo& method, const TrialOptions& /*options*/) {
  return faulty_texel(method, HUGE_VALF);
}

Finding negative_texel(const MapFormatInfo& method, const TrialOptions& /*options*/) {
  return faulty_texel(method, -1e-3F);
}

Finding small_values(const MapFormatInfo& method, const TrialOptions& /*options*/) {
  if (method.format == MapFormat::png) return not_a_map();
  EnvironmentMap map = hard_maps::constant(kMap);
  map.radiance(3, 3) = Rgb(1e-9F, 1.0F, 1.0F);
  map.radiance(4, 3) = Rgb(1e-7F, 1.0F, 1.0F);
  const MapLevels levels = levels_of(map);
  const std::string told = describe(loss_in(method.format, levels), method.format, levels);
  const double error = std::max(relative_error(read_back(method, map)(3, 3).r, 1e-9F),
                                relative_error(read_back(method, map)(4, 3).r, 1e-7F));
  Finding found{.amount = error,
                .bound = kToldFrom,
                .put_in = "1e-9 and 1e-7 beside 1",
                .came_out = told.empty() ? "nothing reported" : told};
  if (error > kToldFrom && told.empty()) found.outcome = StabilityOutcome::wrong;
  return found;
}

Finding large_values(const MapFormatInfo& method, const TrialOptions& /*options*/) {
  if (method.format == MapFormat::png) return not_a_map();
  EnvironmentMap map = hard_maps::constant(kMap);
  map.radiance(3, 3) = Rgb(1e5F);
  check_range("map", method.format, levels_of(map), OutOfRange::refused);
  const double error = relative_error(read_back(method, map)(3, 3).r, 1e5F);
  Finding found{.amount = error,
                .bound = kToldFrom,
                .put_in = "a value of 1e5",
                .came_out = fmt::format("held to {:.2g}", error)};
  if (!(error <= kToldFrom)) found.outcome = StabilityOutcome::wrong;
  return found;
}

Finding read_twice(const MapFormatInfo& method, const TrialOptions& options) {
  if (method.format == MapFormat::ktx2) {
    return {.outcome = StabilityOutcome::not_applicable, .came_out = "it is written, not read"};
  }
  const TemporaryFolder folder;
  const EnvironmentMap map = hard_maps::lognormal(kMap, 1.0, options.seed);
  write_map(folder / "", "map", levels_of(map), method.format);
  const std::filesystem::path file = folder / file_of(method);
  const EnvironmentMap once = read_environment_map(file);
  const EnvironmentMap twice = read_environment_map(file);
  const bool same = std::ranges::equal(once.radiance.values(), twice.radiance.values());
  return {.outcome = same ? StabilityOutcome::right : StabilityOutcome::wrong,
          .put_in = file_of(method),
          .came_out = same ? "the same pixels" : "other pixels the second time"};
}

}  // namespace trials
}  // namespace lightproof
