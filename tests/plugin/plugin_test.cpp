// Plug-ins in the gate: shared libraries that are built for these tests, see defects.c.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>

#include <chrono>
#include <fstream>
#include <memory>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/gate/gate.h"
#include "lightproof/gate/sampler_failure.h"
#include "lightproof/gate/sequential_gate.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/plugin/plugin_library.h"
#include "lightproof/report/ci_outputs.h"
#include "lightproof/results/verdict.h"
#include "lightproof/samplers/registry.h"

namespace lightproof {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string file_of(const std::string& name) {
  return std::string(LIGHTPROOF_TEST_PLUGINS) + "/" + name + ".so";
}

/// Enough for every defect here, on maps of 512 texels.
constexpr std::uint64_t kSamples = std::uint64_t{1} << 17U;

EnvironmentMap sun_sky() { return make_synthetic_map("sun-sky", {32, 16}); }

/// A plug-in under test, its notes, and what the gate says of it.
class InTheGate {
 public:
  explicit InTheGate(const std::string& name, PluginOptions options = {})
      : library_(std::make_shared<const PluginLibrary>(file_of(name), options)) {}

  GateResult judged(bool sequentially = false, std::vector<SamplerUnderTest> others = {},
                    std::uint64_t samples = kSamples) {
    others.push_back(sampler_under_test(library_, notes_));
    const std::vector<TestCase> test_cases = test_cases_of(maps_, others);
    const GateOptions options{.samples = samples};
    return sequentially ? run_sequential_gate(test_cases, options) : run_gate(test_cases, options);
  }

  std::vector<std::string> notes() const { return notes_->all(); }

