#include "lightproof/core/unfinished_work.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "lightproof/core/cell_log.h"
#include "lightproof/core/error.h"
#include "lightproof/core/folder_lock.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/temporary_folder.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

std::string bytes_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Wherever the process was killed while it wrote, and whatever was damaged: records before that are
// there, and what is added afterwards is, too.
TEST(CellLog, LosesNoMoreThanTheRecordThatWasBeingWritten) {
  const TemporaryFolder folder;
  const fs::path file = folder / "log";
  std::vector<std::size_t> ends;
  {
    CellLog log(file);
    for (const std::string key : {"a", "b", "c"}) {
      log.add(key, "of " + key);
      ends.push_back(fs::file_size(file));
    }
  }
  const std::string whole = bytes_of_file(file);
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    put(file, whole.substr(0, length));
    {
      CellLog log(file);
      EXPECT_EQ(log.find("a").has_value(), length >= ends[0]) << length;
      EXPECT_EQ(log.find("b").has_value(), length >= ends[1]) << length;
      log.add("d", "more");
    }
    const CellLog again(file);
    EXPECT_EQ(again.find("d"), "more") << length;
    EXPECT_EQ(again.find("a").value_or(""), length >= ends[0] ? "of a" : "") << length;
  }
  for (std::size_t i = ends[0]; i < ends[1]; ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    put(file, damaged);
    const CellLog log(file);
    EXPECT_EQ(log.find("a"), "of a");
    EXPECT_FALSE(log.find("b")) << "byte " << i;
  }
}

TEST(FolderLock, LetsOneInAtATime) {
  const TemporaryFolder folder;
  {
    FolderLock first(folder / "");
    EXPECT_TRUE(first.holds());
    EXPECT_THAT(refusal([&] { FolderLock(folder / ""); }), HasSubstr("another run"));
    const FolderLock moved = std::move(first);
    EXPECT_TRUE(moved.holds());
    EXPECT_THROW(FolderLock(folder / ""), InputError);
  }
  EXPECT_TRUE(FolderLock(folder / "").holds());
  EXPECT_FALSE(FolderLock(folder / "none").holds());
}

const std::vector<RunInput> kInputs = {{"--seed", "1"}, {"the map sky", "8x4 12ab"}};

class Unfinishing : public testing::Test {
 protected:
  UnfinishedWork work(Unfinished earlier = Unfinished::continued,
                      const std::vector<RunInput>& inputs = kInputs) const {
    return {folder_ / "", inputs, earlier};
  }
  /// A stage of three cells; computes what is not kept, and writes down what it computed.
  std::vector<double> squares(const UnfinishedWork& unfinished, double killed_at = 100.0) {
    return unfinished.stage<std::vector<double>>("squares", [&](const Communicator& alone) {
      log_.emplace_back("stage");
      std::vector<WorkCell<double>> cells;
      for (const double of : {2.0, 3.0, 4.0}) {
        cells.push_back({std::to_string(of), [this, of, killed_at] {
                           if (of >= killed_at) throw Interrupted();
                           log_.push_back(std::to_string(of).substr(0, 1));
                           return of * of;
                         }});
      }
      const auto found = compute_cells<double>(cells, alone.share, {}, {}, alone.kept);
      std::vector<double> values;
      for (const auto& [key, value] : found) values.push_back(value);
      return values;
    });
  }
  fs::path folder() const { return folder_ / std::string(kUnfinishedName); }

  std::vector<std::string> log_;

 private:
  TemporaryFolder folder_;
};

const std::vector<double> kSquares = {4.0, 9.0, 16.0};

TEST_F(Unfinishing, GivesBackAStageToTheLastBit) {
  EXPECT_EQ(squares(work()), kSquares);
  log_.clear();
  EXPECT_EQ(squares(work()), kSquares);
  EXPECT_THAT(log_, IsEmpty());
}

TEST_F(Unfinishing, ComputesTheCellsThatAnEndedRunHadNot) {
  const ThreadLimit alone(1);
  EXPECT_THROW(squares(work(), 4.0), Interrupted);
  log_.clear();
  EXPECT_EQ(squares(work()), kSquares);
  EXPECT_THAT(log_, testing::ElementsAre("stage", "4"));
}

