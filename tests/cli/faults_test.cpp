// What happens around the program and not in its input: it is killed at any moment, the disk is
// full, whoever reads has gone, the system lacks what others have. Each has a message and an exit
// code, and leaves nothing half-written.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <set>
#include <thread>

#include "lightproof/core/atomic_file.h"
#include "lightproof/core/random.h"
#include "lightproof/core/unfinished_work.h"
#include "lightproof/image/reader.h"
#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::microseconds;
using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::uint64_t number_of(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::stoull(text);
}

/// How often a run is killed at a random moment: LIGHTPROOF_FAULTS, of ci/faults.
int kills() { return static_cast<int>(number_of("LIGHTPROOF_FAULTS", 3)); }

/// Moments from LIGHTPROOF_FAULT_SEED.
class Moments {
 public:
  explicit Moments(std::string_view purpose)
      : engine_(number_of("LIGHTPROOF_FAULT_SEED", 1) ^ hash_text(purpose)) {}
  microseconds within(double most_seconds) {
    std::uniform_real_distribution<double> moment(0.0, 1e6 * most_seconds);
    return microseconds(static_cast<long>(moment(engine_)));
  }

 private:
  std::mt19937_64 engine_;
};

/// How a run ends that may take minutes where others share the machine.
Finished run_in_patience(const Words& words, const fs::path& folder) {
  return Process(lightproof_command(words, folder)).wait(10 * kPatience);
}

/// How a run ends that is killed after this time; it may be faster.
Finished killed_after(const Command& command, microseconds time) {
  Process process(command);
  std::this_thread::sleep_for(time);
  process.send(SIGKILL);
  return process.wait();
}

/// How a run ends that is killed so long after it has begun to write its results, or right away if
/// it was faster.
Finished killed_while_writing(const Command& command, const fs::path& folder, microseconds time) {
  Process process(command);
  const fs::path part = folder / fmt::format(".{}.part", process.id());
  const auto is_done = [&] {
    return fs::exists(folder / "manifest.json") && !fs::exists(folder / kUnfinishedName);
  };
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!fs::exists(part) && !is_done() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(microseconds(100));
  }
  std::this_thread::sleep_for(time);
  process.send(SIGKILL);
  return process.wait();
}

constexpr int kKilled = 128 + SIGKILL;

/// Names under which results lie: without unfinished work and parts.
Words results_in(const fs::path& folder) {
  Words names = fs::exists(folder) ? names_in(folder) : Words();
  std::erase_if(names,
                [](const std::string& name) { return name == kUnfinishedName || is_part(name); });
  return names;
}

/// A file of these bytes is whole, as far as its end can tell.
void expect_whole(const fs::path& file) {
  const std::string bytes = bytes_of(file);
  const std::string kind = file.extension();
  if (kind == ".json") {
    EXPECT_FALSE(json::parse(bytes, nullptr, false).is_discarded()) << file;
  } else if (kind == ".html") {
    EXPECT_THAT(bytes, HasSubstr("</html>")) << file;
  } else if (kind == ".csv") {
    EXPECT_TRUE(bytes.ends_with('\n')) << file;
  } else if (file.filename() != "brdf-map.exr") {  // of two channels
    EXPECT_NO_THROW(read_environment_map(file, {.repair = Repair::zero, .any_aspect = true}))
        << file;
  }
}

/// A command that is killed again and again, and resumed each time.
struct Chain {
  std::string purpose;
  Words words;
  std::string output;  ///< folder of the results
  double seconds;      ///< that an uninterrupted run takes
};

/// Kills the run at random moments, the second half of them while it writes, when all is computed,
/// looks at what is there each time, and lets the last one end.
void kill_and_resume(const Chain& chain, const fs::path& folder) {
  Moments moments(chain.purpose);
  Words resumed = chain.words;
  resumed.emplace_back("--resume");
  const fs::path output = folder / chain.output;
  for (int killed = 0; killed < kills();) {
    const Command command = lightproof_command(resumed, folder);
    const bool while_writing = killed >= kills() / 2;
    const Finished run = while_writing
                             ? killed_while_writing(command, output, moments.within(0.05))
                             : killed_after(command, moments.within(0.35 * chain.seconds));
    for (const std::string& name : results_in(output)) expect_whole(output / name);
    if (run.exit_code == kKilled) {
      ++killed;
      continue;
    }
    ASSERT_EQ(run.exit_code, 0) << run.err;
    ASSERT_FALSE(fs::exists(output / kUnfinishedName));
    fs::remove_all(output);
    if (while_writing) ++killed;  // it was faster than any eye
  }
  const Finished last = run_in_patience(resumed, folder);
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_THAT(parts_in(output), IsEmpty());
  EXPECT_FALSE(fs::exists(output / kUnfinishedName));
}

