// Every mutant is rejected, by the oracle that it names, and called by its name; and every test of
// the gate has a mutant that it must reject.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <set>
#include <string>

#include "lightproof/cases/adversarial_maps.h"
#include "lightproof/gate/discrete_sampler.h"
#include "lightproof/gate/gate.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/self_test/direction_mutant.h"
#include "lightproof/self_test/kill_matrix.h"
#include "lightproof/self_test/mutant.h"
#include "lightproof/self_test/naming.h"
#include "reference/texel_masses.h"
#include "tests/core/thorough.h"

namespace lightproof {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::StartsWith;

struct Kill {
  TestId test;
  std::string_view mutant;
};

/// For each test of the gate a mutant that it must reject. What samplers must share with
/// linear_scan is tested beside the gate.
constexpr Kill kKills[] = {
    {TestId::bins, "t-flipped-in-both"},
    {TestId::texels, "column-off-by-one"},
    {TestId::rows, "row-off-by-one"},
    {TestId::columns, "u-mirrored"},
    {TestId::worst_texel, "one-texel-moved"},
    {TestId::worst_row, "no-last-row"},
    {TestId::worst_column, "no-last-column"},
    {TestId::phi, "rotated-in-both"},
    {TestId::theta, "no-sine"},
    {TestId::transformed_pair, "texel-centres"},
    {TestId::positions_last_row, "other-rows-at-poles"},
    {TestId::positions_between, "texel-centres"},
    {TestId::independence_lag_1, "s-from-last-t"},
    {TestId::independence_lag_2, "stratified"},
    {TestId::independence_lag_4, "stratified"},
    {TestId::independence_lag_8, "stratified"},
    {TestId::independence_lag_16, "stratified"},
    {TestId::independence_lag_32, "stratified"},
    {TestId::independence_lag_64, "stratified"},
    {TestId::run_sums_theta, "antithetic"},
    {TestId::run_sums_phi, "antithetic"},
    {TestId::pdf_support, "one-texel-missing"},
    {TestId::declared_density, "weights-2-percent-off"},
    {TestId::own_pdf_bins, "uniform-in-sample"},
    {TestId::inverse_pdf, "weights-2-percent-off"},
    {TestId::irradiance_z_mean, "weights-2-percent-off"},
    {TestId::irradiance_x_mean, "weights-2-percent-off"},
    {TestId::irradiance_z_uniform, "pi-squared"},
    {TestId::irradiance_x_uniform, "pi-squared"},
    {TestId::irradiance_z_variance, "noisy-weights"},
    {TestId::irradiance_x_variance, "noisy-weights"},
    {TestId::in_domain, "nan-at-pole"},
    {TestId::positive_density, "abs-of-negative"},
    {TestId::random_bits, "16-bit-random"},
    {TestId::pdf_integral, "pi-squared"},
    {TestId::returned_pdf, "pdf-of-neighbour"},
    {TestId::next_to_one, "cdf-ends-early"},
    {TestId::edge_points, "lower-bound"},
};

/// The full names of the tests that rejected a sampler, and those of their oracles.
std::set<std::string> rejections(const GateResult& result, std::string_view sampler) {
  std::set<std::string> names;
  for (const TestRecord& test : result.tests) {
    if (test.sampler != sampler || test.outcome != Outcome::reject) continue;
    names.insert(full_name(test.test));
    names.insert(std::string(to_string(describe(test.test).oracle)));
  }
  return names;
}

/// What a run of the gate lacks of a mutant's rejection by its oracle, and by the tests that must
/// have a kill of it, under its name; empty if nothing.
std::string lacks(const GateResult& result, const Mutant& mutant) {
  const std::set<std::string> rejecting = rejections(result, mutant.name);
  std::string text;
  if (!rejecting.contains(std::string(to_string(mutant.oracle)))) text += "no kill by its oracle; ";
  for (const Kill& kill : kKills) {
    if (kill.mutant != mutant.name || rejecting.contains(full_name(kill.test))) continue;
    text += "no kill by " + full_name(kill.test) + "; ";
  }
  const std::vector<Rejection>& all = result.rejections;
  const auto rejection = std::find_if(all.begin(), all.end(),
                                      [&](const Rejection& r) { return r.sampler == mutant.name; });
  if (rejection == all.end()) return text + "not rejected";
  if (rejection->looks_like != mutant.diagnosis) text += "looks like " + rejection->looks_like;
  if (rejection->diagnosis.empty()) text += "no diagnosis";
  return text;
}

// With a quarter of the samples that the gate draws unless told otherwise, which suffices for
// almost all, or else with all of them.
TEST(Mutants, AreEachKilledByTheirOracleAndNamed) {
  const EnvironmentMap map = mutant_map();
  std::vector<Mutant> left(mutants().begin(), mutants().end());
  const auto run_on_left = [&](const GateOptions& options) {
    std::vector<SamplerUnderTest> samplers_under_test;
    for (const Mutant& mutant : left)
      samplers_under_test.push_back(sampler_under_test(mutant, DensitySpace::texture));
    return run_gate({&map, 1}, samplers_under_test, options);
  };
  if (!test::is_thorough()) {
    const GateResult result = run_on_left({.samples = GateOptions{}.samples / 4});
    std::erase_if(left, [&](const Mutant& mutant) { return lacks(result, mutant).empty(); });
    EXPECT_LT(left.size(), mutants().size() / 4);
  }
  if (left.empty()) return;
  const GateResult result = run_on_left({});
  for (const Mutant& mutant : left) EXPECT_EQ(lacks(result, mutant), "") << mutant.name;
}

// And under C, with a quarter of these samples: one of them draws B there.
TEST(Mutants, AreEachKilledByTheirOracleAndNamedUnderC) {
  const EnvironmentMap map = mutant_map();
  std::vector<SamplerUnderTest> samplers_under_test;
  for (const Mutant& mutant : mutants())
    samplers_under_test.push_back(sampler_under_test(mutant, DensitySpace::sine_weighted));
  const GateResult result = run_gate({&map, 1}, samplers_under_test, {.samples = 1U << 20U});
  for (const Mutant& mutant : mutants()) {
    SCOPED_TRACE(mutant.name);
    EXPECT_THAT(rejections(result, mutant.name), Contains(std::string(to_string(mutant.oracle))));
    EXPECT_THAT(result.rejections,
                Contains(AllOf(Field(&Rejection::sampler, mutant.name),
                               Field(&Rejection::looks_like, std::string(mutant.diagnosis)))));
  }
}

/// What is said of a mutant under one density.
std::string diagnosis_of(std::string_view mutant_name, DensitySpace density_space) {
  const EnvironmentMap map = mutant_map();
  const auto all = mutants();
  const auto mutant =
      std::find_if(all.begin(), all.end(), [&](const Mutant& m) { return m.name == mutant_name; });
  const std::vector<SamplerUnderTest> one = {sampler_under_test(*mutant, density_space)};
  const GateResult result = run_gate({&map, 1}, one, {.samples = 1U << 18U});
  return result.rejections.empty() ? "" : result.rejections[0].diagnosis;
}

TEST(Diagnosis, OfOneDensityDrawnForAnotherNamesBoth) {
  for (const char* mutant : {"other-measure-in-texel", "other-measure-undeclared"}) {
    SCOPED_TRACE(mutant);
    EXPECT_EQ(diagnosis_of(mutant, DensitySpace::sine_weighted),
              "right texels, but positions inside them are uniform in solid angle, not in (s,t): "
              "the samples fit density B (solid-angle) better");
    EXPECT_EQ(diagnosis_of(mutant, DensitySpace::solid_angle),
              "right texels, but positions inside them are uniform in (s,t), not in solid angle: "
              "the samples fit density C (sine-weighted) better");
    EXPECT_EQ(diagnosis_of(mutant, DensitySpace::texture),
              "right texels, but positions inside them are uniform in solid angle, not in (s,t)");
  }
}

/// The matrix as text: a row for each mutant, the tests that reject it with the samples that they
/// need, as powers of two.
std::string text_of(const std::vector<KillRecord>& records) {
  std::string text;
  for (const KillRecord& record : records) {
    text += fmt::format("{:<27}{:<10}{:<23}", record.mutant, to_string(record.oracle),
                        record.looks_like);
    text += record.sequential ? fmt::format("sequential {}", *record.sequential) : "";
    for (const auto& [test, samples] : record.kills) {
      text += fmt::format(" | {} 2^{:.0f}", full_name(test), std::log2(samples));
    }
    text += "\n";
  }
  return text;
}

// Under density B, and the warps and materials, each with the fewest samples that it takes.
TEST(KillMatrix, EveryMutantIsKilledByItsOracleAndNamed) {
  const std::vector<KillRecord> records = measure_kills({});
  std::printf("%s", text_of(records).c_str());
  EXPECT_EQ(records.size(), mutants().size() + direction_mutants().size());
  for (const KillRecord& record : records) {
    std::set<Oracle> oracles;
    for (const KillRecord::Kill& kill : record.kills) {
      oracles.insert(describe(kill.test).oracle);
    }
    EXPECT_THAT(oracles, Contains(record.oracle)) << record.mutant;
    EXPECT_EQ(record.looks_like, record.expected_diagnosis) << record.mutant;
  }
}

// A map and a billion times as bright a one are the same map, to the gate and to its diagnosis. Not
// to the mutant with an absolute threshold, which is why it is one.
TEST(Mutants, AreJudgedAlikeAtAnyExposure) {
  std::vector<SamplerUnderTest> samplers_under_test;
  for (const Mutant& mutant : mutants()) {
    if (mutant.name != "rows-below-threshold") {
      samplers_under_test.push_back(sampler_under_test(mutant, DensitySpace::solid_angle));
    }
  }
  const auto verdicts_at = [&](float scale) {
    EnvironmentMap map = mutant_map();
    for (Rgb& rgb : map.radiance.values()) rgb *= scale;
    const GateResult result = run_gate({&map, 1}, samplers_under_test, {.samples = 1U << 16U});
    std::vector<std::string> verdicts;
    for (const Rejection& rejection : result.rejections) {
      verdicts.push_back(rejection.sampler + ": " + rejection.looks_like);
    }
    return verdicts;
  };
  const std::vector<std::string> verdicts = verdicts_at(1.0F);
  EXPECT_GT(verdicts.size(), samplers_under_test.size() / 2);
  EXPECT_EQ(verdicts_at(0x1p-30F), verdicts);
  EXPECT_EQ(verdicts_at(0x1p30F), verdicts);
}

// On maps that were not made for it the gate rejects every mutant that does harm there, names nine
// out of ten rightly, and gives one out of fifty a wrong name at most.
TEST(Mutants, AreNamedRightlyOnOtherMapsToo) {
  std::vector<EnvironmentMap> maps;
  for (const char* name : {"sun-sky", "gradient"}) {
    maps.push_back(make_synthetic_map(name, {128, 64}));
  }
  std::vector<SamplerUnderTest> samplers_under_test;
  for (const Mutant& mutant : mutants())
    samplers_under_test.push_back(sampler_under_test(mutant, DensitySpace::texture));
  const GateResult result = run_gate(maps, samplers_under_test, {.samples = 1U << 19U});
  for (const Mutant& mutant : mutants()) {
    if (!mutant.needs.empty()) continue;
    EXPECT_THAT(result.rejections, Contains(Field(&Rejection::sampler, mutant.name)))
        << mutant.name;
  }
  std::size_t right = 0;
  std::size_t wrong = 0;
  std::string names;
  for (const Rejection& rejection : result.rejections) {
    const auto all = mutants();
    const auto mutant = std::find_if(all.begin(), all.end(),
                                     [&](const Mutant& m) { return m.name == rejection.sampler; });
    const bool is_right = mutant->diagnosis == rejection.looks_like;
    right += is_right ? 1 : 0;
    if (is_right || rejection.looks_like == "unknown") continue;
    // Where all columns are alike, a map that is ignored is one whose rows are alike.
    if (rejection.map == "gradient" && rejection.looks_like == "rows-alike") continue;
    ++wrong;
    names += fmt::format("{} on {}: {}\n", rejection.sampler, rejection.map, rejection.looks_like);
  }
  EXPECT_GE(10 * right, 9 * result.rejections.size());
  EXPECT_LE(50 * wrong, result.rejections.size()) << names;
}

using ChangeMasses = void (*)(Grid<double>&, const EnvironmentMap&);

/// Draws other masses than the declared ones, without an alternative that explains them.
SamplerUnderTest sampler_of_masses(std::string name, DensitySpace density_space,
                                   ChangeMasses change) {
  SamplerUnderTest under_test;
  under_test.name = std::move(name);
  under_test.target = {density_space, kRec709};
  under_test.bind = [target = under_test.target, change](const EnvironmentMap& map) {
    Grid<double> masses = reference::texel_masses(map, target);
    change(masses, map);
    const double sum = std::accumulate(masses.values().begin(), masses.values().end(), 0.0);
    for (double& mass : masses.values()) mass /= sum;
    return bound(DiscreteSampler(std::move(masses), target.density_space));
  };
  return under_test;
}

void weigh_rows_by_their_maximum(Grid<double>& masses, const EnvironmentMap& /*map*/) {
  for (int y = 0; y < masses.extent().height; ++y) {
    const auto row = masses.row(y);
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    const double most = *std::max_element(row.begin(), row.end());
    if (sum <= 0.0) continue;
    for (double& mass : row) mass *= most / sum;
  }
}

void brighten_upper_half(Grid<double>& masses, const EnvironmentMap& /*map*/) {
  for (int y = 0; 2 * y < masses.extent().height; ++y) {
    for (double& mass : masses.row(y)) mass *= 1.01;
  }
}

/// All below the first quartile.
void drop_faint_texels(Grid<double>& masses, const EnvironmentMap& map) {
  std::vector<float> greens;
  for (const Rgb& rgb : map.radiance.values()) greens.push_back(rgb.g);
  const auto quartile = greens.begin() + static_cast<std::ptrdiff_t>(greens.size() / 4);
  std::nth_element(greens.begin(), quartile, greens.end());
  for (std::size_t i = 0; i < masses.values().size(); ++i) {
    if (map.radiance.values()[i].g < *quartile) masses.values()[i] = 0.0;
  }
}

/// s times (W-1)/W: as if the last column were the edge of the map.
SamplerUnderTest narrowed_sampler(DensitySpace density_space) {
  SamplerUnderTest under_test;
  under_test.name = "narrowed";
  under_test.target = {density_space, kRec709};
  under_test.bind = [target = under_test.target](const EnvironmentMap& map) {
    const BoundSampler correct =
        bound(DiscreteSampler(reference::texel_masses(map, target), target.density_space));
    const Extent extent = map.radiance.extent();
    return BoundSampler{
        [correct, extent](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
          correct.sample(points, samples);
          for (TexelSample& sample : samples.first(points.size())) {
            sample.at.s *= (extent.width - 1.0) / extent.width;
            sample.x = cell_of(sample.at.s, extent.width);
            sample.pdf = correct.pdf(sample.at);
          }
        },
        correct.pdf};
  };
  return under_test;
}

// A wrong name is worse than none: what no known defect explains is called unknown, and described.
TEST(Diagnosis, OfDefectsOutsideTheListGivesNoNameFromIt) {
  std::vector<EnvironmentMap> maps;
  for (const char* name : {"sun-sky", "gradient"}) {
    maps.push_back(make_synthetic_map(name, {128, 64}));
  }
  std::vector<SamplerUnderTest> samplers_under_test;
  for (const DensitySpace density_space : kDensitySpaces) {
    samplers_under_test.push_back(
        sampler_of_masses("rows by maximum", density_space, weigh_rows_by_their_maximum));
    samplers_under_test.push_back(
        sampler_of_masses("bright upper half", density_space, brighten_upper_half));
    samplers_under_test.push_back(
        sampler_of_masses("no faint texels", density_space, drop_faint_texels));
    samplers_under_test.push_back(narrowed_sampler(density_space));
  }
  const GateResult result = run_gate(maps, samplers_under_test, {.samples = 1U << 20U});
  // On the gradient, whose columns are all alike, rows weighted by their maximum are right: one run
  // of each density is.
  EXPECT_GE(result.rejections.size(), 2 * samplers_under_test.size() - kDensitySpaces.size());
  for (const Rejection& rejection : result.rejections) {
    // Where all columns are alike this is the distribution that lacks the last one.
    if (rejection.sampler == "narrowed" && rejection.map == "gradient") {
      EXPECT_EQ(rejection.looks_like, "no-last-column");
      continue;
    }
    EXPECT_EQ(rejection.looks_like, "unknown")
        << rejection.sampler << " " << rejection.density_space << " on " << rejection.map << ": "
        << rejection.diagnosis << " (" << rejection.confidence << ")";
    EXPECT_THAT(rejection.diagnosis, StartsWith("no known defect explains the samples: "));
  }
}

/// Of these texels, from the brightest on, the one at this share of their number.
template <int kPercent>
void drop_texel_at(Grid<double>& masses, const EnvironmentMap& /*map*/) {
  const auto values = masses.values();
  std::vector<std::size_t> lit;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] > 0.0) lit.push_back(i);
  }
  std::sort(lit.begin(), lit.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(-values[a], a) < std::pair(-values[b], b);
  });
  values[lit[(lit.size() - 1) * kPercent / 100]] = 0.0;
}

