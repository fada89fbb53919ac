#include "fixture.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/core/random.h"
#include "measured_fixture.h"

namespace lightproof::testing {
namespace {

const std::array<std::string, 8> kMaps = {
    "city",  "courtyard", "forest",  "interior",
    "night", "studio",    "sunrise", "<script>alert(\"x\")</script>"};
const std::array<std::string, 6> kSamplers = {"binary_search",         "linear_scan",
                                              "linear_scan_published", "alias_table",
                                              "hierarchical_warp",     "uniform"};
const std::array<std::string, 4> kEstimators = {"uniform", "brdf", "environment A",
                                                "environment B"};
const std::array<std::string, 4> kReceivers = {"point up", "point sideways", "sphere", "plane"};

/// Roughly normal, mean 0, variance 1, the same on every run.
double noise(const std::string& name, std::uint64_t index) {
  const RandomStream stream(name, 7);
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const SquarePoint p = stream.point(6 * index + i);
    sum += p.s + p.t;
  }
  return sum - 6.0;
}

double sun(SquarePoint at) {
  const double ds = at.s - 0.3;
  const double dt = at.t - 0.8;
  return 400.0 * std::exp(-(ds * ds * 4.0 + dt * dt) / 0.0008);
}

Rgb sky(SquarePoint at, double mood) {
  const double up = at.t > 0.5 ? 1.0 : 0.25;
  const double base = up * (0.3 + 0.7 * at.t + 0.2 * std::sin(12.0 * at.s + mood));
  const double light = sun(at) / (1.0 + mood);
  return {base * (0.7 + 0.1 * mood) + light, base * 0.8 + 0.95 * light,
          base * (1.3 - 0.1 * mood) + 0.8 * light};
}

MapRecord map_record(std::size_t number) {
  MapRecord record;
  record.map.name = kMaps[number];
  record.map.radiance = Grid<Rgb>(Extent{64, 32});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      record.map.radiance(x, y) =
          sky({(x + 0.5) / 64.0, (y + 0.5) / 32.0}, static_cast<double>(number));
    }
  }
  record.source = kMaps[number] + ".exr";
  // One map comes from an octahedral file.
  record.own_mapping.kind = number == 1 ? MappingKind::octahedral : MappingKind::lat_long;
  record.own_texels = number == 1 ? Extent{32, 32} : Extent{64, 32};
  record.mean_luminance = 0.7 + 0.1 * static_cast<double>(number);
  record.peak_ratio = 480.0 / (1.0 + static_cast<double>(number));
  record.effective_fraction = std::min(0.9, 0.021 * std::exp2(static_cast<double>(number)));
  if (number == 2) record.map.notes = {"3 negative texels set to 0: the first at column 5, row 9"};
  const RandomStream stream("drawn", number);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const SquarePoint p = stream.point(i);
    const bool lit = i % 3 != 0;
    record.drawn.push_back(lit ? SquarePoint{0.3 + 0.04 * (p.s - 0.5), 0.8 + 0.08 * (p.t - 0.5)}
                               : SquarePoint{p.s, 0.5 + 0.5 * p.t});
  }
  return record;
}

TestRecord test_record(const std::string& sampler, const std::string& map, TestId test) {
  TestRecord t = accepted_test(sampler, map);
  t.test = test;
  t.log10_p = -std::abs(noise(sampler + map + full_name(test), 0));
  if (describe(test).oracle == Oracle::check) {
    t.log10_p.reset();
    t.minimum_detectable_effect.reset();
    t.dof = 0.0;
  }
  return t;
}

void spoil(TestRecord& t) {
  if (t.sampler != "linear_scan_published" || t.map != kMaps[7]) return;
  if (t.test != TestId::bins && t.test != TestId::own_pdf_bins && t.test != TestId::in_domain) {
    return;
  }
  t.outcome = Outcome::reject;
  if (t.log10_p) t.log10_p = -41.7;
  t.effect = 0.0312;
  t.statistic = 2417.3;
  t.detail = t.log10_p ? "the last row of texels is drawn 3.1 % too often"
                       : "u = (0, 0) gives x = 64, beyond the last column <63>";
}

