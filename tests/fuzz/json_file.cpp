// Every kind of JSON file that the program reads: side-cars of dumps, results of Google Benchmark,
// in the history and in a study, and manifests of folders.
#include <cmath>
#include <fstream>
#include <vector>

#include "lightproof/cli/side_car.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/dump/sample_convention.h"
#include "lightproof/history/google_benchmark.h"
#include "lightproof/report/result_folder.h"
#include "lightproof/study/throughput.h"
#include "tests/fuzz/fuzz.h"

namespace lightproof::fuzz {
namespace {

namespace fs = std::filesystem;

/// A folder with a dump "dump" beside which the file lies, which is also the folder's manifest.
class Folder {
 public:
  Folder() {
    std::ofstream(manifest()).flush();
    fs::create_hard_link(manifest(), folder_ / "dump.json");
  }
  void write(std::string_view text) const { std::ofstream(manifest(), std::ios::binary) << text; }
  fs::path folder() const { return folder_ / ""; }
  fs::path manifest() const { return folder_ / kManifestName; }

 private:
  TemporaryFolder folder_;
};

void read_all(const Folder& folder) {
  accepts([&] {
    const auto said = cli::read_side_car((folder.folder() / "dump").string());
    if (!said) fail("a side-car that is there was not read");
    if (!said->axes.empty()) AxisMap::parse(said->axes);
  });
  accepts([&] {
    const BenchmarkRun run = read_google_benchmark(folder.manifest());
    for (const Measurement& m : run.measurements) {
      const bool is_one = m.value > 0.0 && std::isfinite(m.value) && m.repetition >= 0;
      if (!is_one) fail("a measurement that is none: " + m.benchmark);
    }
  });
  accepts([&] { read_throughput(folder.manifest()); });
  accepts([&] {
    for (const std::string& name : listed_files(folder.folder())) {
      if (name.empty() || name.find('/') != std::string::npos) fail("a manifest lists " + name);
    }
  });
}

}  // namespace
}  // namespace lightproof::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lightproof::fuzz;
  static const Folder folder;
  folder.write(Input(data, size).text());
  read_all(folder);
  return 0;
}
