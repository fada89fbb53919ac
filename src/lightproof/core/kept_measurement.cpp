#include "lightproof/core/kept_measurement.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "lightproof/core/machine.h"

namespace lightproof {

std::string origin_now(std::string_view commit) {
  const std::string now =
      fmt::format("{:%Y-%m-%dT%H:%M:%S}+00:00", fmt::gmtime(std::time(nullptr)));
  return fmt::format("{}, {}, {}{}{}", now, machine_name(), LIGHTPROOF_COMPILER,
                     commit.empty() ? "" : ", commit ", commit.substr(0, 12));
}

MeasurementKeeper::MeasurementKeeper(MeasurementCache cache)
    : cache_(std::move(cache)), program_(hash_of_file(cache_.program)) {}

KeptFile MeasurementKeeper::file_of(std::string name, std::string_view dependence) const {
  ValueWriter identity;
  identity.add(program_);
  identity.add(machine_name());
  identity.add(std::string_view(LIGHTPROOF_COMPILER));
  identity.add(cache_.commit);
  identity.add(dependence);
  return {program_ ? cache_.folder : std::filesystem::path(), std::move(name), identity.take()};
}

}  // namespace lightproof