GateResult gate() {
  const std::array kinds = {TestId::own_pdf_bins,
                            TestId::bins,
                            TestId::phi,
                            TestId::theta,
                            TestId::irradiance_z_mean,
                            TestId::irradiance_z_variance,
                            TestId::pdf_integral,
                            TestId::in_domain};
  GateResult result{1e-6, 4194304, 20240607, {}};
  result.left_out = {{"hierarchical_warp", "B", kMaps[1], "no such look-up on its texels"}};
  for (const std::string& sampler : kSamplers) {
    for (const char* density_space : {"A", "B"}) {
      if (sampler == "uniform" && density_space[0] == 'B') continue;
      for (const std::string& map : kMaps) {
        const LeftOut& left_out = result.left_out.front();
        if (sampler == left_out.sampler && density_space == left_out.density_space &&
            map == left_out.map) {
          continue;
        }
        for (const auto& kind : kinds) {
          TestRecord t = test_record(sampler, map, kind);
          t.density_space = sampler == "uniform" ? "" : density_space;
          t.known_defect = sampler == "linear_scan_published";
          spoil(t);
          result.tests.push_back(t);
        }
      }
    }
  }
  return result;
}

ConvergenceRecord convergence_record(std::size_t map, std::size_t receiver, std::size_t estimator) {
  const std::array<double, 4> scale = {40.0, 9.0, 1.1, 0.7};
  ConvergenceRecord r;
  r.map = kMaps[map];
  r.receiver = kReceivers[receiver];
  r.material = receiver < 2 ? "Lambert" : "GGX, roughness 0.3";
  r.estimator = kEstimators[estimator];
  r.pixels = 64;
  r.replicates = 32;
  const std::string name = r.map + r.receiver + r.estimator;
  r.predicted_variance = scale[estimator] * std::pow(1.5, static_cast<double>(map)) *
                         (1.0 + 0.3 * static_cast<double>(receiver)) / 6.0;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const std::uint64_t n = std::uint64_t{16} << (2U * i);
    const double predicted = std::sqrt(r.predicted_variance / static_cast<double>(n));
    const double error = 0.015 * predicted;
    r.points.push_back({n, predicted + error * noise(name, i), error, predicted});
  }
  r.slope_error = 0.0022;
  r.slope = -0.5 + r.slope_error * noise(name, 10);
  r.variance_ratio_error = 0.012;
  r.measured_variance = r.predicted_variance * (1.0 + r.variance_ratio_error * noise(name, 11));
  return r;
}

std::vector<ThroughputRecord> throughput() {
  const std::array<double, 3> at_256 = {31.0, 420.0, 18.0};
  const std::array<double, 3> exponents = {0.16, 0.97, 0.05};
  const std::array<std::string, 3> names = {"binary_search", "linear_scan_published",
                                            "alias_table"};
  std::vector<ThroughputRecord> records;
  for (std::size_t s = 0; s < names.size(); ++s) {
    for (int size = 256; size <= 4096; size *= 2) {
      const double ns = at_256[s] * std::pow(size / 256.0, exponents[s]);
      records.push_back({names[s], "sun-sky", Extent{size, size / 2}, ns, 0.94 * ns, 1.11 * ns,
                         4.0 * size * size / 2.0, 1e-5 * size * size});
    }
  }
  return records;
}

std::vector<TableRecord> tables() {
  const Extent extent = {2048, 1024};
  return {{"upper_bound_baseline", "sun-sky", extent, 136.0, 4.0, 1.5e-2, 0.0, 0.0},
          {"binary_search", "sun-sky", extent, 64.0, 4.0, 3.1e-4, 2.3, 0.034},
          {"guide_table", "sun-sky", extent, 6.8, 6.0, 3.1e-4, 21.0, 0.32},
          {"alias_lines", "sun-sky", extent, 8.7, 2.5, 4.9e-4, 16.7, 0.25},
          {"alias", "sun-sky", extent, 4.4, 16.0, 5.5e-8, 32.6, 0.5},
          {"packed_alias", "sun-sky", extent, 4.2, 8.0, 4.7e-4, 35.2, 0.52}};
}

