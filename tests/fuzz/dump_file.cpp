// Samples of other programs: .npy, text and raw numbers, by any columns and in any convention.
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/dump/number_table.h"
#include "lightproof/dump/sample_columns.h"
#include "lightproof/dump/sample_convention.h"
#include "lightproof/dump/sample_dump.h"
#include "tests/fuzz/fuzz.h"

namespace lightproof::fuzz {
namespace {

std::vector<std::string> any_names(Input& input, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) {
    names.emplace_back(column_names()[input.below(column_names().size())].name);
  }
  return names;
}

SampleConvention any_convention(Input& input) {
  SampleConvention convention;
  convention.axes = AxisMap::all()[input.below(AxisMap::all().size())];
  convention.preset = presets()[input.below(presets().size())].preset;
  convention.measure = input.below(2) == 0 ? DensityMeasure::solid_angle : DensityMeasure::square;
  return convention;
}

void require_direction(const DumpedSample& sample) {
  const Direction d = sample.direction;
  const bool is_none = std::isnan(d.x) && std::isnan(d.y) && std::isnan(d.z);
  if (!is_none && !(std::abs(glm::dot(d, d) - 1.0) < 1e-9)) fail("a direction that is none");
}

void read(const std::string& file, Input& input) {
  constexpr std::array<std::optional<NumberFormat>, 5> kFormats = {
      std::nullopt, NumberFormat::npy, NumberFormat::floats, NumberFormat::doubles,
      NumberFormat::text};
  const std::optional<NumberFormat> format = kFormats[input.below(kFormats.size())];
  const std::size_t named = input.below(6);
  NumberTable table(file, format, named);
  const std::size_t columns = table.columns();
  if (table.rows() == 0 || columns == 0) fail("a table without numbers was opened");
  if (!table.names().empty() && table.names().size() != columns) fail("names of other columns");
  std::vector<double> numbers(columns);
  table.read(table.rows() - 1, numbers);
  const std::vector<std::string> names =
      input.below(2) == 0 ? default_columns(columns) : any_names(input, columns);
  const SampleDump dump(std::move(table), sample_columns(names), any_convention(input));
  if (!(dump.rounding() > 0.0)) fail("rounding that is none");
  std::vector<DumpedSample> samples(std::min<std::uint64_t>(dump.count(), 4096));
  dump.read(dump.count() - samples.size(), samples);
  for (const DumpedSample& sample : samples) require_direction(sample);
}

}  // namespace
}  // namespace lightproof::fuzz

// The last bytes choose the format and what columns mean: any file is an input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lightproof::fuzz;
  constexpr std::size_t kChoices = 16;
  const MemoryFile file(Input(data, size).text());
  const std::size_t first = size > kChoices ? size - kChoices : 0;
  Input choice(data + first, size - first);
  accepts([&] { read(file.path().string(), choice); });
  return 0;
}
