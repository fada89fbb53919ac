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

#include "lightproof/image/synthetic.h"
#include "lightproof/mutants/direction_mutant.h"
#include "lightproof/mutants/kill_matrix.h"
#include "lightproof/mutants/mutant.h"
#include "lightproof/mutants/naming.h"
#include "lightproof/suite/gate.h"
#include "lightproof/suite/law_sampler.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

using testing::Contains;
using testing::Field;
using testing::StartsWith;

struct Kill {
  std::string_view oracle;
  std::string_view test;
  std::string_view mutant;
};

/// For each test of the gate a mutant that it must reject. What samplers must share with
/// linear_scan is tested beside the gate.
constexpr Kill kKills[] = {
    {"reference", "bins 16x32", "t-flipped-in-both"},
    {"reference", "texels", "column-off-by-one"},
    {"reference", "rows", "row-off-by-one"},
    {"reference", "columns", "u-mirrored"},
    {"reference", "worst texel", "one-texel-moved"},
    {"reference", "worst row", "no-last-row"},
    {"reference", "worst column", "no-last-column"},
    {"reference", "phi (Kuiper)", "rotated-in-both"},
    {"reference", "theta (Anderson-Darling)", "no-sine"},
    {"reference", "transformed pair", "texel-centres"},
    {"reference", "positions in the last row", "other-rows-at-poles"},
    {"reference", "positions between the pole rows", "texel-centres"},
    {"reference", "independence at lag 1", "s-from-last-t"},
    {"reference", "independence at lag 2", "stratified"},
    {"reference", "independence at lag 4", "stratified"},
    {"reference", "independence at lag 8", "stratified"},
    {"reference", "independence at lag 16", "stratified"},
    {"reference", "independence at lag 32", "stratified"},
    {"reference", "independence at lag 64", "stratified"},
    {"reference", "sums over runs of 16, theta", "antithetic"},
    {"reference", "sums over runs of 16, phi", "antithetic"},
    {"check", "support of the pdf", "one-texel-missing"},
    {"check", "pdf is the declared density", "weights-2-percent-off"},
    {"self", "bins 16x32 of its own pdf", "uniform-in-sample"},
    {"self", "mean of 1/pdf", "weights-2-percent-off"},
    {"mean", "irradiance, normal +z", "weights-2-percent-off"},
    {"mean", "irradiance, normal +x", "weights-2-percent-off"},
    {"mean", "irradiance, normal +z, against uniform", "pi-squared"},
    {"mean", "irradiance, normal +x, against uniform", "pi-squared"},
    {"variance", "irradiance, normal +z", "noisy-weights"},
    {"variance", "irradiance, normal +x", "noisy-weights"},
    {"check", "samples stay on the map", "nan-at-pole"},
    {"check", "no dark texel is drawn", "abs-of-negative"},
    {"check", "random numbers have more than 20 bits", "16-bit-random"},
    {"check", "pdf integrates to 1", "pi-squared"},
    {"check", "pdf of the sample", "pdf-of-neighbour"},
    {"check", "u next to 1", "cdf-ends-early"},
    {"check", "edges of u", "lower-bound"},
};

std::string key(std::string_view oracle, std::string_view test) {
  return std::string(oracle) + "/" + std::string(test);
}

/// The tests that rejected a sampler, as "oracle/test", and the oracles alone.
std::set<std::string> rejections(const GateResult& result, std::string_view sampler) {
  std::set<std::string> names;
  for (const TestRecord& test : result.tests) {
    if (test.sampler != sampler || test.outcome != Outcome::reject) continue;
    names.insert(key(test.oracle, test.test));
    names.insert(test.oracle);
  }
  return names;
}

/// With as many samples as the gate draws unless told otherwise.
TEST(Mutants, AreEachKilledByTheirOracleAndNamed) {
  const EnvironmentMap map = hostile_map();
  std::vector<Subject> subjects;
  for (const Mutant& mutant : mutants()) subjects.push_back(subject_of(mutant, Weighting::A));
  const GateResult result = run_gate({&map, 1}, subjects, {});
  for (const Mutant& mutant : mutants()) {
    SCOPED_TRACE(mutant.name);
    const std::set<std::string> rejecting = rejections(result, mutant.name);
    EXPECT_THAT(rejecting, Contains(std::string(mutant.oracle)));
    const std::vector<Rejection>& all = result.rejections;
    const auto rejection = std::find_if(
        all.begin(), all.end(), [&](const Rejection& r) { return r.sampler == mutant.name; });
    ASSERT_NE(rejection, all.end());
    EXPECT_EQ(rejection->looks_like, mutant.diagnosis);
    EXPECT_FALSE(rejection->diagnosis.empty());
    for (const Kill& kill : kKills) {
      if (kill.mutant != mutant.name) continue;
      EXPECT_THAT(rejecting, Contains(key(kill.oracle, kill.test)));
    }
  }
}