std::vector<DirectionRecord> directions() {
  const Extent extent = {2048, 1024};
  std::vector<DirectionRecord> records;
  for (const char* density : {"A", "B", "C"}) {
    const double slower = *density == 'B' ? 1.1 : 1.0;
    records.push_back(
        {"upper_bound_baseline", "sun-sky", extent, density, DrawOrder::fused, 260.0, 0.0, 0.0});
    records.push_back(
        {"bare_gather_2B", "sun-sky", extent, density, DrawOrder::fused, 3.6, 0.0, 0.0});
    records.push_back({"packed_alias", "sun-sky", extent, density, DrawOrder::fused, 5.2 * slower,
                       50.0 / slower, 0.69 / slower});
    records.push_back(
        {"packed_alias", "sun-sky", extent, density, DrawOrder::scalar, 31.0, 7.5, 0.0, 1.3});
    records.push_back(
        {"guide_table", "sun-sky", extent, density, DrawOrder::fused, 8.0 * slower, 32.5, 0.45});
    records.push_back(
        {"guide_table", "sun-sky", extent, density, DrawOrder::scalar, 58.0, 4.1, 0.0});
  }
  return records;
}

double shade(double x, double y) {
  const double r2 = x * x + y * y;
  return r2 > 1.0 ? 0.0 : 0.2 + std::max(0.0, 0.6 * std::sqrt(1.0 - r2) + 0.5 * y - 0.4 * x);
}

RenderRecord render(std::size_t estimator) {
  const std::array<double, 4> spread = {0.6, 0.25, 0.08, 0.06};
  const Extent size{96, 96};
  RenderRecord r{kMaps[0],
                 "sphere",
                 "GGX, roughness 0.3",
                 kEstimators[estimator],
                 true,
                 64,
                 Grid<Rgb>(size),
                 Grid<Rgb>(size),
                 Grid<double>(size),
                 spread[estimator],
                 0.8 + 0.3 * static_cast<double>(estimator)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double light = shade((x - 47.5) / 44.0, (47.5 - y) / 44.0);
      const double error =
          light * spread[estimator] * noise(r.estimator, static_cast<std::uint64_t>(96 * y + x));
      r.reference(x, y) = Rgb(light, 0.9 * light, 0.75 * light);
      r.error(x, y) = error;
      r.picture(x, y) = r.reference(x, y) * static_cast<float>(std::max(0.0, 1.0 + error));
    }
  }
  return r;
}

