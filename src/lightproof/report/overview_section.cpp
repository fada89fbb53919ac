// The headline, what was found, and how to read the rest.
#include <fmt/format.h>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/gate_summary.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

std::string finding(std::string_view link, std::string_view topic, std::string_view text) {
  return fmt::format("<li><a href=\"#{}\">{}</a><span>{}.</span></li>\n", escaped(link),
                     escaped(topic), escaped(text));
}

std::string verdict_item(const SamplerFinding& f) {
  // A rejection that is expected, and decides nothing, is not shown as an alarm.
  const bool expected = f.is_demonstration && f.outcome == Outcome::reject;
  return fmt::format("<li><strong class=\"{}\">{}</strong> <span>{}</span></li>\n",
                     expected ? "demonstration" : to_string(f.outcome),
                     expected ? "as known" : outcome_text(f.outcome), escaped(f.sentence));
}

std::string list_of(const std::string& items) {
  return items.empty() ? "" : "<ul class=\"verdicts\">\n" + items + "</ul>\n";
}

/// Those that are accepted are a number, which opens on a click.
std::string sampler_list(const GateResult& gate) {
  std::string accepted;
  std::string others;
  std::size_t count = 0;
  for (const SamplerFinding& f : sampler_findings(gate)) {
    const bool passes = f.outcome == Outcome::accept;
    count += passes ? 1 : 0;
    (passes ? accepted : others) += verdict_item(f);
  }
  return list_of(others) +
         (count == 0 ? ""
                     : collapsible(counted(count, "sampler") + " accepted", list_of(accepted)));
}

std::string other_findings(const StudyResult& study) {
  std::string items = finding("convergence", "Convergence", convergence_finding(study.convergence));
  items += finding("variance", "Variance", variance_finding(study.convergence));
  items += finding("throughput", "Throughput", throughput_finding(study));
  if (!study.renders.empty()) {
    items += finding("renders", "Renders", renders_finding(study.renders));
  }
  return "<ul class=\"findings\">\n" + items + "</ul>\n";
}

std::string fact(std::string_view name, std::string_view value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
}

std::string facts(const StudyResult& study) {
  return "<dl class=\"facts\">\n" + fact("Version", study.version) +
         fact("Machine", study.machine) + fact("Seed", std::to_string(study.seed)) +
         fact("Maps", std::to_string(study.maps.size())) +
         fact("Tests", with_thousands(study.gate.tests.size())) +
         fact("Samples per run of a sampler", with_thousands(study.gate.samples)) +
         fact("Family-wise error", significant(study.gate.family_alpha)) + "</dl>\n";
}

constexpr std::string_view kHowToRead =
    "A test rejects a sampler when samples as unlikely as those drawn would hardly ever come from "
    "the distribution that the map demands. The family-wise error is the probability that a run "
    "over correct samplers rejects anything at all. A test that accepts proves nothing beyond its "
    "own sight, so each one also states the smallest deviation that it would have seen with a "
    "power of 99\u00a0%. Error bars are two standard errors long on either side unless a chart "
    "says otherwise. Pictures, tables and data lie beside this file as EXR, CSV and JSON.";

}  // namespace

std::string opening_section(const StudyResult& study) {
  return fmt::format(
      "<header id=\"overview\">\n<p class=\"kicker\">Lightproof study</p>\n"
      "<h1>{}</h1>\n</header>\n",
      escaped(headline(study)));
}

std::string overview_section(const StudyResult& study) {
  return "<section id=\"findings\">\n<h2>What was found</h2>\n" + sampler_list(study.gate) +
         other_findings(study) +
         fmt::format("<p class=\"how\"><strong>How to read this.</strong> {}</p>\n",
                     escaped(kHowToRead)) +
         facts(study) + "</section>\n";
}

}  // namespace lightproof