// Whichever it is: the pdf names it, and samples enough to be expected there do not come.
TEST(Diagnosis, NamesAnyTexelThatIsNeverDrawn) {
  const EnvironmentMap map = make_synthetic_map("gradient", {64, 32});
  std::vector<SamplerUnderTest> samplers_under_test;
  for (const DensitySpace density_space : kDensitySpaces) {
    samplers_under_test.push_back(
        sampler_of_masses("without the brightest", density_space, drop_texel_at<0>));
    samplers_under_test.push_back(
        sampler_of_masses("without a bright one", density_space, drop_texel_at<10>));
    samplers_under_test.push_back(
        sampler_of_masses("without a faint one", density_space, drop_texel_at<90>));
  }
  const GateResult result = run_gate({&map, 1}, samplers_under_test, {.samples = 1U << 20U});
  ASSERT_EQ(result.rejections.size(), samplers_under_test.size());
  for (const Rejection& rejection : result.rejections) {
    EXPECT_EQ(rejection.looks_like, "one-texel-missing")
        << rejection.sampler << " " << rejection.density_space << ": " << rejection.diagnosis;
  }
}

/// Draws as declared, but says that one faint texel has no density.
SamplerUnderTest sampler_with_a_hole_in_the_pdf() {
  SamplerUnderTest under_test;
  under_test.name = "hole in the pdf";
  under_test.target = {DensitySpace::solid_angle, kRec709};
  under_test.bind = [target = under_test.target](const EnvironmentMap& map) {
    const Grid<double> masses = reference::texel_masses(map, target);
    const Extent extent = masses.extent();
    const auto values = masses.values();
    const auto faintest = std::min_element(values.begin(), values.end(), [](double a, double b) {
      return a > 0.0 && (b <= 0.0 || a < b);
    });
    const auto cell = static_cast<int>(faintest - values.begin());
    const BoundSampler correct = bound(DiscreteSampler(masses, target.density_space));
    return BoundSampler{correct.sample, [correct, extent, cell](SquarePoint at) {
                          const int position = cell_of(at.t, extent.height) * extent.width +
                                               cell_of(at.s, extent.width);
                          return position == cell ? PerSquare{0.0} : correct.pdf(at);
                        }};
  };
  return under_test;
}

