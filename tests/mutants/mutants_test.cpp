// Every mutant is rejected, by the oracle that it names, and called by its name; none of it by a
// map made for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "lightproof/mutants/mutant.h"
#include "lightproof/suite/gate.h"

namespace lightproof {
namespace {

constexpr Extent kExtent = {128, 64};

/// Dim, so that the lower quarter falls below an absolute threshold; brighter upwards and on one
/// side; warm on one side; a sun that does not outshine the rest; the first row black.
EnvironmentMap hostile_map() {
  EnvironmentMap map = {"hostile", Grid<Rgb>(kExtent), {}};
  for (int y = 1; y < kExtent.height; ++y) {
    for (int x = 0; x < kExtent.width; ++x) {
      const double around = 1.0 + 0.5 * std::sin(2.0 * kPi * x / kExtent.width + 1.0);
      const auto grey = static_cast<float>(3e-4 * (0.1 + 1.0 * y / kExtent.height) * around);
      const float warm = x < kExtent.width / 3 ? 1.6F : 1.0F;
      const bool sun = std::abs(x - 90) <= 1 && std::abs(y - 45) <= 1;
      map.radiance(x, y) = grey * (sun ? 40.0F : 1.0F) * Rgb(warm, 1.0F, 1.0F / warm);
    }
  }
  return map;
}

class EveryMutant : public testing::TestWithParam<std::tuple<std::size_t, Weighting>> {};

TEST_P(EveryMutant, IsKilledByItsOracleAndNamed) {
  const auto [index, weighting] = GetParam();
  const Mutant& mutant = mutants()[index];
  const EnvironmentMap map = hostile_map();
  const Subject subject = subject_of(mutant, weighting);
  const GateResult result = run_gate({&map, 1}, {&subject, 1}, {});
  std::set<std::string> oracles;
  for (const TestRecord& test : result.tests) {
    if (test.outcome == Outcome::reject) oracles.insert(test.oracle);
  }
  EXPECT_THAT(oracles, testing::Contains(std::string(mutant.oracle)));
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_EQ(result.rejections[0].looks_like, mutant.diagnosis);
}

INSTANTIATE_TEST_SUITE_P(Mutants, EveryMutant,
                         testing::Combine(testing::Range<std::size_t>(0, mutants().size()),
                                          testing::Values(Weighting::A, Weighting::B)),
                         [](const auto& param_info) {
                           std::string name(mutants()[std::get<0>(param_info.param)].name);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name + "_" + to_string(std::get<1>(param_info.param));
                         });

TEST(Mutants, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const Mutant& mutant : mutants()) names.insert(mutant.name);
  EXPECT_EQ(names.size(), mutants().size());
  EXPECT_GE(names.size(), 43U);
}

// The law sampler that all of them start from.
TEST(Mutants, TheirSoundParentIsAccepted) {
  const EnvironmentMap map = hostile_map();
  const Mutant sound = {"sound", "none", "", ""};
  const std::vector<Subject> subjects = {subject_of(sound, Weighting::A),
                                         subject_of(sound, Weighting::B)};
  const GateResult result = run_gate({&map, 1}, subjects, {});
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
  EXPECT_TRUE(result.rejections.empty());
}

}  // namespace
}  // namespace lightproof
