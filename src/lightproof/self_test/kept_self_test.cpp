#include "lightproof/self_test/kept_self_test.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <vector>

#include "lightproof/core/kept_file.h"
#include "lightproof/core/machine.h"
#include "lightproof/core/random.h"
#include "lightproof/core/serialise.h"

namespace lightproof {
namespace {

/// "2026-11-28T13:41:08+00:00, 2 x processor, GNU 12.2.0, commit 1a2b3c…".
std::string origin_now(const SelfTestCache& cache) {
  const std::string now =
      fmt::format("{:%Y-%m-%dT%H:%M:%S}+00:00", fmt::gmtime(std::time(nullptr)));
  const std::string commit = cache.commit.empty() ? "" : ", commit " + cache.commit.substr(0, 12);
  return fmt::format("{}, {}, {}{}", now, machine_name(), LIGHTPROOF_COMPILER, commit);
}

/// What was measured, and where and when.
template <class Part>
struct Kept {
  std::string origin;
  Part part;

  static auto fields(auto& kept) { return std::tie(kept.origin, kept.part); }
};

template <class Part>
std::optional<Kept<Part>> read(const KeptFile& file) {
  const std::optional<std::string> bytes = read_kept(file);
  if (!bytes) return std::nullopt;
  try {
    ValueReader reader(*bytes);
    auto kept = reader.value<Kept<Part>>();
    return reader.is_at_end() ? std::optional(std::move(kept)) : std::nullopt;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

/// The parts of a self-test that are kept, of one program.
class Keeper {
 public:
  explicit Keeper(const SelfTestCache& cache)
      : cache_(cache), program_(hash_of_file(cache.program)) {}

  /// What is kept under this name for `dependence`, which is more than program and machine; else
  /// what `measure` returns, which is kept then.
  template <class Part, class Measure>
  Kept<Part> get(std::string name, std::string_view dependence, const Measure& measure) const {
    const KeptFile file = {program_ ? cache_.folder : std::filesystem::path(), std::move(name),
                           identity(dependence)};
    if (!cache_.measure_again) {
      if (auto kept = read<Part>(file)) return *std::move(kept);
    }
    const Kept<Part> measured = {origin_now(cache_), measure()};
    ValueWriter writer;
    writer.add(measured);
    keep(file, writer.take());
    return measured;
  }

 private:
  std::string identity(std::string_view dependence) const {
    ValueWriter writer;
    writer.add(program_);
    writer.add(machine_name());
    writer.add(std::string_view(LIGHTPROOF_COMPILER));
    writer.add(cache_.commit);
    writer.add(dependence);
    return writer.take();
  }

  const SelfTestCache& cache_;
  std::optional<std::uint64_t> program_;
};

std::string text_of(const SelfTestOptions& options) {
  ValueWriter writer;
  writer.add(options);
  return writer.take();
}

/// All of a map that the gate sees.
std::string text_of(const EnvironmentMap& map) {
  ValueWriter writer;
  writer.add(map.name);
  for (const double weight : {map.weights.red, map.weights.green, map.weights.blue}) {
    writer.add(weight);
  }
  const Extent extent = map.radiance.extent();
  writer.add(extent.width);
  writer.add(extent.height);
  const std::span<const Rgb> texels = map.radiance.values();
  writer.add(hash_text({reinterpret_cast<const char*>(texels.data()), texels.size_bytes()}));
  return writer.take();
}

}  // namespace

SelfTestResult kept_self_test(std::span<const MapRecord> maps, const SelfTestOptions& options,
                              const SelfTestCache& cache, const Progress& progress) {
  const Keeper keeper(cache);
  const std::string of_options = text_of(options);
  auto [origin, result] = keeper.get<SelfTestResult>(
      "self-test", of_options, [&] { return test_program(options, part_of(progress, 0.0, 0.7)); });
  result.origin = origin;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto from = [&](std::size_t part) {
      return 0.7 + 0.3 * static_cast<double>(part) / static_cast<double>(maps.size());
    };
    const auto named_on =
        keeper.get<std::vector<NamingRecord>>("naming", of_options + text_of(maps[i].map), [&] {
          return measure_naming({&maps[i], 1}, options.naming,
                                named(part_of(progress, from(i), from(i + 1)), "self-test"));
        });
    merge_naming(result.naming, named_on.part);
    // Only the times differ, which are texts in their order.
    result.naming_origin =
        i == 0 ? named_on.origin : std::min(result.naming_origin, named_on.origin);
  }
  return result;
}

}  // namespace lightproof
