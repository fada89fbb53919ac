#include "lightproof/core/child_conversation.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/temporary_folder.h"

namespace lightproof {
namespace {

using namespace std::chrono_literals;

Exchange send(ChildConversation& child, const std::string& text) {
  return child.send(std::as_bytes(std::span(text)));
}

std::string received(ChildConversation& child, std::size_t count) {
  std::string text(count, '\0');
  const Exchange exchange = child.receive(std::as_writable_bytes(std::span(text)));
  return exchange == Exchange::done ? text : "";
}

TEST(ChildConversation, PassesBytesBothWaysHoweverMany) {
  ChildConversation child("/bin/cat", {}, -1, 60s);
  const std::string text(100'000, 'x');
  ASSERT_EQ(send(child, text), Exchange::done);
  EXPECT_EQ(received(child, text.size()), text);
  const auto end = child.end();
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->by_signal);
  EXPECT_EQ(end->code, 0) << "the end of its input is the end of cat";
}

TEST(ChildConversation, HandsOverFilesInTheirOrder) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a") << "one";
  std::ofstream(folder / "b") << "two";
  const std::array files = {open((folder / "a").c_str(), O_RDONLY | O_CLOEXEC),
                            open((folder / "b").c_str(), O_RDONLY | O_CLOEXEC)};
  ChildConversation child("/bin/sh", {"-c", "cat <&4; cat <&3"}, files, 60s);
  EXPECT_EQ(received(child, 6), "twoone");
  for (const int file : files) close(file);
}

TEST(ChildConversation, SaysHowMuchMemoryWasHeld) {
  ChildConversation child("/bin/cat", {}, -1, 60s);
  const auto end = child.end();
  ASSERT_TRUE(end);
  // A program holds the pages of its own code at the least.
  EXPECT_GT(end->peak_bytes, 4096U);
}

TEST(ChildConversation, HandsOverAFileThatThePathNoLongerNames) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a") << "words";
  const int file = open((folder / "a").c_str(), O_RDONLY | O_CLOEXEC);
  std::filesystem::remove(folder / "a");
  ChildConversation child("/bin/sh", {"-c", "cat <&3"}, file, 60s);
  EXPECT_EQ(received(child, 5), "words");
  close(file);
}

TEST(ChildConversation, TellsHowTheProgramEnded) {
  ChildConversation crashed("/bin/sh", {"-c", "kill -SEGV $$"}, -1, 60s);
  EXPECT_EQ(received(crashed, 1), "");
  const auto end = crashed.end();
  ASSERT_TRUE(end);
  EXPECT_TRUE(end->by_signal);
  EXPECT_EQ(end->code, SIGSEGV);
  ChildConversation refused("/bin/sh", {"-c", "exit 7"}, -1, 60s);
  EXPECT_EQ(received(refused, 1), "");
  EXPECT_EQ(refused.end()->code, 7);
}

// The signal that a closed pipe sends would end the whole program.
TEST(ChildConversation, OutlivesAProgramThatTakesNothing) {
  ChildConversation child("/bin/sh", {"-c", "exit 0"}, -1, 60s);
  const std::string text(10'000'000, 'x');
  EXPECT_EQ(send(child, text), Exchange::closed);
}

TEST(ChildConversation, LosesPatienceWithAProgramThatIsSilent) {
  ChildConversation child("/bin/sleep", {"600"}, -1, 200ms);
  std::string text(1, '\0');
  EXPECT_EQ(child.receive(std::as_writable_bytes(std::span(text))), Exchange::silent);
  EXPECT_EQ(send(child, std::string(10'000'000, 'x')), Exchange::silent);
  const auto end = child.end();
  ASSERT_TRUE(end);
  EXPECT_TRUE(end->by_signal) << "it would have slept on";
}

TEST(ChildConversation, IsLeftByAnInterrupt) {
  ChildConversation child("/bin/sleep", {"600"}, -1, 60s);
  std::jthread interrupter([] {
    std::this_thread::sleep_for(200ms);
    request_interrupt();
  });
  std::string text(1, '\0');
  EXPECT_THROW(child.receive(std::as_writable_bytes(std::span(text))), Interrupted);
  interrupter.join();
  withdraw_interrupt();
}

TEST(ChildConversation, EndsWhatIsLeftOfTheProgram) {
  pid_t id = 0;
  {
    const ChildConversation child("/bin/sleep", {"600"}, -1, 60s);
    id = child.id();
    EXPECT_EQ(kill(id, 0), 0);
  }
  EXPECT_NE(kill(id, 0), 0);
}

TEST(ChildConversation, NamesAProgramThatIsNotThere) {
  EXPECT_THROW(ChildConversation("/nowhere/lightproof-decode", {}, -1, 60s), InputError);
}

}  // namespace
}  // namespace lightproof
