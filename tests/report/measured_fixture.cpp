#include "measured_fixture.h"

#include <cmath>
#include <limits>
#include <string>

namespace lightproof::testing {
namespace {

FrameErrorRecord frame_error(const std::string& name, bool is_float, bool is_nadir,
                             double distance) {
  FrameErrorRecord record{name, "a book", is_float, is_nadir, distance, is_float ? 1e-7 : 1e-16};
  if (name != "bent" || !is_nadir) return record;
  record.error = distance > 1e-6 ? distance : std::numeric_limits<double>::infinity();
  return record;
}

PointRate rate(const std::string& set, const std::string& kind, const std::string& roughness,
               double exponent) {
  PointRate record{set, kind, roughness + " thing", roughness, 128, {}, exponent, 0.02};
  for (const std::uint64_t points : {16U, 256U, 4096U}) {
    const double error =
        std::isnan(exponent) ? 0.0 : std::pow(static_cast<double>(points), exponent);
    record.errors.push_back({points, error, 0.05 * error, 0.5});
  }
  return record;
}

LevelCost cost(const std::string& map, const std::string& method, const std::string& setting,
               double error, double milliseconds) {
  return {map,
          {1024, 512},
          "irradiance",
          {64, 32},
          method,
          setting,
          error,
          0.0,
          2.0 * error,
          64,
          {milliseconds, 0.9 * milliseconds, 1.5 * milliseconds}};
}

}  // namespace

std::vector<FrameErrorRecord> synthetic_frames() {
  std::vector<FrameErrorRecord> frames;
  for (const char* name : {"straight", "bent"}) {
    for (const bool is_float : {true, false}) {
      for (const bool is_nadir : {true, false}) {
        for (const double distance : {1e-6, 1e-3, 0.1, 1.0}) {
          frames.push_back(frame_error(name, is_float, is_nadir, distance));
        }
      }
    }
  }
  return frames;
}

PointStudy synthetic_points() {
  PointStudy points;
  for (const auto& [set, kind, smooth] :
       {std::tuple{"random", "random", -0.5}, std::tuple{"steep", "net", -1.5},
        std::tuple{"exact", "lattice", std::nan("")}}) {
    points.rates.push_back(rate(set, kind, "smooth", smooth));
    points.rates.push_back(rate(set, kind, "edge", 0.5 * smooth - 0.2));
    for (const std::uint64_t count : {64U, 1024U}) {
      const double even = kind == std::string("net") ? 0.1 : 1.0;
      const double n = static_cast<double>(count);
      points.discrepancies.push_back(
          {set, kind, count, even / std::sqrt(n), 0.3 * even / std::sqrt(n), 0.37 / std::sqrt(n)});
    }
  }
  for (std::uint64_t first = 1; first < 1U << 25U; first *= 2) {
    const std::uint64_t left = std::max<std::uint64_t>(1, (1U << 24U) / (first + 256U));
    points.decay.push_back({"shaky", first, 65536, left * left, left, left, 1e-3, 1e-3});
    points.decay.push_back({"steady", first, 65536, 65536, 65536, 65536, 0.0, 0.0});
  }
  return points;
}

LevelCosts synthetic_level_costs() {
  LevelCosts costs;
  for (const char* map : {"city", "courtyard"}) {
    costs.levels.push_back(cost(map, "half-vector", "64 samples", 0.2, 4.0));
    costs.levels.push_back(cost(map, "half-vector", "1024 samples", 0.05, 64.0));
    costs.levels.push_back(cost(map, "slow and wrong", "", 0.5, 200.0));
    costs.levels.push_back(cost(map, "closed form", "", 4e-8, 8.0));
  }
  costs.gains = {{"chain of levels", {10.0, 9.0, 12.0}, {5.0, 4.5, 6.0}, 2.5}};
  costs.origin = "2026-11-28T13:41:08+00:00, 2 x processor, GNU 12.2.0";
  return costs;
}

StabilityResult synthetic_stability() {
  StabilityResult stability;
  stability.cases = {{3, "black-map", "a black map", "an error", "a lecture"},
                     {8, "zero-numbers", "random numbers of 0", "a lit texel", "a <lecture>"}};
  const auto add = [&](int number, const char* method, StabilityOutcome outcome, double amount) {
    StabilityRecord record{number, "sampler",  method,     false,       outcome, amount,
                           0.5,    "put <in>", "came out", number == 3, ""};
    record.known_defects = record.method == "published";
    if (record.method == "limited" && !passes(record)) record.limit = "by its nature";
    stability.records.push_back(record);
  };
  add(3, "steady", StabilityOutcome::refused, 0.0);
  add(3, "published", StabilityOutcome::not_a_number, std::nan(""));
  add(3, "limited", StabilityOutcome::right, 0.0);
  add(3, "broken", StabilityOutcome::out_of_range, 0.0);
  add(8, "steady", StabilityOutcome::right, 0.0);
  add(8, "published", StabilityOutcome::wrong, 0.7);
  add(8, "limited", StabilityOutcome::wrong, 0.001);
  add(8, "broken", StabilityOutcome::not_applicable, 0.0);
  const auto point = [](const char* method, std::optional<double> passed,
                        std::optional<double> failed) {
    return BreakingPoint{"contrast", "the sky is kept", "sampler", method, false, 1.0, 1e12, passed,
                         failed};
  };
  stability.breaking_points = {point("steady", 1e12, std::nullopt), point("published", 1e6, 1.05e6),
                               point("broken", std::nullopt, 1.0)};
  return stability;
}

}  // namespace lightproof::testing