// Whichever byte of a kept stage is damaged, it is computed again.
TEST_F(Unfinishing, TakesNoDamagedStage) {
  squares(work());
  fs::path file;
  for (const auto& entry : fs::directory_iterator(folder())) {
    if (entry.path().filename().string().starts_with("squares")) file = entry.path();
  }
  const std::string whole = bytes_of_file(file);
  for (std::size_t i = 0; i < whole.size(); i += 7) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    put(file, damaged);
    log_.clear();
    EXPECT_EQ(squares(work()), kSquares);
    EXPECT_EQ(log_.size(), 4U) << "byte " << i;
  }
}

TEST_F(Unfinishing, IsRefusedUnlessItIsToBeContinuedOrDiscarded) {
  squares(work());
  EXPECT_THAT(refusal([&] { work(Unfinished::refused); }),
              AllOf(HasSubstr("--resume"), HasSubstr("--force"), HasSubstr("unfinished")));
  log_.clear();
  squares(work(Unfinished::discarded));
  EXPECT_EQ(log_.size(), 4U);
}

TEST_F(Unfinishing, OfOtherInputsIsRefusedWithWhatDiffers) {
  squares(work());
  const std::string said = refusal([&] {
    work(Unfinished::continued, {{"--seed", "2"}, {"the map sun", "8x4 34cd"}});
  });
  EXPECT_THAT(said, AllOf(HasSubstr("--seed was 1 and is 2"),
                          HasSubstr("the map sky (8x4 12ab) is left out"),
                          HasSubstr("the map sun (8x4 34cd) is new")));
  log_.clear();
  EXPECT_EQ(squares(work()), kSquares);
  EXPECT_THAT(log_, IsEmpty()) << "a refusal leaves it as it was";
}

TEST_F(Unfinishing, LeavesNothingIfNothingWasKept) {
  { const UnfinishedWork idle = work(); }
  EXPECT_FALSE(fs::exists(folder()));
  EXPECT_THROW(squares(work(), 0.0), Interrupted);
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Unfinishing, GoesAwayOnceTheResultsAreWritten) {
  UnfinishedWork done = work();
  squares(done);
  EXPECT_TRUE(done.holds_something());
  done.remove();
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Unfinishing, IsForOneRunAtATime) {
  UnfinishedWork first = work();
  squares(first);
  for (const Unfinished earlier :
       {Unfinished::refused, Unfinished::continued, Unfinished::discarded}) {
    EXPECT_THAT(refusal([&] { work(earlier); }), HasSubstr("another run"));
  }
}

TEST_F(Unfinishing, TouchesNoFolderOfTheUserOfThatName) {
  fs::create_directory(folder());
  put(folder() / "novel.txt", "mine");
  for (const Unfinished earlier :
       {Unfinished::refused, Unfinished::continued, Unfinished::discarded}) {
    EXPECT_THAT(refusal([&] { work(earlier); }), HasSubstr("move it away"));
  }
  EXPECT_EQ(bytes_of_file(folder() / "novel.txt"), "mine");
}

// A run that was killed before it had written its inputs stands in nobody's way.
TEST_F(Unfinishing, BeginsWhereARunWasKilledAtItsBeginning) {
  fs::create_directory(folder());
  put(folder() / ".inputs-0123456789abcdef.77.part.bin", "half of the inp");
  EXPECT_EQ(squares(work(Unfinished::refused)), kSquares);
}

TEST(NoUnfinishedWork, ComputesAndKeepsNothing) {
  const UnfinishedWork none;
  int computed = 0;
  for (int i = 0; i < 2; ++i) {
    none.stage<double>("stage", [&](const Communicator& alone) {
      EXPECT_FALSE(alone.kept.keep);
      return static_cast<double>(++computed);
    });
  }
  EXPECT_EQ(computed, 2);
}

}  // namespace
}  // namespace lightproof