SelfTestResult self_test() {
  SelfTestResult result;
  for (const TestId test : {TestId::rows, TestId::irradiance_z_mean, TestId::worst_row}) {
    CalibrationRecord record;
    record.test = test;
    record.is_bound = test == TestId::worst_row;
    record.replicates = 10000;
    for (int i = 0; i <= 100; ++i) {
      const double p = 0.01 * i;
      record.quantiles.push_back(std::min(1.0, record.is_bound ? 1.1 * p : p + 0.01 * p * (1 - p)));
    }
    record.ks_distance = 0.009;
    record.log10_p_ks = -0.6;
    if (!record.is_bound) record.log10_p_anderson = -0.4;
    record.below_one_percent = 97;
    result.calibration.tests.push_back(record);
  }
  result.calibration.families = {{"one stage, Holm", 0.05, 10000, 391},
                                 {"the gate, two stages", 0.05, 1000, 1}};
  for (const std::uint64_t samples : {1024U, 4096U, 16384U}) {
    const double predicted = samples == 1024 ? 0.1 : samples == 4096 ? 0.6 : 0.999;
    const auto rejected = static_cast<std::uint64_t>(1000.0 * predicted);
    result.power.push_back({TestId::rows, 0.12, 1e-3, samples, 1000, rejected, predicted});
    result.power.push_back({TestId::phi, 0.1, 1e-3, samples, 1000, 1000, predicted, true});
  }
  result.naming = {
      {.mutant = "no-sine", .expected = "no-sine", .runs = 48, .rejected = 48, .right = 48},
      {.mutant = "sine-at-edge",
       .expected = "sine-at-edge",
       .runs = 48,
       .rejected = 40,
       .right = 36,
       .unknown = 2,
       .wrong = 2,
       .wrong_names = {"uneven-in-texel"}}};
  result.mutants = {{"no-sine",
                     Oracle::reference,
                     "other-density",
                     "other-density",
                     {{TestId::rows, 4096}, {TestId::irradiance_z_variance, 65536}},
                     1024},
                    {"pi-squared",
                     Oracle::check,
                     "pdf-scaled",
                     "pdf-scaled",
                     {{TestId::pdf_integral, 4096}},
                     {}}};
  result.origin = "2024-06-07T13:41:08+00:00, synthetic processor, GNU 12.2.0";
  result.naming_origin = "2024-06-08T13:41:08+00:00, synthetic processor, GNU 12.2.0";
  return result;
}

/// 3 x 2 cases on every map, 100 times as wrong at the grazing view as along the normal.
std::vector<SplitSumRecord> split_sum() {
  std::vector<SplitSumRecord> records;
  for (std::size_t map = 0; map < kMaps.size(); ++map) {
    for (const double f0 : {0.04, 1.0}) {
      for (const double roughness : {0.2, 0.6, 1.0}) {
        const double along = 0.001 * (1.0 + static_cast<double>(map)) * (1.2 - roughness);
        records.push_back({kMaps[map], roughness, 0.0, f0, along, 0.0});
        records.push_back({kMaps[map], roughness, 80.0 * kPi / 180.0, f0, 100.0 * along,
                           roughness < 0.5 ? 80.0 * along : 0.0});
      }
    }
  }
  return records;
}

/// A falling line, or a point if it has one.
AccuracyLine accuracy_line(const char* estimator, EstimatorFamily family, double error,
                           double seconds, bool is_biased) {
  AccuracyLine line;
  line.estimator = estimator;
  line.family = family;
  line.is_biased = is_biased;
  line.set_up_seconds = 0.02;
  line.set_up_processor_seconds = 0.03;
  line.bytes = 3163136;
  if (is_biased) {
    line.floor = error;
    line.points = {{1, seconds, error, 0.0}};
    return line;
  }
  for (const std::uint64_t samples : {1, 4, 16, 64, 256, 1024, 4096}) {
    const double n = static_cast<double>(samples);
    const double rmse = error / std::sqrt(n);
    line.points.push_back({samples, seconds * (1.0 + 0.2 * n), 1.01 * rmse, 0.03 * rmse, rmse});
  }
  line.slope = -0.5;
  line.slope_error = 0.01;
  return line;
}

