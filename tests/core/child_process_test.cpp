#include "lightproof/core/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/failure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/temporary_folder.h"

namespace lightproof {
namespace {

using testing::HasSubstr;

/// The message of the InputError that a shell running this script ends in; empty if it ends well.
std::string failure_of(const std::string& script) {
  try {
    run_child("/bin/sh", {"-c", script});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RunChild, PassesItsArgumentsAndWaits) {
  const TemporaryFolder folder;
  const auto file = folder / "two words";
  run_child("/bin/sh", {"-c", "sleep 0.1; echo \"$1\" > \"$0\"", file.string(), "a 'b'"});
  std::string line;
  std::getline(std::ifstream(file), line);
  EXPECT_EQ(line, "a 'b'");
}

TEST(RunChild, SaysHowTheProgramEndedAndItsLastWords) {
  EXPECT_EQ(failure_of("exit 0"), "");
  EXPECT_THAT(failure_of("exit 7"), testing::AllOf(HasSubstr("/bin/sh"), HasSubstr("7")));
  EXPECT_THAT(failure_of("echo first >&2; echo 'no such map' >&2; exit 2"),
              testing::AllOf(HasSubstr("no such map"), testing::Not(HasSubstr("first"))));
  EXPECT_THAT(failure_of("kill -9 $$"), HasSubstr("9"));
}

/// As some launchers start a program: how children end is forgotten by the system.
class ChildrenForgotten {
 public:
  explicit ChildrenForgotten(int flags = 0) {
    struct sigaction action = {};
    action.sa_handler = flags == 0 ? SIG_IGN : SIG_DFL;
    action.sa_flags = flags;
    sigaction(SIGCHLD, &action, &before_);
  }
  ~ChildrenForgotten() { sigaction(SIGCHLD, &before_, nullptr); }
  ChildrenForgotten(const ChildrenForgotten&) = delete;
  ChildrenForgotten& operator=(const ChildrenForgotten&) = delete;

  static bool still_in_force(int flags = 0) {
    struct sigaction now = {};
    sigaction(SIGCHLD, nullptr, &now);
    return flags == 0 ? now.sa_handler == SIG_IGN : (now.sa_flags & flags) != 0;
  }

 private:
  struct sigaction before_ = {};
};

TEST(RunChild, SeesAFailureWhereTheSignalOfChildrenIsIgnored) {
  for (const int flags : {0, SA_NOCLDWAIT}) {
    const ChildrenForgotten forgotten(flags);
    EXPECT_EQ(failure_of("exit 0"), "");
    EXPECT_THAT(failure_of("exit 7"), HasSubstr("status 7"));
    EXPECT_TRUE(ChildrenForgotten::still_in_force(flags)) << "the caller's choice is put back";
  }
}

TEST(RunChild, SeesAFailureOfEachOfSeveralAtOnce) {
  const ChildrenForgotten forgotten;
  std::vector<std::string> failures(4);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < failures.size(); ++i) {
      threads.emplace_back([&, i] {
        failures[i] = failure_of("sleep 0." + std::to_string(i) + "; exit " + std::to_string(i));
      });
    }
  }
  EXPECT_EQ(failures[0], "");
  for (std::size_t i = 1; i < failures.size(); ++i) {
    EXPECT_THAT(failures[i], HasSubstr("status " + std::to_string(i)));
  }
  EXPECT_TRUE(ChildrenForgotten::still_in_force());
}

// Somebody else waits for all children of the process, and takes the status.
TEST(RunChild, SaysSoIfNobodyKnowsHowTheProgramEnded) {
  std::atomic<bool> done = false;
  std::jthread reaper([&] {
    while (!done) {
      if (waitpid(-1, nullptr, 0) < 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  const std::string failure = failure_of("sleep 0.1");
  done = true;
  EXPECT_THAT(failure, testing::AllOf(HasSubstr("/bin/sh"), HasSubstr("not known how it ended")));
}

TEST(RunChild, EndsAProgramThatDoesNotListen) {
  std::jthread interrupter([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    request_interrupt();
  });
  EXPECT_THROW(run_child("/bin/sh", {"-c", "trap '' TERM; while :; do sleep 0.1; done"}),
               Interrupted);
  interrupter.join();
  withdraw_interrupt();
}

TEST(RunChild, FailsAsTheProgramDid) {
  EXPECT_THROW(run_child("/bin/sh", {"-c", "exit 2"}), InputError);
  EXPECT_THROW(run_child("/bin/sh", {"-c", "exit 71"}), OutOfMemory);
  try {
    run_child("/bin/sh", {"-c", "echo 'a fault' >&2; exit 70"});
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::exception& error) {
    EXPECT_EQ(lightproof::failure_of(std::current_exception()).code, kProgramFailed);
    EXPECT_THAT(error.what(), HasSubstr("a fault"));
  }
}

TEST(RunChild, NamesAProgramThatIsNotThere) {
  EXPECT_THROW(run_child("/nowhere/lightproof_bench", {}), InputError);
}

TEST(TemporaryFolder, GoesAwayWithWhatIsInIt) {
  std::filesystem::path inside;
  {
    const TemporaryFolder folder;
    inside = folder / "sub";
    std::filesystem::create_directory(inside);
    std::ofstream(inside / "file") << "x";
    EXPECT_TRUE(std::filesystem::exists(inside / "file"));
  }
  EXPECT_FALSE(std::filesystem::exists(inside.parent_path()));
}

}  // namespace
}  // namespace lightproof
