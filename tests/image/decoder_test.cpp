// The program that decodes: what it may, and what becomes of a reader whose decoder crashes, is
// killed, stands still or is not there.
#include "lightproof/image/decoder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/image/decoder_program.h"
#include "lightproof/image/image_file.h"
#include "lightproof/image/stored_picture.h"
#include "lightproof/image/stored_picture_checks.h"
#include "lightproof/image/writer.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsConfined = false;
#else
constexpr bool kIsConfined = true;
#endif

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The children of this process that are decoders.
std::vector<pid_t> decoders() {
  std::vector<pid_t> found;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (!std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c) != 0; })) continue;
    const std::string status = text_of(entry.path() / "status");
    const bool is_ours = status.find(fmt::format("PPid:\t{}\n", getpid())) != std::string::npos;
    if (is_ours && status.starts_with("Name:\tlightproof-deco")) found.push_back(std::stoi(name));
  }
  return found;
}

template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class DecoderProgram : public testing::Test {
 protected:
  void SetUp() override { test::write_exr_file(file_, test::numbered_picture({64, 32})); }

  fs::path path(const std::string& name) const { return folder_ / name; }

  /// What is said of the file if its decoder gets this signal before it sends the pixels.
  std::string refusal_after(int signal) const {
    return refusal([&] {
      ImageFile image(file_);
      const std::vector<pid_t> found = decoders();
      ASSERT_EQ(found.size(), 1U);
      kill(found[0], signal);
      image.read_pixels();
    });
  }

  TemporaryFolder folder_;
  fs::path file_ = folder_ / "sky.exr";
};

TEST_F(DecoderProgram, ThatCrashesIsAnErrorOfItsFile) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS}) {
    EXPECT_THAT(
        refusal_after(signal),
        AllOf(HasSubstr("sky.exr: cannot be read as OpenEXR: the decoder crashed"),
              HasSubstr(fmt::format("signal {}", signal)),
              testing::AnyOf(HasSubstr("before the first row"), HasSubstr("at row 0 of 32")),
              HasSubstr("the file is damaged")));
  }
  EXPECT_THAT(refusal_after(SIGKILL), AllOf(HasSubstr("sky.exr"), HasSubstr("was killed")));
  EXPECT_TRUE(decoders().empty());
}

// The signal of the system for processor time that is over.
TEST_F(DecoderProgram, ThatTakesTooLongIsAnErrorOfItsFile) {
  EXPECT_THAT(refusal_after(SIGXCPU), AllOf(HasSubstr("sky.exr"), HasSubstr("processor time")));
}

TEST_F(DecoderProgram, ThatStandsStillIsAnErrorOfItsFile) {
  const int file = open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  Decoder decoder("sky.exr", "cannot be read", file, 300ms);
  kill(decoder.id(), SIGSTOP);
  decoder.now_at("in the header");
  decoder.send(MessageKind::open, OpenRequest{.version = "0"});
  EXPECT_THAT(refusal([&] { decoder.next(); }),
              AllOf(HasSubstr("sky.exr: cannot be read: the decoder stood still for 0.3 s in the "
                              "header")));
  close(file);
}

TEST_F(DecoderProgram, OfAnotherVersionIsRefused) {
  const int file = open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  Decoder decoder("sky.exr", "cannot be read", file);
  decoder.send(MessageKind::open, OpenRequest{.version = "0.0.0"});
  EXPECT_THAT(refusal([&] { decoder.next(); }), AllOf(HasSubstr("sky.exr: "), HasSubstr("0.0.0"),
                                                      HasSubstr("install both together")));
  close(file);
}

// Limits and rights of the process as the system sees them.
TEST_F(DecoderProgram, HasLittleMemoryAndTimeAndNoRights) {
  if (!kIsConfined) GTEST_SKIP() << "a sanitizer cannot be confined";
  const ImageFile image(file_);
  const std::vector<pid_t> found = decoders();
  ASSERT_EQ(found.size(), 1U);
  const fs::path process = fs::path("/proc") / std::to_string(found[0]);
  EXPECT_THAT(text_of(process / "status"),
              AllOf(HasSubstr("NoNewPrivs:\t1"), HasSubstr("Seccomp:\t2")));
  const std::string limits = text_of(process / "limits");
  EXPECT_THAT(limits, testing::ContainsRegex("Max cpu time +1 "));
  EXPECT_THAT(limits, testing::ContainsRegex("Max data size +100663296 "));
  EXPECT_THAT(limits, testing::ContainsRegex("Max core file size +0 +0 "));
  EXPECT_THAT(limits, testing::ContainsRegex("Max file size +0 +0 "));
  EXPECT_EQ(std::distance(fs::directory_iterator(process / "fd"), {}), 4);
}

/// A variable of the environment while this lives.
class Variable {
 public:
  Variable(const char* name, const fs::path& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (before_) {
      setenv(name_, before_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST_F(DecoderProgram, IsTheOneThatTheEnvironmentNames) {
  const fs::path built = decoder_program();
  {
    fs::create_symlink(built, path("other"));
    const Variable variable(kDecoderVariable, path("other"));
    EXPECT_EQ(decoder_program(), path("other"));
    EXPECT_EQ(ImageFile(file_).read_pixels().extent(), (Extent{64, 32}));
  }
  const Variable variable(kDecoderVariable, path("none"));
  EXPECT_THAT(refusal([&] { const ImageFile image(file_); }),
              AllOf(HasSubstr("LIGHTPROOF_DECODER"), HasSubstr("none")));
  EXPECT_THAT(refusal([&] {
                write_png(path("a.png"), Grid<Rgb>({2, 1}));
              }),
              HasSubstr("LIGHTPROOF_DECODER"));
  EXPECT_FALSE(fs::exists(path("a.png")));
}

// A program that is no decoder.
TEST_F(DecoderProgram, ThatAnswersNonsenseIsAnErrorOfItsFile) {
  {
    const Variable variable(kDecoderVariable, "/bin/cat");
    EXPECT_THAT(refusal([&] { const ImageFile image(file_); }),
                AllOf(HasSubstr("sky.exr"), HasSubstr("makes no sense")));
  }
  const Variable variable(kDecoderVariable, "/bin/true");
  EXPECT_THAT(refusal([&] { const ImageFile image(file_); }),
              AllOf(HasSubstr("sky.exr"), HasSubstr("status 0"), HasSubstr("in the header")));
}

TEST_F(DecoderProgram, ReadsTheFileThatWasOpenedWhateverBecomesOfItsName) {
  ImageFile image(file_);
  fs::remove(file_);
  const Grid<Rgb> picture = image.read_pixels();
  EXPECT_TRUE(std::ranges::equal(picture.values(), test::numbered_picture({64, 32}).values()));
}

// Sizes of tiles are divided by.
TEST(StoredPictureChecks, TakeTilesWithBothSidesOrNone) {
  StoredPicture stored;
  stored.data = {.width = 4, .height = 2};
  stored.display = stored.data;
  EXPECT_TRUE(is_possible(stored));
  stored.tile_width = 16;
  EXPECT_FALSE(is_possible(stored));
  stored.tile_height = 16;
  EXPECT_TRUE(is_possible(stored));
  stored.tile_width = 0;
  EXPECT_FALSE(is_possible(stored));
}

}  // namespace
}  // namespace lightproof