 private:
  std::vector<EnvironmentMap> maps_ = {sun_sky()};
  std::shared_ptr<const PluginLibrary> library_;
  std::shared_ptr<PluginNotes> notes_ = std::make_shared<PluginNotes>();
};

const TestRecord& record_of(const GateResult& result, TestId test) {
  return *std::ranges::find(result.tests, test, &TestRecord::test);
}

std::vector<std::string> rejected_tests(const GateResult& result) {
  std::vector<std::string> names;
  for (const TestRecord& test : result.tests) {
    if (test.outcome == Outcome::reject) names.push_back(full_name(test.test));
  }
  return names;
}

/// A name that GoogleTest takes.
std::string name_of(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

/// Thousands of times what a batch of these plug-ins takes: a busy machine does not matter.
PluginOptions with_little_time() {
  PluginOptions options;
  options.limits.batch_time = std::chrono::milliseconds{1000};
  return options;
}

class Correct : public testing::TestWithParam<const char*> {};

TEST_P(Correct, IsAcceptedByAllTests) {
  const GateResult result = InTheGate(GetParam()).judged();
  EXPECT_THAT(rejected_tests(result), IsEmpty());
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
  EXPECT_EQ(record_of(result, TestId::answers).outcome, Outcome::accept);
}

/// As it is written; with rounding to floats; with a coarser
/// one that it declares; with other axes; in the coordinates and the measure
/// of a picture; in an order of its own, without weights and pdf; with words on both streams, few
/// or a megabyte; with tables that it makes when they are first needed; with an end that crashes.
INSTANTIATE_TEST_SUITE_P(PluginInTheGate, Correct,
                         testing::Values("correct", "floats", "rounded", "y-up", "picture",
                                         "in-order", "prints", "prints-much", "allocates-late",
                                         "crash-at-the-end"));

TEST(PluginInTheGate, IsAcceptedSequentially) {
  EXPECT_EQ(overall_outcome(InTheGate("correct").judged(true), true), Outcome::accept);
}

TEST(PluginInTheGate, GivesTheSameBitsWhateverTheThreads) {
  const GateResult one = [] {
    const ThreadLimit limit(1);
    return InTheGate("correct").judged();
  }();
  const GateResult many = [] {
    const ThreadLimit limit(4);
    return InTheGate("correct").judged();
  }();
  ASSERT_EQ(one.tests.size(), many.tests.size());
  for (std::size_t i = 0; i < one.tests.size(); ++i) {
    EXPECT_EQ(one.tests[i].statistic, many.tests[i].statistic) << full_name(one.tests[i].test);
  }
}

TEST(PluginInTheGate, WithoutPdfAndWeightsIsNotAskedForThem) {
  const GateResult result = InTheGate("in-order").judged();
  for (const TestId test : {TestId::declared_density, TestId::returned_pdf, TestId::edge_points}) {
    EXPECT_EQ(record_of(result, test).outcome, Outcome::not_run) << full_name(test);
  }
}

TEST(PluginInTheGate, NotesWhatIsPrinted) {
  InTheGate printing("prints");
  printing.judged();
  EXPECT_THAT(printing.notes(), testing::Contains(HasSubstr("printed: drew")));
  InTheGate much("prints-much");
  much.judged();
  EXPECT_THAT(much.notes(), testing::ElementsAre(HasSubstr("printed: wwww")));
  InTheGate silent("correct");
  silent.judged();
  EXPECT_THAT(silent.notes(), IsEmpty());
}

TEST(PluginInTheGate, ThatCrashesIsQuotedWithItsLastWords) {
  const GateResult result = InTheGate("last-words").judged();
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_THAT(result.rejections[0].diagnosis, AllOf(HasSubstr("sample() crashed (signal 6"),
                                                    HasSubstr("; it printed: the last words")));
}

/// What destroy() does, and the note of it.
struct End {
  const char* name;
  const char* note;
};

class Ending : public testing::TestWithParam<End> {};

TEST_P(Ending, IsNotedOnce) {
  const auto& [name, note] = GetParam();
  InTheGate ending(name);
  ending.judged();
  EXPECT_THAT(ending.notes(), testing::ElementsAre(HasSubstr(note)));
}

/// At exit() the address sanitizer looks for leaks, for which it starts another process.
#if defined(__SANITIZE_ADDRESS__)
constexpr const char* kNoteOfExit = "the plug-in started another process or program at the end";
constexpr const char* kWordsOfExit = "sample() started another process";
#else
constexpr const char* kNoteOfExit = "the plug-in ended its process with status 3 at the end";
constexpr const char* kWordsOfExit = "sample() ended its process with status 3";
#endif

INSTANTIATE_TEST_SUITE_P(
    PluginInTheGate, Ending,
    testing::Values(End{"crash-at-the-end", "the plug-in crashed at the end (signal 6"},
                    End{"hang-at-the-end", "the plug-in did not end within a moment"},
                    End{"exit-at-the-end", kNoteOfExit},
                    End{"fork-at-the-end",
                        "the plug-in started another process or program at the end"},
                    End{"throws-at-the-end", "the plug-in threw an exception at the end"}),
    [](const auto& row) { return name_of(row.param.name); });

/// A defect of the samples, and a test that must see it.
struct Defect {
  const char* name;
  const char* test;
  const char* looks_like;  ///< nullptr: it is not named
};

class Broken : public testing::TestWithParam<Defect> {};

TEST_P(Broken, IsRejectedAndNamed) {
  const auto& [name, test, looks_like] = GetParam();
  const GateResult result = InTheGate(name).judged();
  EXPECT_THAT(rejected_tests(result), testing::Contains(test));
  ASSERT_EQ(result.rejections.size(), 1U);
  if (looks_like != nullptr) {
    EXPECT_EQ(result.rejections[0].looks_like, looks_like);
  }
}

INSTANTIATE_TEST_SUITE_P(
    PluginInTheGate, Broken,
    testing::Values(Defect{"no-jacobian", "check/pdf is the declared density",
                           "pdf-of-another-measure"},
                    Defect{"no-sine", "reference/rows", "other-density"},
                    Defect{"flipped-t", "reference/rows", "upside-down"},
                    Defect{"off-by-one", "reference/texels", "column-early"},
                    Defect{"other-pdf", "check/pdf of the sample", nullptr},
                    Defect{"nan", "check/no out-of-domain samples", "off-the-map"},
                    Defect{"silent", "check/no out-of-domain samples", "off-the-map"},
                    Defect{"forgets", "check/no out-of-domain samples", "off-the-map"}),
    [](const auto& row) { return name_of(row.param.name); });

/// A call that is not answered, and what the verdict says of it.
struct Failure {
  const char* name;
  std::vector<const char*> words;
};

class Failing : public testing::TestWithParam<Failure> {};

TEST_P(Failing, IsRejectedWithTheInputAtFault) {
  InTheGate failing(GetParam().name, with_little_time());
  const GateResult result = failing.judged();
  EXPECT_THAT(rejected_tests(result), testing::ElementsAre("check/every call returns"));
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_EQ(result.rejections[0].looks_like, "no answer");
  // The verdict has said it.
  EXPECT_THAT(failing.notes(), IsEmpty());
  for (const char* words : GetParam().words) {
    EXPECT_THAT(result.rejections[0].diagnosis, HasSubstr(words));
  }
}

INSTANTIATE_TEST_SUITE_P(
    PluginInTheGate, Failing,
    testing::Values(
        Failure{"crash",
                {"sample() crashed (signal 11", "at u = (0.700", "alone in a new process"}},
        Failure{"crash-in-pdf", {"pdf() crashed (signal 11", "at the direction (", "0.9"}},
        Failure{"in-order-crash",
                {"draw() crashed (signal 6", "sample number 4096 with the seed 1"}},
        Failure{"hang", {"sample() took longer than 1 s at u = (0.700"}},
        Failure{"spin", {"sample() took longer than 1 s at u = (0.700"}},
        Failure{"exit", {kWordsOfExit, "at u = (0.700"}},
        Failure{"fork", {"sample() started another process", "at u = (0.700"}},
        Failure{"program", {"sample() started another process or program", "at u = (0.700"}},
        Failure{"once", {"sample() crashed (signal 6", "each of them alone", "it answers"}},
        Failure{"refuses", {"create() returned no sampler: only square maps will do"}},
        Failure{"closes", {"sample() "}},
        Failure{"throws", {"sample() threw an exception: the lamp is broken", "at u = ("}}),
    [](const auto& row) { return name_of(row.param.name); });

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// A sanitizer's own memory would count.
TEST(PluginInTheGate, ThatLeaksIsRejectedByItsMemory) {
  PluginOptions options;
  options.limits.memory_bytes = std::uint64_t{64} << 20U;
  const GateResult result = InTheGate("leak", options).judged();
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_THAT(result.rejections[0].diagnosis,
              AllOf(HasSubstr("sample() holds "), HasSubstr("may hold 67.11 MB"),
                    HasSubstr("more than after create()")));
}
#endif

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(PluginInTheGate, ThatLeaksIsRejectedLongBeforeItsLimit) {
  // One process, which leaks 112 bytes a sample with those of the allocator: 59 MB.
  const ThreadLimit limit(1);
  for (const char* name : {"leak", "leaks-little"}) {
    const GateResult result = InTheGate(name).judged(false, {}, std::uint64_t{1} << 19U);
    EXPECT_THAT(rejected_tests(result), testing::ElementsAre("check/every call returns"));
    ASSERT_EQ(result.rejections.size(), 1U);
    EXPECT_THAT(result.rejections[0].diagnosis,
                AllOf(HasSubstr("sample() holds "), HasSubstr("more than after create(), "),
                      HasSubstr("--plugin-memory")));
  }
}

TEST(PluginInTheGate, MayKeepWhatItWasAllowedByTheUser) {
  const ThreadLimit limit(1);
  PluginOptions options;
  options.limits.memory_bytes = std::uint64_t{1} << 30U;
  const GateResult result =
      InTheGate("leaks-little", options).judged(false, {}, std::uint64_t{1} << 19U);
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
}
#endif

/// A batch takes 12 s, each sample alone 3 ms: a search without an end would take 12 s, too.
TEST(PluginInTheGate, ThatIsSlowIsNotSearchedForLong) {
  PluginOptions options;
  options.limits.batch_time = std::chrono::milliseconds{300};
  const GateResult result = InTheGate("slow", options).judged();
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_THAT(
      result.rejections[0].diagnosis,
      AllOf(HasSubstr("sample() took longer than 0.3 s, in a batch of "), HasSubstr("; the first "),
            HasSubstr(" of them alone, in a new process, it answers")));
}

TEST(PluginInTheGate, ThatFailsIsTheSameVerdictWhateverTheThreads) {
  const auto words = [](int threads) {
    const ThreadLimit limit(threads);
    return InTheGate("crash").judged().rejections.at(0).diagnosis;
  };
  EXPECT_EQ(words(1), words(4));
}

TEST(PluginInTheGate, ThatFailsIsRejectedSequentiallyToo) {
  const GateResult result = InTheGate("crash").judged(true);
  EXPECT_THAT(rejected_tests(result), testing::ElementsAre("check/every call returns"));
}

TEST(PluginInTheGate, ThatFailsDisturbsNobodyElse) {
  const std::vector<SamplerUnderTest> ours = {
      sampler_under_test(samplers().front(), DensitySpace::sine_weighted)};
  const std::vector<EnvironmentMap> maps = {sun_sky()};
  const GateResult alone = run_gate(maps, ours, {.samples = kSamples});
  std::vector<double> expected;
  for (const TestRecord& test : alone.tests) expected.push_back(test.statistic);
  for (const char* name : {"crash", "hang", "exit", "fork", "program", "closes", "prints"}) {
    const GateResult beside = InTheGate(name, with_little_time()).judged(false, ours);
    std::vector<double> found;
    for (const TestRecord& test : beside.tests) {
      if (test.sampler != name) found.push_back(test.statistic);
    }
    EXPECT_EQ(found, expected) << name;
  }
}

TEST(PluginInTheGate, LeavesNoProcessBehind) {
  for (const char* name : {"correct", "hang", "fork"}) {
    InTheGate(name, with_little_time()).judged();
  }
  // No child is left to wait for.
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
}

TEST(PluginInTheGate, IsReplayedByItsFile) {
  GateResult result = InTheGate("flipped-t").judged();
  result.third_party_samplers = {{"flipped-t", "--plugin ./flipped.so"}};
  EXPECT_THAT(replay_command(result, result.rejections[0]),
              AllOf(HasSubstr("lightproof gate sun-sky --plugin ./flipped.so --density C"),
                    Not(HasSubstr("--sampler"))));
}

/// A library that is refused before it is tested.
struct Refused {
  const char* name;
  const char* why;
};

class NoPlugin : public testing::TestWithParam<Refused> {};

TEST_P(NoPlugin, IsRefusedWithItsFileAndTheReason) {
  const auto& [name, why] = GetParam();
  try {
    const PluginLibrary library(file_of(name), {});
    ADD_FAILURE() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(file_of(name)), HasSubstr(why)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Refused, NoPlugin,
    testing::Values(Refused{"no-function", "has no function lightproof_plugin_describe"},
                    Refused{"nothing", "describes no plug-in"},
                    Refused{"other-version", "was built for version 2 of the interface"},
                    Refused{"short", "a description of 16 bytes"},
                    Refused{"no-create", "has no function create"},
                    Refused{"no-samples", "neither a function sample nor draw"},
                    Refused{"other-words", "its density: \"D\" is none of C, A, B"},
                    Refused{"other-columns", "its columns: columns name no sample"},
                    Refused{"strange-name", "its name: \"a/b\""},
                    Refused{"endless-name", "its name: 999 characters are more than 200"},
                    Refused{"no-reply", "what is no reply"},
                    Refused{"endless-reply", "what is no reply"},
                    Refused{"no-description", "what is no description"},
                    Refused{"crash-at-load", "crashed (signal 6"},
                    Refused{"missing", "there is no such file"}),
    [](const auto& row) { return name_of(row.param.name); });

TEST(Plugin, ThatIsNoLibraryIsRefused) {
  const TemporaryFolder folder;
  const std::string file = (folder / "notes.so").string();
  std::ofstream(file) << "no library at all\n";
  try {
    const PluginLibrary library(file, {});
    ADD_FAILURE() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(file), HasSubstr("cannot be loaded")));
  }
}

TEST(Plugin, IsTimedInItsOwnProcess) {
  const PluginLibrary library(file_of("correct"), {});
  const EnvironmentMap map = sun_sky();
  const TimedPlugin timed(library, map);
  const std::vector<SquarePoint> points(kPluginBatch, SquarePoint{0.3, 0.6});
  const PluginTime time = timed.draw(points);
  // A sample is a search in 16 and one in 32 entries, a sine and a cosine: between a nanosecond and
  // ten microseconds on whatever machine.
  EXPECT_GT(time.cpu_nanoseconds, 1.0);
  EXPECT_LT(time.cpu_nanoseconds, 1e4);
  EXPECT_GT(time.wall_nanoseconds, 1.0);
}

}  // namespace
}  // namespace lightproof