// What a study finds, without what was measured in time: pictures have as many samples as fit into
// it.
json without_times(json results) {
  for (const char* key : {"command", "renders", "throughput_origin", "recommendations",
                          "refused_recommendations", "methods", "self_test_origin"}) {
    results.erase(key);
  }
  const std::function<void(json&)> drop = [&](json& value) {
    if (value.is_object()) {
      for (auto entry = value.begin(); entry != value.end();) {
        const std::string& key = entry.key();
        if (key.find("seconds") != std::string::npos || key == "origin" || key == "ms") {
          entry = value.erase(entry);
        } else {
          drop(*entry);
          ++entry;
        }
      }
    } else if (value.is_array()) {
      for (json& each : value) drop(each);
    }
  };
  drop(results);
  return results;
}

Words tiny_study(const std::string& output) {
  Words words = {"study",
                 "sun-sky",
                 "--size",
                 "16x8",
                 "-n",
                 "1024",
                 "--receiver",
                 "point",
                 "--no-throughput",
                 "--no-self-test",
                 "--no-regimes",
                 "--no-stability",
                 "-q",
                 "-o",
                 output};
  return words;
}

// The quick form, a study in the test's own process, is in tests/study.
TEST(Killed, StudyLeavesNothingHalfAndGoesOnToTheSameBits) {
  if (number_of("LIGHTPROOF_FAULTS", 0) == 0) GTEST_SKIP() << "takes minutes: ci/faults";
  const TemporaryFolder folder;
  const Finished whole = run_in_patience(tiny_study("whole"), folder / "");
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  kill_and_resume({"study", tiny_study("again"), "again", whole.seconds}, folder / "");
  EXPECT_EQ(results_in(folder / "again"), results_in(folder / "whole"));
  const json once = without_times(json_of(folder / "whole/results.json"));
  const json resumed = without_times(json_of(folder / "again/results.json"));
  for (const auto& [key, value] : once.items()) {
    EXPECT_TRUE(resumed.at(key) == value) << key;
  }
  for (const char* table : {"gate.csv", "convergence.csv", "variance.csv", "split_sum.csv",
                            "points.csv", "maps.csv", "published.csv"}) {
    EXPECT_EQ(bytes_of(folder / "again" / table), bytes_of(folder / "whole" / table)) << table;
  }
}

Words small_maps(const std::string& output) {
  return {"precompute",  "sun-sky",   "--map-size", "64x32",          "--method",
          "half-vector", "--samples", "512",        "--size",         "64x32",
          "--levels",    "6",         "--check",    "--check-texels", "8",
          "-q",          "-o",        output};
}

/// Of a folder of precomputed maps: what is not the command line.
json made_in(const fs::path& folder) {
  json made = json_of(folder / "precompute.json");
  made.erase("command");
  return made;
}

TEST(Killed, PrecomputeLeavesNothingHalfAndGoesOnToTheSameBits) {
  const TemporaryFolder folder;
  const Finished whole = lightproof(small_maps("whole"), folder / "");
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  kill_and_resume({"precompute", small_maps("again"), "again", whole.seconds}, folder / "");
  EXPECT_EQ(results_in(folder / "again"), results_in(folder / "whole"));
  for (const std::string& name : results_in(folder / "whole")) {
    if (name.ends_with(".json")) continue;
    EXPECT_EQ(bytes_of(folder / "again" / name), bytes_of(folder / "whole" / name)) << name;
  }
  EXPECT_EQ(made_in(folder / "again"), made_in(folder / "whole"));
}

