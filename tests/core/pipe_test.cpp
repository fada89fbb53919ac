#include "lightproof/core/pipe.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <string_view>

namespace lightproof {
namespace {

void write(const Pipe& pipe, std::string_view words) {
  ASSERT_EQ(::write(pipe.write_end(), words.data(), words.size()),
            static_cast<ssize_t>(words.size()));
}

TEST(Pipe, GivesWhatIsThereAndNoMoreThanIsAskedFor) {
  const Pipe pipe;
  write(pipe, "some ");
  write(pipe, "words");
  EXPECT_EQ(pipe.take(4), "some");
  EXPECT_EQ(pipe.take(100), " words");
}

// Whoever waited would wait forever here.
TEST(Pipe, WaitsForNothing) {
  const Pipe pipe;
  EXPECT_EQ(pipe.take(100), "");
}

TEST(Pipe, GivesWhatWasLeftInItWhenItsOtherEndWasClosed) {
  Pipe pipe;
  write(pipe, "the last words");
  pipe.close_write_end();
  EXPECT_EQ(pipe.take(100), "the last words");
  EXPECT_EQ(pipe.take(100), "");
}

}  // namespace
}  // namespace lightproof
