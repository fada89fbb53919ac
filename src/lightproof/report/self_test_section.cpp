// The gate tested on itself: mutants, calibration, power.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/sections.h"
#include "lightproof/report/self_test_charts.h"

namespace lightproof {
namespace {

/// The fewest samples with which a test of the mutant's own oracle rejects; none if none does.
std::optional<std::uint64_t> own_kill(const KillRecord& mutant) {
  std::optional<std::uint64_t> fewest;
  for (const KillRecord::Kill& kill : mutant.kills) {
    if (describe(kill.test).oracle != mutant.oracle) continue;
    fewest = std::min(fewest.value_or(kill.samples), kill.samples);
  }
  return fewest;
}

std::string kill_finding(const std::vector<KillRecord>& mutants) {
  const auto killed = std::count_if(mutants.begin(), mutants.end(),
                                    [](const KillRecord& m) { return own_kill(m).has_value(); });
  const auto named = std::count_if(mutants.begin(), mutants.end(), [](const KillRecord& m) {
    return m.looks_like == m.expected_diagnosis;
  });
  std::uint64_t most = 0;
  for (const KillRecord& mutant : mutants) most = std::max(most, own_kill(mutant).value_or(0));
  return fmt::format(
      "{} of {} injected defects are rejected by the oracle that should, with at most {} samples; "
      "{} are called by their right name",
      killed, mutants.size(), with_thousands(most), named);
}

Cell samples_cell(const std::optional<std::uint64_t>& samples) {
  return samples ? Cell{with_thousands(*samples), "number", ""} : Cell{"\u2013", "number", ""};
}

std::string kill_table(const std::vector<KillRecord>& mutants) {
  Table table("Injected defects", {"Mutant", "Oracle", "Samples for its oracle", "Sequential gate",
                                   "Looks like", "Tests that reject"});
  for (const KillRecord& m : mutants) {
    const bool right = m.looks_like == m.expected_diagnosis;
    table.add({text_cell(m.mutant),
               text_cell(std::string(to_string(m.oracle))),
               samples_cell(own_kill(m)),
               samples_cell(m.sequential),
               {m.looks_like + (right ? "" : " (should be " + m.expected_diagnosis + ")"),
                right ? "" : "reject", ""},
               {std::to_string(m.kills.size()), "number", ""}});
  }
  return table.html();
}

/// Sums over all mutants.
NamingRecord total_of(const std::vector<NamingRecord>& naming) {
  NamingRecord total;
  for (const NamingRecord& r : naming) {
    total.runs += r.runs;
    total.rejected += r.rejected;
    total.right += r.right;
    total.unknown += r.unknown;
    total.wrong += r.wrong;
  }
  return total;
}

std::string naming_finding(const std::vector<NamingRecord>& naming, const std::string& origin) {
  const NamingRecord total = total_of(naming);
  const auto share = [&](std::uint64_t count) {
    return percent(static_cast<double>(count) /
                   static_cast<double>(std::max<std::uint64_t>(1, total.rejected)));
  };
  return fmt::format(
      "Of {} rejections of injected defects on the maps of this study, {} are called by their "
      "right name, {} by a wrong one, and of {} the diagnosis says that no known defect explains "
      "the samples.{}",
      with_thousands(total.rejected), share(total.right), share(total.wrong), share(total.unknown),
      origin.empty() ? "" : fmt::format(" The first map was tried on {}.", origin));
}

std::string naming_table(const std::vector<NamingRecord>& naming) {
  Table table("Diagnoses of injected defects",
              {"Mutant", "Its name", "Runs", "Rejected", "Right", "Unknown", "Wrong"});
  const auto number = [](std::uint64_t count) { return Cell{with_thousands(count), "number", ""}; };
  for (const NamingRecord& r : naming) {
    const std::string names =
        r.wrong == 0 ? "" : fmt::format(" ({})", fmt::join(r.wrong_names, ", "));
    table.add({text_cell(r.mutant),
               text_cell(r.expected),
               number(r.runs),
               number(r.rejected),
               number(r.right),
               number(r.unknown),
               {with_thousands(r.wrong) + names, r.wrong == 0 ? "number" : "reject", ""}});
  }
  return table.html();
}

const CalibrationRecord& worst_of(const std::vector<CalibrationRecord>& tests) {
  return *std::max_element(tests.begin(), tests.end(), [](const auto& a, const auto& b) {
    return a.ks_distance < b.ks_distance;
  });
}

std::string calibration_finding(const std::vector<CalibrationRecord>& tests) {
  const CalibrationRecord& worst = worst_of(tests);
  const double limit = calibration_limit(worst.replicates);
  return fmt::format(
      "p-values of a right sampler {} uniform: of {} the largest deviation over {} is {}, where "
      "{} would be chance with a probability of one in a million",
      worst.ks_distance <= limit ? "are" : "are not", counted(tests.size(), "test"),
      with_thousands(worst.replicates), format_number(worst.ks_distance), format_number(limit));
}

std::string calibration_table(const CalibrationResult& calibration) {
  Table tests("Calibration",
              {"Test", "p-values", "Kind", "Largest deviation", "log10 p (Kolmogorov-Smirnov)",
               "log10 p (Anderson-Darling)", "Below 0.01"});
  for (const CalibrationRecord& r : calibration.tests) {
    tests.add({text_cell(full_name(r.test)),
               {with_thousands(r.replicates), "number", ""},
               text_cell(r.is_bound ? "bound" : "exact"),
               number_cell(r.ks_distance),
               number_cell(r.log10_p_ks),
               r.log10_p_anderson ? number_cell(*r.log10_p_anderson)
                                  : Cell{"\u2013", "number", "of exact p-values only"},
               {with_thousands(r.below_one_percent), "number", ""}});
  }
  return tests.html();
}

std::string family_table(const std::vector<FamilyRecord>& families) {
  Table runs("Whole runs over right samplers",
             {"Procedure", "Runs", "Rejected", "Share", "Promised at most"});
  for (const FamilyRecord& f : families) {
    const double share = static_cast<double>(f.rejected) / static_cast<double>(f.runs);
    runs.add({text_cell(f.procedure),
              {with_thousands(f.runs), "number", ""},
              {with_thousands(f.rejected), "number", ""},
              {percent(share), "number", ""},
              {percent(f.family_alpha), "number", ""}});
  }
  return "<h4>Whole runs over right samplers</h4>\n" + runs.html();
}

/// The largest distance between measured and predicted power, over tests with a prediction.
double largest_miss(const std::vector<PowerRecord>& power) {
  double miss = 0.0;
  for (const PowerRecord& r : power) {
    const double measured = static_cast<double>(r.rejected) / static_cast<double>(r.replicates);
    miss = std::max(miss, r.is_bound ? r.predicted - measured : std::abs(measured - r.predicted));
  }
  return miss;
}

std::string power_table(const std::vector<PowerRecord>& power) {
  Table table("Power", {"Test", "Effect", "Samples", "Rejected", "Predicted"});
  for (const PowerRecord& r : power) {
    const double measured = static_cast<double>(r.rejected) / static_cast<double>(r.replicates);
    table.add({text_cell(full_name(r.test)),
               number_cell(r.effect),
               {with_thousands(r.samples), "number", ""},
               number_cell(measured),
               {(r.is_bound ? "at least " : "") + format_number(r.predicted), "number", ""}});
  }
  return table.html();
}

constexpr std::string_view kIntroduction =
    "A gate that accepts everything passes everything. So it is tested itself: on samplers with "
    "one injected defect each, which it must reject and name; on a sampler that is right, whose "
    "p-values must be uniform; and on a distribution that is a little off, which it must find as "
    "often as it claims.";
constexpr std::string_view kKillNote =
    "Columns are the gate's tests, rows the injected defects; a dark frame marks tests of the "
    "oracle that has to reject. Colours are all samples that were drawn until the test rejected, "
    "those of both stages of the gate together. The title counts what the oracle needed that "
    "should reject; other tests may need more. Where a cell is empty the test does not reject with "
    "the most samples that were tried with that defect.";
constexpr std::string_view kCalibrationNote =
    "One line for each test; dashed lines are the limits, between which the axis is even; beyond "
    "them it is logarithmic. The worst of many cells has a bound in place of a p-value: it may run "
    "far below zero, never above.";
constexpr std::string_view kPowerNote =
    "Lines are predicted from the exact distribution, points are measured, bars are two standard "
    "errors. Tests at a level of 0.001.";

std::string calibration_html(const CalibrationResult& calibration) {
  return chart_figure({"calibration-chart", calibration_finding(calibration.tests),
                       "Deviation of p-values from uniform", std::string(kCalibrationNote),
                       calibration_chart(calibration.tests)},
                      family_table(calibration.families) +
                          collapsible("Calibration as a table", calibration_table(calibration)));
}

std::string power_html(const std::vector<PowerRecord>& power) {
  return chart_figure(
      {"power-chart",
       fmt::format(
           "The tests reject a distribution that is off as often as predicted, to within {}",
           format_number(largest_miss(power), 2)),
       "Share of rejections against the number of samples", std::string(kPowerNote),
       power_chart(power)},
      collapsible("Power as a table", power_table(power)));
}

}  // namespace

std::string self_test_section(const std::optional<SelfTestResult>& self_test) {
  std::string html = "<section id=\"self-test\">\n<h2>Can the gate be trusted?</h2>\n";
  if (!self_test) {
    return html +
           paragraph(
               "The gate was not tested on itself in this study: leave out "
               "`--no-self-test`.",
               "empty") +
           "</section>\n";
  }
  const auto& [calibration, power, mutants, naming, origin, naming_origin] = *self_test;
  html += paragraph(kIntroduction, "note");
  if (!origin.empty())
    html += paragraph(fmt::format("Self-test of this program, run on {}.", origin));
  html += chart_figure({"kill-chart",
                        kill_finding(mutants),
                        "Fewest samples with which each test rejects each injected defect",
                        std::string(kKillNote),
                        kill_chart(mutants),
                        {},
                        true},
                       collapsible("Injected defects as a table", kill_table(mutants)) +
                           download_link("mutants.csv", mutants_csv(mutants)));
  if (!naming.empty()) {
    html += paragraph(naming_finding(naming, naming_origin), "note") +
            collapsible("Diagnoses of injected defects as a table", naming_table(naming));
  }
  return html +
         collapsible("P-values: " + calibration_finding(calibration.tests),
                     calibration_html(calibration)) +
         collapsible("Power: how often small deviations are found, measured and predicted",
                     power_html(power)) +
         "</section>\n";
}

}  // namespace lightproof