/// A run that is interrupted as soon as it has kept something, in "out".
Finished interrupted(const Words& words, const fs::path& folder, int signal = SIGTERM) {
  Process process(lightproof_command(words, folder));
  const fs::path kept = folder / "out" / kUnfinishedName;
  const auto holds_parts = [&] {
    std::error_code error;
    return fs::exists(kept, error) && names_in(kept).size() > 2;
  };
  for (int i = 0; i < 30000 && !holds_parts(); ++i) std::this_thread::sleep_for(microseconds(1000));
  process.send(signal);
  return process.wait();
}

Words long_maps() {
  return {"precompute",  "sun-sky",    "--map-size", "64x32", "--method",
          "half-vector", "--specular", "--samples",  "65536", "--size",
          "128x64",      "--levels",   "8",          "-o",    "out"};
}

TEST(Unfinished, WorkIsKeptByEverySignalThatAsksForAnEnd) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const Finished ended = interrupted(long_maps(), folder / "", signal);
    EXPECT_EQ(ended.exit_code, 128 + signal) << ended.err;
    EXPECT_THAT(ended.err, AllOf(HasSubstr("interrupted"), HasSubstr("--resume"),
                                 HasSubstr("out/unfinished")));
    EXPECT_EQ(names_in(folder / "out"), Words{"unfinished"});
  }
}

TEST(Unfinished, WorkIsNotTouchedUnlessItIsToBe) {
  const TemporaryFolder folder;
  interrupted(long_maps(), folder / "");
  const Finished refused = lightproof(long_maps(), folder / "");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("--resume goes on"), HasSubstr("--force begins anew"),
                                 HasSubstr("This would go on: "), HasSubstr("out --resume")));
  Words other = long_maps();
  other.insert(other.end(), {"--samples", "256", "--resume"});
  const Finished differs = lightproof(other, folder / "");
  EXPECT_EQ(differs.exit_code, 2);
  EXPECT_THAT(differs.err, HasSubstr("--samples was 65536 and is 256"));
  other.back() = "--force";
  EXPECT_EQ(lightproof(other, folder / "").exit_code, 0);
  EXPECT_THAT(names_in(folder / "out"),
              AllOf(Contains("specular.exr"), Not(Contains("unfinished"))));
}

TEST(Unfinished, StudyOfOtherInputsIsRefusedWithWhatDiffers) {
  const TemporaryFolder folder;
  write_map(folder / "sky.exr", {32, 16});
  const Words study = {"study", "sky.exr", "--no-throughput", "--no-accuracy",
                       "-n",    "1024",    "--no-self-test",  "-q",
                       "-o",    "out",     "--resume"};
  const Finished ended = interrupted(study, folder / "");
  ASSERT_EQ(ended.exit_code, 143) << ended.err;
  Words other = study;
  other.insert(other.end(), {"--seed", "2"});
  EXPECT_THAT(lightproof(other, folder / "").err, HasSubstr("--seed was 1 and is 2"));
  write_map(folder / "sky.exr", {32, 16}, [](Grid<Rgb>& picture) { picture(3, 1) = Rgb(7.0F); });
  const Finished refused = lightproof(study, folder / "");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("the map sky was 32x16 "));
}

TEST(Unfinished, WorkIsThatOfOneRunAtATime) {
  const TemporaryFolder folder;
  Process first(lightproof_command(long_maps(), folder / ""));
  const fs::path kept = folder / "out" / kUnfinishedName;
  for (int i = 0; i < 30000 && !(fs::exists(kept) && names_in(kept).size() > 2); ++i) {
    std::this_thread::sleep_for(microseconds(1000));
  }
  for (const char* way : {"--resume", "--force"}) {
    Words words = long_maps();
    words.emplace_back(way);
    const Finished second = lightproof(words, folder / "");
    EXPECT_EQ(second.exit_code, 2) << way;
    EXPECT_THAT(second.err, HasSubstr("another run")) << way;
  }
  first.send(SIGTERM);
  EXPECT_EQ(first.wait().exit_code, 143);
}

/// A shell command line in which "$@" is the program with these arguments.
Finished in_shell(const std::string& script, const Words& arguments, const fs::path& folder,
                  const Words& environment = {}) {
  Command command = lightproof_command(arguments, folder);
  command.words.insert(command.words.begin(), {"bash", "-c", script, "bash"});
  for (const std::string& variable : environment) command.environment.push_back(variable);
  return run(command);
}