/// Two receivers on every map. The uniform estimator finds light by rare hits.
std::vector<AccuracyChart> accuracy() {
  std::vector<AccuracyChart> charts;
  for (std::size_t map = 0; map < kMaps.size(); ++map) {
    for (const char* receiver : {"sphere", "sphere-on-plane"}) {
      const double scale = 1.0 + static_cast<double>(map);
      AccuracyChart chart;
      chart.map = kMaps[map];
      chart.receiver = receiver;
      chart.material = "ggx:0.3";
      chart.is_occluded = receiver == std::string("sphere-on-plane");
      chart.shading_points = 29;
      chart.replicates = 3;
      chart.quality = "draft";
      chart.mean = 1.1;
      chart.lines = {
          accuracy_line("uniform", EstimatorFamily::uniform, 30.0 * scale, 2e-7, false),
          accuracy_line("brdf", EstimatorFamily::lobes, 2.0 * scale, 3e-7, false),
          accuracy_line("environment B", EstimatorFamily::environment, 1.0, 5e-7, false),
          accuracy_line("environment B sobol", EstimatorFamily::points, 0.5, 5e-7, false),
          accuracy_line("environment B alias sobol", EstimatorFamily::points, 0.8, 4e-7, false),
          accuracy_line("mis balance", EstimatorFamily::mis, 0.8, 6e-7, false),
          accuracy_line("split-sum", EstimatorFamily::precomputed, 0.08 * scale, 8e-8, true)};
      chart.lines[0].points[0].rmse_error = 20.0 * scale;
      chart.lines[3].slope = -0.8;
      chart.left_out = {{"sh-9", "it does not serve this material"}};
      charts.push_back(std::move(chart));
    }
  }
  return charts;
}

/// What `lightproof recommend` would say of the first two maps.
std::vector<Recommendation> recommendations() {
  std::vector<Recommendation> all(2);
  Recommendation& first = all[0];
  first.question = {kMaps[0], "sphere", "ggx:0.3", 0.05, 307200};
  first.choice = {
      "environment B alias", 64,          true, 3163136, {512, 256}, 0.048, false, 0.049, 0.002,
      {0.011, 7.5},          {0.012, 8.1}};
  first.runner_up = RecommendedMethod{"split-sum", 1, false, 3163136, {}, 0.05};
  first.runner_up->predicted_time = {0.0004, 31.0};
  first.reason = "Small lights rule this map, and the material is rough.";
  first.unreached = {{EstimatorFamily::precomputed, "its floor is 8 %"}};
  all[1] = all[0];
  all[1].question.map = kMaps[7];
  all[1].runner_up.reset();
  all[1].choice.measured_time = {};
  all[1].unpredicted = {{"riemann", "its error depends on where its steps fall"}};
  all[1].choice.measured_error = std::nan("");
  all[1].warning = "The error was not measured.";
  return all;
}

/// One answer that is as it should be, one that is slow, one that is rightly refused.
RecommendationSurvey survey() {
  RecommendationSurvey made = {"2024-06-07T13:41:08+00:00", "sphere", "default", {}};
  const SurveyedChoice choice = {"brdf", 24, 0.05, 0.049, 0.051, 2e-6};
  made.cases = {{kMaps[0], "lambert", 0.05, choice, "brdf", 1.9e-6, true},
                {kMaps[7], "lambert", 0.05, choice, "sh-9", 1e-6, false},
                {kMaps[7], "lambert", 0.01, std::nullopt, "", 0.0, false}};
  return made;
}

/// Look-ups win in wide light, and reach nothing in narrow light.
MethodRegimes method_regimes() {
  MethodRegimes regimes{0.05, {}, "2024-06-07T13:41:08+00:00"};
  for (const double roughness : {0.1, 0.3, 1.0}) {
    regimes.regimes.push_back(
        {roughness, 0.4, "split-sum", EstimatorFamily::precomputed, 1e-7, "brdf", 4e-6});
    regimes.regimes.push_back({roughness, 0.002, "environment B", EstimatorFamily::environment,
                               9e-6, roughness < 0.2 ? "" : "environment B", 9e-6});
  }
  return regimes;
}

/// A grid that stays as it is, and one whose columns change places.
std::vector<WarpGrid> warps() {
  std::vector<WarpGrid> grids;
  for (std::size_t map = 0; map < 2; ++map) {
    for (const bool is_monotone : {true, false}) {
      WarpGrid grid{kMaps[map], is_monotone ? "binary_search" : "alias", is_monotone, 8, {}, 3.0};
      for (int i = 0; i < 64; ++i) {
        const int column = is_monotone ? i % 8 : i * 3 % 8;
        const int row = i / 8;
        grid.points.push_back({(column + 0.5) / 8.0, (row + 0.5) / 8.0});
      }
      if (!is_monotone) grid.neighbour_degrees = map == 0 ? 12.0 : 45.0;
      grids.push_back(grid);
    }
  }
  return grids;
}

