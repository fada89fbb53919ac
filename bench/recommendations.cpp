// How good recommendations are, on the maps of the command line: every choice against every method,
// measured. Prints each case, and how often errors and times were kept.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "lightproof/image/reader.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/recommend/survey.h"

namespace lightproof {
namespace {

struct Request {
  std::vector<std::string> maps;
  std::vector<std::string> materials;
  std::string receiver = "sphere";
  std::string quality = "default";
  bool verify = true;
};

constexpr const char* kUsage =
    "usage: lightproof_recommendations [--no-verify] [--receiver NAME] [--quality NAME]\n"
    "                                  [--material NAME]... MAP...\n";

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
    } else {
      request.maps.push_back(words[i]);
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

void print(const SurveyCase& one) {
  fmt::print("{:10} {:10} {:4.0f} %  ", one.map, one.material, 100.0 * one.error);
  if (one.choice) {
    fmt::print("{}, {}: {:.2f} % predicted, {:.2f} % measured, {}", one.choice->estimator,
               one.choice->samples, 100.0 * one.choice->predicted_error,
               100.0 * one.choice->measured_error, time_text(one.choice_seconds));
  } else {
    fmt::print("no method");
  }
  fmt::print("; best: {}\n", one.best.empty()
                                 ? "none"
                                 : fmt::format("{}, {}", one.best, time_text(one.best_seconds)));
  std::fflush(stdout);
}

/// How much worse than it should be, 1 for what is just kept.
double badness(const SurveyCase& one) {
  if (one.error_is_kept() && one.time_is_kept()) return 0.0;
  if (!one.choice) return 1e6;
  const double error = one.choice->measured_error / one.error / 1.1;
  const double time = one.best.empty() ? 0.0 : one.choice_seconds / one.best_seconds / 1.5;
  return std::max(error, time);
}

void summarise(std::vector<SurveyCase> cases) {
  const auto share = [&](auto kept) {
    return 100.0 * static_cast<double>(std::ranges::count_if(cases, kept)) /
           static_cast<double>(cases.size());
  };
  fmt::print(
      "\n{} cases: the error is at most 1.1 times what was asked for in {:.1f} %, the time "
      "at most 1.5 times that of the best in {:.1f} %\n",
      cases.size(), share([](const SurveyCase& one) { return one.error_is_kept(); }),
      share([](const SurveyCase& one) { return one.time_is_kept(); }));
  std::ranges::sort(cases, std::greater(), badness);
  fmt::print("the worst five:\n");
  for (std::size_t i = 0; i < std::min<std::size_t>(5, cases.size()); ++i) {
    if (badness(cases[i]) > 0.0) print(cases[i]);
  }
}

int run(const Request& request) {
  const ReceiverInfo& receiver = receiver_by_name(request.receiver);
  SurveyOptions options = {.receiver = &receiver};
  options.quality = accuracy_quality_by_name(request.quality);
  options.verify = request.verify;
  std::map<std::string, MethodCosts> costs;
  std::vector<SurveyCase> all;
  for (const std::string& name : request.maps) {
    const EnvironmentMap map = map_of(name);
    for (const std::string& text : request.materials) {
      const NamedMaterial material = {text, material_of(text)};
      const std::string kind = text.substr(0, text.find(':'));
      if (!costs.contains(kind)) costs[kind] = measure_method_costs(material.material, receiver);
      for (SurveyCase& one : survey(map, material, options, costs[kind])) {
        print(one);
        all.push_back(std::move(one));
      }
    }
  }
  if (!all.empty()) summarise(std::move(all));
  return 0;
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