const Words kGate = {"gate", "constant", "-n",  "1024",   "--must-detect",
                     "10",   "--size",   "8x4", "--json", "g.json"};
Words maps_of(const std::string& size) {
  return {"precompute", "sky.exr", "--size", size, "--levels", "2", "-o", "out"};
}
const Words kMaps = maps_of("8x4");

class Surroundings : public testing::Test {
 protected:
  void SetUp() override { write_map(path("sky.exr"), {16, 8}); }
  fs::path path(const std::string& name = "") const { return folder_ / name; }
  Finished shell(const std::string& script, const Words& arguments,
                 const Words& environment = {}) const {
    return in_shell(script, arguments, path(), environment);
  }
  void expect_all_maps() const {
    EXPECT_THAT(names_in(path("out")), AllOf(Contains("specular.exr"), Contains("manifest.json"),
                                             Not(Contains("unfinished"))));
    EXPECT_THAT(parts_in(path("out")), IsEmpty());
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Surroundings, WithoutAReaderOfThePrintedTableFilesAreWhole) {
  const Finished gone = shell(R"("$@" | true; exit ${PIPESTATUS[0]})", kGate);
  EXPECT_THAT(gone.exit_code, AnyOf(0, 128 + SIGPIPE)) << gone.err;
  if (fs::exists(path("g.json"))) {
    EXPECT_EQ(json_of(path("g.json")).at("outcome"), "accept");
  }
  EXPECT_THAT(parts_in(path()), IsEmpty());
}

TEST_F(Surroundings, WithoutAReaderOfMuchThatIsPrintedEndBySigpipe) {
  const Finished slow =
      shell(R"({ sleep 1; "$@"; echo $? > code; } | true; exit $(cat code))", {"gate", "--help"});
  EXPECT_EQ(slow.exit_code, 128 + SIGPIPE) << slow.err;
  EXPECT_THAT(slow.err, IsEmpty());
}

TEST_F(Surroundings, WithSigpipeIgnoredAClosedPipeIsNamed) {
  const Finished gone =
      shell(R"(trap '' PIPE; { sleep 1; "$@"; echo $? > code; } | true; exit $(cat code))",
            {"gate", "--help"});
  EXPECT_EQ(gone.exit_code, 2);
  EXPECT_THAT(gone.err, AllOf(HasSubstr("standard output"), HasSubstr("Broken pipe")));
}

// Whoever watches may leave: a run of hours ends in good order, and can be gone on with.
TEST_F(Surroundings, WithoutAReaderOfProgressTheRunEndsInGoodOrder) {
  Words words = long_maps();
  words.insert(words.end(), {"--progress", "1"});
  const Finished gone =
      shell(R"({ "$@" 2>&1 >/dev/null; echo $? > code; } | true; exit $(cat code))", words);
  EXPECT_EQ(gone.exit_code, 128 + SIGPIPE);
  EXPECT_EQ(names_in(path("out")), Words{"unfinished"});
}

TEST_F(Surroundings, WithNoRoomForProgressResultsAreWhole) {
  Words words = {"gate", "sun-sky",    "--size", "64x32",  "-n",
                 "2^20", "--progress", "1",      "--json", "g.json"};
  const Finished full = shell(R"("$@" 2>/dev/full)", words);
  EXPECT_EQ(full.exit_code, 0);
  EXPECT_EQ(json_of(path("g.json")).at("outcome"), "accept");
  EXPECT_EQ(shell(R"("$@" 2>/dev/full)", {"gate", "none.exr"}).exit_code, 2);
}

// A closed descriptor is the next that a file gets: what is printed must not get into it.
TEST_F(Surroundings, WithClosedStreamsNothingIsPrintedIntoFiles) {
  Words words = kGate;
  words[1] = "sky.exr";
  EXPECT_EQ(shell(R"("$@" <&- 2>&-)", words).exit_code, 0);
  EXPECT_EQ(json_of(path("g.json")).at("outcome"), "accept");
  const Finished closed = shell(R"("$@" <&- >&-)", words);
  EXPECT_EQ(closed.exit_code, 2);
  EXPECT_THAT(closed.err, HasSubstr("cannot write to the standard output"));
  EXPECT_EQ(shell(R"("$@" <&- >&- 2>&-)", words).exit_code, 2);
  EXPECT_EQ(json_of(path("g.json")).at("outcome"), "accept");
}

TEST_F(Surroundings, WithSigchldIgnoredPicturesAreReadAndWritten) {
  const Finished made = shell(R"(trap '' CHLD; exec "$@")", kMaps);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  expect_all_maps();
}

TEST_F(Surroundings, WithoutATerminalOrEnvironment) {
  const Finished made = shell(R"(exec env -i setsid --wait "$@" </dev/null)", kMaps);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  expect_all_maps();
  if (number_of("LIGHTPROOF_FAULTS", 0) == 0) return;
  // What it measures is kept nowhere.
  const Finished kept = shell(R"(exec env -i "$@")", {"recommend", "sky.exr", "--material",
                                                      "lambert", "--error", "20%", "-q"});
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
}

TEST_F(Surroundings, WithoutProc) {
  if (!has_mount_namespaces()) GTEST_SKIP() << "mount namespaces are not available here";
  const Finished made =
      run(in_mount_namespace(R"(mount -t tmpfs none /proc && exec "$@")", kMaps, path()));
  EXPECT_EQ(made.exit_code, 0) << made.err;
  expect_all_maps();
  Words words = kGate;
  words[1] = "sky.exr";
  EXPECT_EQ(
      run(in_mount_namespace(R"(mount -t tmpfs none /proc && exec "$@")", words, path())).exit_code,
      0);
}

TEST_F(Surroundings, WithDecimalCommasNumbersAreTheSame) {
  const fs::path locale = path("de_DE.UTF-8");
  if (shell("localedef -i de_DE -f UTF-8 \"$2\"", {locale.string()}).exit_code != 0) {
    GTEST_SKIP() << "the package locales is not installed";
  }
  const Words german = {"LOCPATH=" + path().string(), "LC_ALL=de_DE.UTF-8", "LANGUAGE=de"};
  ASSERT_EQ(shell("locale decimal_point", {}, german).out, ",\n");
  Words gate = {"gate", "sky.exr", "-n", "1024", "--must-detect", "10.5", "-q", "--json", "g.json"};
  ASSERT_EQ(shell(R"("$@")", gate).exit_code, 0);
  const std::string usual = bytes_of(path("g.json"));
  ASSERT_EQ(shell(R"("$@")", gate, german).exit_code, 0);
  EXPECT_EQ(bytes_of(path("g.json")), usual);
  ASSERT_EQ(shell(R"("$@")", kMaps).exit_code, 0);
  fs::rename(path("out"), path("usual"));
  const Finished made = shell(R"("$@")", kMaps, german);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const std::string& name : names_in(path("usual"))) {
    EXPECT_EQ(bytes_of(path("out/" + name)), bytes_of(path("usual/" + name))) << name;
  }
}