PublishedPicture published_picture() {
  const Extent extent = {32, 24};
  PublishedPicture picture;
  picture.system = "004-2";
  picture.what = "a sphere <for a test>";
  picture.published_form = "c times pi";
  picture.corrected_form = "c over pi";
  picture.exact_form = "as it is";
  picture.exact = Grid<Rgb>(extent, Rgb(0.5F));
  picture.published = Grid<Rgb>(extent, Rgb(4.9F));
  picture.corrected = Grid<Rgb>(extent, Rgb(0.51F));
  picture.published_error = Grid<double>(extent, 8.8);
  picture.corrected_error = Grid<double>(extent, 0.02);
  picture.published_rmse = 8.8;
  picture.corrected_rmse = 0.02;
  picture.noise = 0.011;
  return picture;
}

}  // namespace

TestRecord accepted_test(const std::string& sampler, const std::string& map) {
  return {sampler, "B",    map,    TestId::bins,    4194304, 1031.2, 1023.0,
          -0.37,   0.0157, 0.0186, Outcome::accept, "",      false};
}

StudyResult synthetic_study() {
  StudyResult study;
  study.version = "0.1.0 (synthetic, for a test)";
  study.machine = "2 \u00d7 synthetic processor, g++ 12.2, -O3";
  study.seed = 20240607;
  for (std::size_t i = 0; i < kMaps.size(); ++i) study.maps.push_back(map_record(i));
  study.gate = gate();
  study.directions_origin = "2024-06-07T13:40:31+00:00, synthetic processor, GNU 12.2.0";
  for (std::size_t map = 0; map < 8; ++map) {
    for (std::size_t receiver = 0; receiver < 4; ++receiver) {
      for (std::size_t estimator = 0; estimator < 4; ++estimator) {
        study.convergence.push_back(convergence_record(map, receiver, estimator));
      }
    }
  }
  study.accuracy = accuracy();
  study.recommendations = recommendations();
  study.refused_recommendations = {
      {{kMaps[3], "sphere", "ggx:0.3", 0.05, 307200},
       {{EstimatorFamily::lobes, "brdf needs 2e+05 samples, of 65536 at most"}}}};
  study.recommendation_survey = survey();
  study.method_regimes = method_regimes();
  study.warps = warps();
  study.throughput = throughput();
  study.tables = tables();
  study.directions = directions();
  const Extent small = {256, 128};
  const Extent large = {4096, 2048};
  study.caches = {1048576.0, 33554432.0};
  study.growth = {{"binary_search", "log2 S + log2 T", 0.161, 0.004, {{small, 1.5}, {large, 1.9}}},
                  {"linear_scan_published", "S + T", 0.968, 0.012, {{small, 0.71}, {large, 0.68}}},
                  {"alias_table", "constant", 0.052, 0.008, {{small, 9.0}, {large, 11.0}}}};
  for (GrowthFit& fit : study.growth) {
    fit.leaves_l2 = {1024, 512};
    fit.build_exponent = {1.0, 0.012};
  }
  study.growth[0].leaves_l3 = {4096, 2048};
  study.growth[0].segmented = {0.02, {{{512, 256}, 0.31}, {{1024, 512}, 0.12}}, 0.0021};
  for (std::size_t estimator = 0; estimator < 4; ++estimator)
    study.renders.push_back(render(estimator));
  study.self_test = self_test();
  study.frames = synthetic_frames();
  study.stability = synthetic_stability();
  study.points = synthetic_points();
  study.level_costs = synthetic_level_costs();
  study.published_forms = {{"004-2", "factor of the diffuse term", 1.0, 9.8696, 1.0}};
  study.published_pictures = {published_picture()};
  study.split_sum = split_sum();
  return study;
}

}  // namespace lightproof::testing
