#include "lightproof/self_test/kept_self_test.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "lightproof/core/serialise.h"
#include "lightproof/image/map_identity.h"

namespace lightproof {
namespace {

std::string text_of(const SelfTestOptions& options) {
  ValueWriter writer;
  writer.add(options);
  return writer.take();
}

}  // namespace

SelfTestResult kept_self_test(std::span<const MapRecord> maps, const SelfTestOptions& options,
                              const MeasurementCache& cache, const Progress& progress) {
  const MeasurementKeeper keeper(cache);
  const std::string of_options = text_of(options);
  auto [origin, result] = keeper.get<SelfTestResult>(
      "self-test", of_options, [&] { return test_program(options, part_of(progress, 0.0, 0.7)); });
  result.origin = origin;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto from = [&](std::size_t part) {
      return 0.7 + 0.3 * static_cast<double>(part) / static_cast<double>(maps.size());
    };
    const auto named_on =
        keeper.get<std::vector<NamingRecord>>("naming", of_options + identity_of(maps[i].map), [&] {
          return measure_naming({&maps[i], 1}, options.naming,
                                named(part_of(progress, from(i), from(i + 1)), "self-test"));
        });
    merge_naming(result.naming, named_on.value);
    // Only the times differ, which are texts in their order.
    result.naming_origin =
        i == 0 ? named_on.origin : std::min(result.naming_origin, named_on.origin);
  }
  return result;
}

}  // namespace lightproof
