#include "lightproof/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/stability/breaking_points.h"

namespace lightproof {
namespace {

bool is_case_asked_for(const StabilityCase& row, const std::vector<std::string>& names) {
  return names.empty() || std::ranges::any_of(names, [&](const std::string& name) {
           return name == row.name || name == fmt::format("{}", row.number);
         });
}

/// The reason why a method cannot pass a case; empty if there is none.
std::string_view limit_of(const StabilityCase& row, std::string_view method) {
  for (const StabilityLimit& limit : row.limits) {
    if (is_method(method, limit.method)) return limit.reason;
  }
  return {};
}

/// The trial, with what it throws as its finding.
template <class Method>
Finding finding_of(MethodTrial<Method> trial, const Method& method, const TrialOptions& options) {
  try {
    return trial(method, options);
  } catch (const InputError& error) {
    return {.outcome = StabilityOutcome::refused, .came_out = error.what()};
  }
}

void check_names(const StabilityMethods& methods, const StabilityOptions& options) {
  for (const std::string& name : options.cases) {
    const auto cases = stability_cases();
    if (std::ranges::any_of(cases,
                            [&](const auto& row) { return is_case_asked_for(row, {name}); })) {
      continue;
    }
    std::string known;
    for (const StabilityCase& row : cases) known += fmt::format(" {}", row.name);
    throw InputError(fmt::format("no stability case is called '{}'; there are:{}", name, known));
  }
  for (const std::string& name : options.methods) {
    bool found = false;
    std::string known;
    for_kinds(methods, [&](std::string_view, const auto& all, auto) {
      for (const auto& method : all) {
        found = found || is_method(method_name(method), name);
        known += fmt::format(" '{}'", method_name(method));
      }
    });
    if (!found) {
      throw InputError(fmt::format("no method is called '{}'; there are:{}", name, known));
    }
  }
}

/// What one method makes of one case.
template <class Method>
StabilityRecord record_of(const StabilityCase& row, std::string_view kind,
                          MethodTrial<Method> trial, const Method& method,
                          const TrialOptions& options) {
  Finding found = finding_of(trial, method, options);
  return {row.number,
          std::string(kind),
          method_name(method),
          has_known_defects(method),
          found.outcome,
          found.amount,
          found.bound,
          found.put_in.empty() ? std::string(row.input) : found.put_in,
          std::move(found.came_out),
          row.may_refuse,
          std::string(limit_of(row, method_name(method)))};
}

using Cells = std::vector<WorkCell<StabilityRecord>>;

/// Adds the cells of one case and one kind of method.
template <class Method>
void add_cells(Cells& cells, const StabilityCase& row, std::string_view kind,
               const std::vector<Method>& methods, MethodTrial<Method> trial,
               const StabilityOptions& options) {
  if (trial == nullptr) return;
  for (const Method& method : methods) {
    if (!is_asked_for(method_name(method), options.methods)) continue;
    cells.push_back({fmt::format("stability/{:02}/{}/{}", row.number, kind, method_name(method)),
                     [&row, kind, trial, &method, trial_options = options.trial] {
                       return record_of(row, kind, trial, method, trial_options);
                     }});
  }
}

/// The cells of all cases, in the order in which their records are shown.
Cells cells_of(const StabilityMethods& methods, const StabilityOptions& options) {
  Cells cells;
  for (const StabilityCase& row : stability_cases()) {
    if (!is_case_asked_for(row, options.cases)) continue;
    for_kinds(methods, [&](std::string_view kind, const auto& all, auto member) {
      add_cells(cells, row, kind, all, row.*member, options);
    });
  }
  return cells;
}

template <class Result>
std::vector<Result> results_of(const std::vector<WorkCell<Result>>& cells, const Progress& progress,
                               const Communicator& communicator) {
  CellResults<Result> all =
      gather(compute_cells<Result>(cells, communicator.share, progress, "stability"), communicator);
  std::vector<Result> ordered;
  for (const WorkCell<Result>& cell : cells) ordered.push_back(std::move(all.at(cell.key)));
  return ordered;
}

}  // namespace

StabilityResult run_stability(const StabilityMethods& methods, const StabilityOptions& options,
                              const Progress& progress, const Communicator& communicator) {
  check_names(methods, options);
  StabilityResult result;
  for (const StabilityCase& row : stability_cases()) {
    if (!is_case_asked_for(row, options.cases)) continue;
    result.cases.push_back({row.number, std::string(row.name), std::string(row.input),
                            std::string(row.required), std::string(row.source)});
  }
  const double share = options.breaking_points ? 0.6 : 1.0;
  result.records =
      results_of(cells_of(methods, options), part_of(progress, 0.0, share), communicator);
  if (options.breaking_points) {
    result.breaking_points = results_of(breaking_point_cells(methods, options),
                                        part_of(progress, share, 1.0), communicator);
  }
  return result;
}

StabilityResult kept_stability(std::uint64_t seed, const MeasurementCache& cache,
                               const Progress& progress) {
  return MeasurementKeeper(cache)
      .get<StabilityResult>("stability", std::to_string(seed),
                            [&] {
                              return run_stability(
                                  all_stability_methods(),
                                  {.trial = {.seed = seed}, .breaking_points = true}, progress);
                            })
      .value;
}

}  // namespace lightproof
