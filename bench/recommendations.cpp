// How good recommendations are, on the maps of the command line: every choice against every method,
// measured. Prints each case, and how often errors and times were kept; exit status 1 if that is
// less often than it should be.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "lightproof/core/kept_measurement.h"
#include "lightproof/image/reader.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/recommend/survey.h"
#include "lightproof_commit.h"

namespace lightproof {
namespace {

struct NamedMap {
  std::string name;
  bool was_tuned_on;
};

struct Request {
  std::vector<NamedMap> maps;
  std::vector<std::string> materials;
  std::string receiver = "sphere";
  std::string quality = "default";
  std::string folder;  ///< where the survey is kept; empty: nowhere
  bool verify = true;
};

constexpr const char* kUsage =
    "usage: lightproof_recommendations [--no-verify] [--receiver NAME] [--quality NAME]\n"
    "                                  [--material NAME]... [--keep FOLDER]\n"
    "                                  [--tuned-on MAP]... MAP...\n";

Request parse(const std::vector<std::string>& words) {
  Request request;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool has_value = i + 1 < words.size();
    if (words[i] == "--no-verify") {
      request.verify = false;
    } else if (words[i] == "--receiver" && has_value) {
      request.receiver = words[++i];
    } else if (words[i] == "--quality" && has_value) {
      request.quality = words[++i];
    } else if (words[i] == "--material" && has_value) {
      request.materials.push_back(words[++i]);
    } else if (words[i] == "--keep" && has_value) {
      request.folder = words[++i];
    } else if (words[i] == "--tuned-on" && has_value) {
      request.maps.push_back({words[++i], true});
    } else {
      request.maps.push_back({words[i], false});
    }
  }
  if (request.materials.empty()) {
    request.materials.assign(survey_materials().begin(), survey_materials().end());
  }
  return request;
}

EnvironmentMap map_of(const std::string& name) {
  const auto built_in = std::ranges::find(synthetic_maps(), name, &SyntheticMap::name);
  if (built_in != synthetic_maps().end()) return make_synthetic_map(name, {512, 256});
  return read_environment_map(name, {.repair = Repair::zero});
}

std::string time_text(double seconds) { return fmt::format("{:.3g} us", 1e6 * seconds); }

std::string error_text(double error) {
  return std::isfinite(error) ? fmt::format("{:.2f} %", 100.0 * error) : "not";
}

void print(const SurveyCase& one) {
  fmt::print("{:10} {:10} {:4.0f} %  ", one.map, one.material, 100.0 * one.error);
  if (one.choice) {
    fmt::print("{}, {}: {} predicted, {} verified, {} measured, {}", one.choice->estimator,
               one.choice->samples, error_text(one.choice->predicted_error),
               error_text(one.choice->verified_error), error_text(one.choice->error),
               time_text(one.choice->seconds));
  } else {
    fmt::print("no method");
  }
  fmt::print("; best: {}\n", one.best.empty()
                                 ? "none"
                                 : fmt::format("{}, {}", one.best, time_text(one.best_seconds)));
  std::fflush(stdout);
}

/// Returns whether the goals are reached on these maps; true if there are none.
bool summarise(const char* which, const std::vector<SurveyCase>& cases) {
  if (cases.empty()) return true;
  const SurveyShares shares = shares_of(cases);
  fmt::print(
      "\n{}: {} cases; the error is at most {} times what was asked for in {:.1f} %, the time at "
      "most {} times that of the best in {:.1f} %; {} of them wrongly refused, {} more rightly\n",
      which, shares.answered, kKeptError, 100.0 * shares.errors_kept, kKeptTime,
      100.0 * shares.times_kept, shares.wrongly_refused, shares.rightly_refused);
  const std::vector<SurveyCase> worst = worst_of(cases, 5);
  if (!worst.empty()) fmt::print("the worst:\n");
  for (const SurveyCase& one : worst) print(one);
  return shares.reaches_goals();
}

int run(const Request& request) {
  const ReceiverInfo& receiver = receiver_by_name(request.receiver);
  SurveyOptions options = {.receiver = &receiver};
  options.quality = accuracy_quality_by_name(request.quality);
  options.verify = request.verify;
  std::map<std::string, MethodCosts> costs;
  RecommendationSurvey all = {origin_now(LIGHTPROOF_COMMIT), request.receiver, request.quality, {}};
  for (const auto& [name, was_tuned_on] : request.maps) {
    const EnvironmentMap map = map_of(name);
    for (const std::string& text : request.materials) {
      const NamedMaterial material = {text, material_of(text)};
      const std::string shared = material_of_costs(material.material);
      if (!costs.contains(shared)) {
        costs[shared] = measure_method_costs(material.material, receiver);
      }
      for (SurveyCase& one : survey(map, material, options, costs[shared])) {
        one.was_tuned_on = was_tuned_on;
        print(one);
        all.cases.push_back(std::move(one));
      }
    }
  }
  const bool is_good = summarise("maps that were looked at while building", cases_of(all, true));
  const bool is_good_elsewhere = summarise("other maps", cases_of(all, false));
  if (!request.folder.empty() && !keep_survey(request.folder, all)) {
    fmt::print(stderr, "lightproof_recommendations: {}: the survey cannot be kept there\n",
               request.folder);
    return 2;
  }
  return is_good && is_good_elsewhere ? 0 : 1;
}

}  // namespace
}  // namespace lightproof

int main(int count, char** words) {
  try {
    const auto request = lightproof::parse({words + 1, words + count});
    if (request.maps.empty()) {
      fmt::print(stderr, "{}", lightproof::kUsage);
      return 2;
    }
    return lightproof::run(request);
  } catch (const std::exception& error) {
    fmt::print(stderr, "lightproof_recommendations: {}\n", error.what());
    return 2;
  }
}
