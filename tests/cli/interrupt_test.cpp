// Ctrl-C and SIGTERM: exit code 128 and the signal, soon, and nothing half-written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::IsEmpty;

/// What a user waits for before pressing Ctrl-C again.
constexpr double kPatience = 5.0;

Command on_terminal(const Words& words, const std::filesystem::path& folder) {
  Command command = lightproof_command(words, folder);
  command.terminal = Terminal::on_stderr;
  return command;
}

/// Lets the program run on for this long after it has started to listen.
void work_for(const Process& process, milliseconds time) {
  ASSERT_TRUE(process.wait_to_catch(SIGINT, seconds(60)));
  std::this_thread::sleep_for(time);
}

struct Interruption {
  Finished finished;
  double seconds = 0.0;
};

Interruption interrupt(Process& process, int signal = SIGINT) {
  const auto start = std::chrono::steady_clock::now();
  process.send(signal);
  Interruption result{process.wait(), 0.0};
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void expect_interrupted(const Interruption& interruption, int signal = SIGINT) {
  EXPECT_EQ(interruption.finished.exit_code, 128 + signal) << interruption.finished.err;
  EXPECT_THAT(interruption.finished.err, HasSubstr("interrupted"));
  EXPECT_THAT(interruption.finished.out, IsEmpty());
  EXPECT_LT(interruption.seconds, kPatience);
}

class StudyPhase : public testing::TestWithParam<const char*> {};

TEST_P(StudyPhase, StopsSoonAndLeavesNothing) {
  const TemporaryFolder folder;
  Words words = {"study", "constant",        "--size", "32x16", "-n",
                 "65536", "--no-throughput", "-o",     "report"};
  if (GetParam() == std::string_view("convergence")) words.emplace_back("--no-accuracy");
  Process study(on_terminal(words, folder / ""));
  ASSERT_TRUE(study.wait_for_err(GetParam(), seconds(300)));
  expect_interrupted(interrupt(study));
  // What is finished is kept, and nothing else.
  EXPECT_THAT(names_in(folder / "report"), testing::AnyOf(IsEmpty(), Words{"unfinished"}));
}

INSTANTIATE_TEST_SUITE_P(Interrupted, StudyPhase,
                         testing::Values("gate", "exact light", "convergence"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

// The benchmarks are a program of their own, which must end too.
TEST(Interrupted, StudyEndsItsBenchmarks) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "tmp");
    Command command =
        on_terminal({"study", "constant", "--size", "32x16", "-o", "report"}, folder / "");
    command.words.insert(command.words.begin(), {"env", "TMPDIR=" + (folder / "tmp").string()});
    Process study(command);
    ASSERT_TRUE(study.wait_for_err("throughput", seconds(60)));
    std::this_thread::sleep_for(milliseconds(300));
    ASSERT_THAT(names_in(folder / "tmp"), testing::Not(IsEmpty()))
        << "the benchmarks have not started";
    expect_interrupted(interrupt(study, signal), signal);
    EXPECT_THAT(names_in(folder / "tmp"), IsEmpty());
    EXPECT_THAT(names_in(folder / "report"), IsEmpty());
  }
}

/// How many programs run that a process started.
std::size_t children_of(pid_t parent) {
  const std::string mark = "LIGHTPROOF_PARENT=" + std::to_string(parent);
  std::size_t count = 0;
  std::error_code error;
  for (const auto& process : std::filesystem::directory_iterator("/proc", error)) {
    std::ifstream environment(process.path() / "environ");
    for (std::string variable; std::getline(environment, variable, '\0');) {
      count += variable == mark ? 1 : 0;
    }
  }
  return count;
}

void wait_for_children_of(pid_t parent) {
  for (int i = 0; i < 500 && children_of(parent) == 0; ++i) {
    std::this_thread::sleep_for(milliseconds(20));
  }
}

/// How many programs are left a moment after their parent has ended.
std::size_t left_of(pid_t parent) {
  for (int i = 0; i < 250 && children_of(parent) > 0; ++i) {
    std::this_thread::sleep_for(milliseconds(20));
  }
  return children_of(parent);
}

// What nobody waits for any more must not keep the machine busy for minutes.
TEST(Interrupted, KilledStudyEndsItsBenchmarksToo) {
  const TemporaryFolder folder;
  Process study(on_terminal(
      {"study", "constant", "--size", "32x16", "--measure-again", "-o", "report"}, folder / ""));
  ASSERT_TRUE(study.wait_for_err("throughput", seconds(60)));
  wait_for_children_of(study.id());
  ASSERT_EQ(children_of(study.id()), 1U);
  study.send(SIGKILL);
  study.wait();
  EXPECT_EQ(left_of(study.id()), 0U);
}

class GateOfPlugin : public testing::TestWithParam<int> {};

// Nobody else would end a plug-in that hangs.
TEST_P(GateOfPlugin, LeavesNoProcessBehind) {
  const TemporaryFolder folder;
  Process gate(lightproof_command({"gate", "constant", "--size", "32x16", "--plugin-seconds", "600",
                                   "--plugin", std::string(LIGHTPROOF_TEST_PLUGINS) + "/hang.so"},
                                  folder / ""));
  wait_for_children_of(gate.id());
  // First it is asked what it is, then for samples.
  work_for(gate, milliseconds(500));
  ASSERT_GE(children_of(gate.id()), 1U);
  if (GetParam() == SIGKILL) {
    gate.send(SIGKILL);
    gate.wait();
    EXPECT_EQ(left_of(gate.id()), 0U);
  } else {
    expect_interrupted(interrupt(gate, GetParam()), GetParam());
    EXPECT_EQ(children_of(gate.id()), 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Interrupted, GateOfPlugin, testing::Values(SIGINT, SIGTERM, SIGKILL));

const Words kLongGate = {"gate", "--size", "64x32", "-n", "1073741824", "--json", "gate.json"};

TEST(Interrupted, GateStopsSoonAndLeavesNothing) {
  const TemporaryFolder folder;
  Process gate(lightproof_command(kLongGate, folder / ""));
  work_for(gate, milliseconds(500));
  expect_interrupted(interrupt(gate));
  EXPECT_THAT(names_in(folder / ""), IsEmpty());
}

TEST(Interrupted, GateKeepsAnEarlierFile) {
  const TemporaryFolder folder;
  write_bytes(folder / "gate.json", "earlier");
  Process gate(lightproof_command(kLongGate, folder / ""));
  work_for(gate, milliseconds(500));
  expect_interrupted(interrupt(gate));
  EXPECT_EQ(bytes_of(folder / "gate.json"), "earlier");
}

TEST(Interrupted, ByTerminationLikeByCtrlC) {
  const TemporaryFolder folder;
  Process gate(lightproof_command(kLongGate, folder / ""));
  work_for(gate, milliseconds(500));
  expect_interrupted(interrupt(gate, SIGTERM), SIGTERM);
}

// Whatever an interrupt leaves unfinished must not be judged, whenever it comes.
class GateMoment : public testing::TestWithParam<int> {};

TEST_P(GateMoment, StopsSoonAndLeavesNothing) {
  const TemporaryFolder folder;
  Process gate(lightproof_command(
      {"gate", "--size", "512x256", "-n", "4194304", "--json", "gate.json"}, folder / ""));
  work_for(gate, milliseconds(GetParam()));
  expect_interrupted(interrupt(gate));
  EXPECT_THAT(names_in(folder / ""), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(AfterMilliseconds, GateMoment,
                         testing::Values(1, 30, 100, 300, 800, 2000));

}  // namespace
}  // namespace lightproof::test