/// A limit of the size of files, in kilobytes.
std::string limited(int kilobytes) { return fmt::format("ulimit -f {}; \"$@\"", kilobytes); }

TEST_F(Surroundings, WithALimitOfFileSizesTheFileIsNamedAndNothingIsLeft) {
  const Finished maps = shell(limited(16), maps_of("128x64"));
  EXPECT_EQ(maps.exit_code, 2) << maps.err;
  EXPECT_THAT(maps.err, AllOf(StartsWith("lightproof: out/"), HasSubstr("File too large")));
  EXPECT_THAT(results_in(path("out")), IsEmpty());
  EXPECT_THAT(parts_in(path("out")), IsEmpty());

  write_bytes(path("g.json"), "earlier");
  Words gate = {"gate", "-q",     "-n",  "1024",   "--must-detect",
                "10",   "--size", "8x4", "--json", "g.json"};
  const Finished judged = shell(limited(16), gate);
  EXPECT_EQ(judged.exit_code, 2);
  EXPECT_THAT(judged.err, AllOf(StartsWith("lightproof: g.json"), HasSubstr("File too large")));
  EXPECT_EQ(bytes_of(path("g.json")), "earlier");
  EXPECT_THAT(parts_in(path()), IsEmpty());
}

TEST_F(Surroundings, WithAFullDiskPrecomputeNamesFileAndReason) {
  if (!has_mount_namespaces()) GTEST_SKIP() << "mount namespaces are not available here";
  fs::create_directory(path("out"));
  const Words words = maps_of("64x32");
  for (const int kilobytes : {4, 64, 128}) {
    const std::string script = fmt::format(
        "mount -t tmpfs -o size={}k none out && \"$@\"; code=$?; ls -A out; exit $code", kilobytes);
    const Finished full = run(in_mount_namespace(script, words, path()));
    EXPECT_EQ(full.exit_code, 2) << kilobytes;
    EXPECT_THAT(full.err,
                AllOf(StartsWith("lightproof: out"), HasSubstr("No space left on device")))
        << kilobytes;
    EXPECT_THAT(full.out, AnyOf("", "unfinished\n")) << kilobytes;
  }
}