// That few samples leave a faint texel empty says nothing.
TEST(Diagnosis, CallsNoTexelMissingWhereNoSampleIsToBeExpected) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {128, 64});
  const std::vector<SamplerUnderTest> samplers_under_test = {sampler_with_a_hole_in_the_pdf()};
  const GateResult result = run_gate({&map, 1}, samplers_under_test, {.samples = 1U << 13U});
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_NE(result.rejections[0].looks_like, "one-texel-missing");
}

TEST(Naming, CountsEveryRejectionByWhatItWasCalled) {
  MapRecord map;
  map.map = make_synthetic_map("sun-sky", {64, 32});
  const auto records = measure_naming({&map, 1}, {.seed = 1, .seeds = 2, .samples = 1U << 14U});
  ASSERT_EQ(records.size(), mutants().size());
  std::uint64_t rejected = 0;
  std::uint64_t right = 0;
  for (const NamingRecord& record : records) {
    EXPECT_EQ(record.runs, 6U);
    EXPECT_LE(record.rejected, record.runs);
    EXPECT_EQ(record.right + record.unknown + record.wrong, record.rejected) << record.mutant;
    EXPECT_EQ(record.wrong == 0, record.wrong_names.empty()) << record.mutant;
    rejected += record.rejected;
    right += record.right;
  }
  EXPECT_GT(rejected, 3 * records.size());
  EXPECT_GE(10 * right, 8 * rejected);
}

