// Samples as a file that another program would have written.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/dump/sample_dump.h"
#include "tests/dump/files.h"

namespace lightproof::test {

/// A file of floats, and the dump that it is.
class WrittenDump {
 public:
  /// Rows number 0 to `count` - 1, one after the other, of these columns.
  WrittenDump(std::size_t count, const std::vector<std::string>& names,
              const std::function<std::vector<double>(std::size_t)>& row,
              SampleConvention convention = {}) {
    std::vector<float> numbers;
    numbers.reserve(count * names.size());
    for (std::size_t i = 0; i < count; ++i) {
      for (const double number : row(i)) numbers.push_back(static_cast<float>(number));
    }
    const std::string shape = fmt::format("({}, {})", count, names.size());
    write_bytes(folder_ / "a.npy", npy_header("<f4", shape) + bytes_of(numbers));
    NumberTable table((folder_ / "a.npy").string(), std::nullopt, 0);
    dump_ = std::make_shared<const SampleDump>(std::move(table), sample_columns(names), convention);
  }

  const std::shared_ptr<const SampleDump>& dump() const { return dump_; }

 private:
  TemporaryFolder folder_;
  std::shared_ptr<const SampleDump> dump_;
};

}  // namespace lightproof::test