TEST_F(Surroundings, WhereAFolderIsDueAFileIsRefusedAndTheOtherWayRound) {
  write_bytes(path("file"), "mine");
  fs::create_directory(path("folder"));
  const std::pair<Words, const char*> cases[] = {
      {{"precompute", "sky.exr", "-o", "file"}, "file"},
      {{"precompute", "sky.exr", "-o", "/proc/none"}, "/proc/none"},
      {{"precompute", "folder", "-o", "new"}, "folder"},
      {{"study", "sky.exr", "--no-throughput", "-o", "/proc/none"}, "/proc/none"},
      {{"gate", "sky.exr", "--rejections", "file"}, "file"},
      {{"gate", "sky.exr", "--junit", "folder"}, "folder"},
      {{"stability", "--html", "folder"}, "folder"},
      {{"history", "trend", "--db", "folder", "-o", "t.html"}, "folder"},
      {{"check", "folder", "--map", "sky.exr"}, "folder"},
      {{"info", "folder"}, "folder"},
  };
  for (const auto& [words, named] : cases) {
    const Finished refused = lightproof(words, path());
    EXPECT_EQ(refused.exit_code, 2) << words[0] << " " << named;
    EXPECT_THAT(refused.err, AllOf(StartsWith("lightproof: "), HasSubstr(named))) << words[0];
    EXPECT_LT(refused.seconds, 5.0) << words[0];
  }
  EXPECT_EQ(bytes_of(path("file")), "mine");
  EXPECT_THAT(names_in(path("folder")), IsEmpty());
  EXPECT_FALSE(fs::exists(path("new")));
}

TEST_F(Surroundings, AMapThatVanishesOnceItWasReadIsNotMissed) {
  Process process(
      lightproof_command({"precompute", "sky.exr", "--method", "half-vector", "--samples", "4096",
                          "--specular", "--size", "64x32", "--levels", "6", "--check", "-o", "out"},
                         path()));
  for (int i = 0; i < 30000 && !fs::exists(path("out/unfinished")); ++i) {
    std::this_thread::sleep_for(microseconds(1000));
  }
  fs::remove(path("sky.exr"));
  const Finished made = process.wait();
  EXPECT_EQ(made.exit_code, 0) << made.err;
  expect_all_maps();
}

// The first map takes a while to be made.
TEST_F(Surroundings, AMapThatVanishesBeforeItIsReadIsNamed) {
  const Finished refused = shell(
      R"("$@" & process=$!; sleep 0.1; rm sky.exr; wait $process)",
      {"gate", "sun-sky", "sky.exr", "--size", "8192x4096", "-n", "1024", "--json", "g.json"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(StartsWith("lightproof: sky.exr"), HasSubstr("no such file")));
  EXPECT_THAT(names_in(path()), IsEmpty());
}

TEST_F(Surroundings, AFolderThatVanishesDuringTheRunIsNamed) {
  Process process(lightproof_command(long_maps(), path()));
  for (int i = 0; i < 30000 && !fs::exists(path("out/unfinished")); ++i) {
    std::this_thread::sleep_for(microseconds(1000));
  }
  fs::remove_all(path("out"));
  const Finished refused = process.wait();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(StartsWith("lightproof: out/"), HasSubstr("No such file")));
  EXPECT_FALSE(fs::exists(path("out")));
}

}  // namespace
}  // namespace lightproof::test
