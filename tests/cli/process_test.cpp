// The helper itself: a harness that misses a failure would pass every program.
#include "tests/cli/process.h"

#include <gtest/gtest.h>

#include <csignal>

namespace lightproof::test {
namespace {

Command shell(const std::string& script) { return {.words = {"sh", "-c", script}}; }

TEST(Process, KeepsStreamsAndExitCodeApart) {
  const Finished finished = run(shell("echo left; echo right >&2; exit 7"));
  EXPECT_EQ(finished.exit_code, 7);
  EXPECT_EQ(finished.out, "left\n");
  EXPECT_EQ(finished.err, "right\n");
}

TEST(Process, ReadsMoreThanAPipeHolds) {
  EXPECT_EQ(run(shell("head -c 1000000 /dev/zero; head -c 300000 /dev/zero >&2")).out.size(),
            1000000U);
}

TEST(Process, NamesTheSignalThatKilled) {
  EXPECT_EQ(run(shell("kill -TERM $$")).exit_code, 128 + SIGTERM);
}

TEST(Process, KnowsWhenASignalIsHandled) {
  Process process(shell("sleep 0.3; trap 'exit 9' USR1; while :; do sleep 0.1; done"));
  ASSERT_TRUE(process.wait_to_catch(SIGUSR1, std::chrono::seconds(30)));
  process.send(SIGUSR1);
  EXPECT_EQ(process.wait().exit_code, 9);
}

TEST(Process, GivesUpAfterItsLimit) {
  Process process(shell("sleep 60"));
  EXPECT_THROW(process.wait(std::chrono::seconds(1)), std::runtime_error);
}

TEST(Process, GivesATerminalToOneStreamOnly) {
  Command command = shell("test -t 1; echo $?; test -t 2; echo $?");
  EXPECT_EQ(run(command).out, "1\n1\n");
  command.terminal = Terminal::on_stderr;
  EXPECT_EQ(run(command).out, "1\n0\n");
}

TEST(Process, ReplacesTheEnvironmentByName) {
  Command command = shell("echo $HOME");
  command.environment = {"HOME=/elsewhere"};
  EXPECT_EQ(run(command).out, "/elsewhere\n");
}

TEST(Process, CannotStartWhatIsNotThere) {
  EXPECT_THROW(Process({.words = {"/no/such/program"}}), std::system_error);
}

}  // namespace
}  // namespace lightproof::test