TEST(Mutants, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Mutant& mutant : mutants()) names.insert(std::string(mutant.name));
  for (const DirectionMutant& mutant : direction_mutants()) names.insert(mutant.sampler.name);
  EXPECT_EQ(names.size(), mutants().size() + direction_mutants().size());
}

// The discrete sampler that all of them start from. What the gate tests of it is what must have
// a kill.
TEST(Mutants, TheirCorrectParentIsAcceptedByTestsThatEachHaveAKill) {
  const EnvironmentMap map = mutant_map();
  const Mutant correct = {"correct", "none", "", Oracle::reference};
  const std::vector<SamplerUnderTest> samplers_under_test = {
      sampler_under_test(correct, DensitySpace::texture),
      sampler_under_test(correct, DensitySpace::solid_angle),
      sampler_under_test(correct, DensitySpace::sine_weighted)};
  const GateResult result = run_gate({&map, 1}, samplers_under_test, {});
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
  EXPECT_TRUE(result.rejections.empty());
  std::set<TestId> killing;
  for (const Kill& kill : kKills) killing.insert(kill.test);
  for (const TestRecord& test : result.tests) {
    if (test.outcome == Outcome::not_run) continue;
    EXPECT_THAT(killing, Contains(test.test)) << full_name(test.test);
  }
}

}  // namespace
}  // namespace lightproof