/// The matrix as text: a row for each mutant, the tests that reject it with the samples that they
/// need, as powers of two.
std::string text_of(const std::vector<KillRecord>& records) {
  std::string text;
  for (const KillRecord& record : records) {
    text += fmt::format("{:<27}{:<10}{:<23}", record.mutant, record.oracle, record.looks_like);
    text += record.sequential ? fmt::format("sequential {}", *record.sequential) : "";
    for (const auto& [test, samples] : record.kills) {
      text += fmt::format(" | {} 2^{:.0f}", test, std::log2(samples));
    }
    text += "\n";
  }
  return text;
}

// Under weighting B, and the warps and materials, each with the fewest samples that it takes.
TEST(KillMatrix, EveryMutantIsKilledByItsOracleAndNamed) {
  const std::vector<KillRecord> records = measure_kills(1);
  std::printf("%s", text_of(records).c_str());
  EXPECT_EQ(records.size(), mutants().size() + direction_mutants().size());
  for (const KillRecord& record : records) {
    std::set<std::string> oracles;
    for (const KillRecord::Kill& kill : record.kills) {
      oracles.insert(kill.test.substr(0, kill.test.find('/')));
    }
    EXPECT_THAT(oracles, Contains(record.oracle)) << record.mutant;
    EXPECT_EQ(record.looks_like, record.expected_diagnosis) << record.mutant;
  }
}

// A map and a billion times as bright a one are the same map, to the gate and to its diagnosis. Not
// to the mutant with an absolute threshold, which is why it is one.
TEST(Mutants, AreJudgedAlikeAtAnyExposure) {
  std::vector<Subject> subjects;
  for (const Mutant& mutant : mutants()) {
    if (mutant.name != "rows-below-threshold") {
      subjects.push_back(subject_of(mutant, Weighting::B));
    }
  }
  const auto verdicts_at = [&](float scale) {
    EnvironmentMap map = hostile_map();
    for (Rgb& rgb : map.radiance.values()) rgb *= scale;
    const GateResult result = run_gate({&map, 1}, subjects, {.samples = 1U << 16U});
    std::vector<std::string> verdicts;
    for (const Rejection& rejection : result.rejections) {
      verdicts.push_back(rejection.sampler + ": " + rejection.looks_like);
    }
    return verdicts;
  };
  const std::vector<std::string> verdicts = verdicts_at(1.0F);
  EXPECT_GT(verdicts.size(), subjects.size() / 2);
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
  std::vector<Subject> subjects;
  for (const Mutant& mutant : mutants()) subjects.push_back(subject_of(mutant, Weighting::A));
  const GateResult result = run_gate(maps, subjects, {.samples = 1U << 19U});
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
Subject subject_of_masses(std::string name, Weighting weighting, ChangeMasses change) {
  Subject subject;
  subject.name = std::move(name);
  subject.target = {weighting, kRec709};
  subject.bind = [target = subject.target, change](const EnvironmentMap& map) {
    Grid<double> masses = reference::texel_masses(map, target);
    change(masses, map);
    const double sum = std::accumulate(masses.values().begin(), masses.values().end(), 0.0);
    for (double& mass : masses.values()) mass /= sum;
    return bound(LawSampler(std::move(masses), target.weighting));
  };
  return subject;
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
Subject narrowed_subject(Weighting weighting) {
  Subject subject;
  subject.name = "narrowed";
  subject.target = {weighting, kRec709};
  subject.bind = [target = subject.target](const EnvironmentMap& map) {
    const BoundSampler sound =
        bound(LawSampler(reference::texel_masses(map, target), target.weighting));
    const Extent extent = map.radiance.extent();
    return BoundSampler{
        [sound, extent](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
          sound.sample(points, samples);
          for (TexelSample& sample : samples.first(points.size())) {
            sample.at.s *= (extent.width - 1.0) / extent.width;
            sample.x = cell_of(sample.at.s, extent.width);
            sample.pdf = sound.pdf(sample.at);
          }
        },
        sound.pdf};
  };
  return subject;
}

// A wrong name is worse than none: what no known defect explains is called unknown, and described.
TEST(Diagnosis, OfDefectsOutsideTheListGivesNoNameFromIt) {
  std::vector<EnvironmentMap> maps;
  for (const char* name : {"sun-sky", "gradient"}) {
    maps.push_back(make_synthetic_map(name, {128, 64}));
  }
  std::vector<Subject> subjects;
  for (const Weighting weighting : {Weighting::A, Weighting::B}) {
    subjects.push_back(
        subject_of_masses("rows by maximum", weighting, weigh_rows_by_their_maximum));
    subjects.push_back(subject_of_masses("bright upper half", weighting, brighten_upper_half));
    subjects.push_back(subject_of_masses("no faint texels", weighting, drop_faint_texels));
    subjects.push_back(narrowed_subject(weighting));
  }
  const GateResult result = run_gate(maps, subjects, {.samples = 1U << 20U});
  EXPECT_GE(result.rejections.size(), 2 * subjects.size() - 2);
  for (const Rejection& rejection : result.rejections) {
    // Where all columns are alike this is the law that lacks the last one.
    if (rejection.sampler == "narrowed" && rejection.map == "gradient") {
      EXPECT_EQ(rejection.looks_like, "no-last-column");
      continue;
    }
    EXPECT_EQ(rejection.looks_like, "unknown")
        << rejection.sampler << " " << rejection.weighting << " on " << rejection.map << ": "
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
  std::vector<Subject> subjects;
  for (const Weighting weighting : {Weighting::A, Weighting::B}) {
    subjects.push_back(subject_of_masses("without the brightest", weighting, drop_texel_at<0>));
    subjects.push_back(subject_of_masses("without a bright one", weighting, drop_texel_at<10>));
    subjects.push_back(subject_of_masses("without a faint one", weighting, drop_texel_at<90>));
  }
  const GateResult result = run_gate({&map, 1}, subjects, {.samples = 1U << 20U});
  ASSERT_EQ(result.rejections.size(), subjects.size());
  for (const Rejection& rejection : result.rejections) {
    EXPECT_EQ(rejection.looks_like, "one-texel-missing")
        << rejection.sampler << " " << rejection.weighting << ": " << rejection.diagnosis;
  }
}

/// Draws as declared, but says that one faint texel has no density.
Subject subject_of_a_hole_in_the_pdf() {
  Subject subject;
  subject.name = "hole in the pdf";
  subject.target = {Weighting::B, kRec709};
  subject.bind = [target = subject.target](const EnvironmentMap& map) {
    const Grid<double> masses = reference::texel_masses(map, target);
    const Extent extent = masses.extent();
    const auto values = masses.values();
    const auto faintest = std::min_element(values.begin(), values.end(), [](double a, double b) {
      return a > 0.0 && (b <= 0.0 || a < b);
    });
    const auto cell = static_cast<int>(faintest - values.begin());
    const BoundSampler sound = bound(LawSampler(masses, target.weighting));
    return BoundSampler{sound.sample, [sound, extent, cell](SquarePoint at) {
                          const int place = cell_of(at.t, extent.height) * extent.width +
                                            cell_of(at.s, extent.width);
                          return place == cell ? PerSquare{0.0} : sound.pdf(at);
                        }};
  };
  return subject;
}

// That few samples leave a faint texel empty says nothing.
TEST(Diagnosis, CallsNoTexelMissingWhereNoSampleIsToBeExpected) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {128, 64});
  const std::vector<Subject> subjects = {subject_of_a_hole_in_the_pdf()};
  const GateResult result = run_gate({&map, 1}, subjects, {.samples = 1U << 13U});
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
    EXPECT_EQ(record.runs, 4U);
    EXPECT_LE(record.rejected, record.runs);
    EXPECT_EQ(record.right + record.unknown + record.wrong, record.rejected) << record.mutant;
    EXPECT_EQ(record.wrong == 0, record.wrong_names.empty()) << record.mutant;
    rejected += record.rejected;
    right += record.right;
  }
  EXPECT_GT(rejected, 2 * records.size());
  EXPECT_GE(10 * right, 8 * rejected);
}

TEST(Mutants, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Mutant& mutant : mutants()) names.insert(std::string(mutant.name));
  for (const DirectionMutant& mutant : direction_mutants()) names.insert(mutant.sampler.name);
  EXPECT_EQ(names.size(), mutants().size() + direction_mutants().size());
}

// The law sampler that all of them start from. What the gate tests of it is what must have a kill.
TEST(Mutants, TheirSoundParentIsAcceptedByTestsThatEachHaveAKill) {
  const EnvironmentMap map = hostile_map();
  const Mutant sound = {"sound", "none", "", ""};
  const std::vector<Subject> subjects = {subject_of(sound, Weighting::A),
                                         subject_of(sound, Weighting::B)};
  const GateResult result = run_gate({&map, 1}, subjects, {});
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
  EXPECT_TRUE(result.rejections.empty());
  std::set<std::string> killing;
  for (const Kill& kill : kKills) killing.insert(key(kill.oracle, kill.test));
  for (const TestRecord& test : result.tests) {
    if (test.outcome == Outcome::not_run) continue;
    EXPECT_THAT(killing, Contains(key(test.oracle, test.test)));
  }
}

}  // namespace
}  // namespace lightproof
