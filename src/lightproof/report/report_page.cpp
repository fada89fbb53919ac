#include "lightproof/report/report_page.h"

#include "lightproof/page/document.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/glossary.h"
#include "lightproof/report/sections.h"
#include "lightproof/report/stability_tables.h"

namespace lightproof {
namespace {

constexpr std::string_view kNavigation = R"(<nav aria-label="Sections"><ul>
<li><a href="#accuracy">Accuracy</a></li>
<li><a href="#recommendations">What to do</a></li>
<li><a href="#overview">Overview</a></li>
<li><a href="#findings">Findings</a></li>
<li><a href="#gate">Gate</a></li>
<li><a href="#self-test">Trust</a></li>
<li><a href="#maps">Maps</a></li>
<li><a href="#methods">Methods</a></li>
<li><a href="#convergence">Convergence</a></li>
<li><a href="#variance">Variance</a></li>
<li><a href="#throughput">Throughput</a></li>
<li><a href="#renders">Renders</a></li>
<li><a href="#levels">Levels</a></li>
<li><a href="#points">Points</a></li>
<li><a href="#frames">Frames</a></li>
<li><a href="#stability">Hard inputs</a></li>
<li><a href="#split-sum">Split sum</a></li>
<li><a href="#published">Published forms</a></li>
</ul></nav>
)";

}  // namespace

std::string report_page(const StudyResult& study) {
  const std::string body = opening_section(study) + accuracy_section(study.accuracy) +
                           recommendation_section(study) + overview_section(study) +
                           gate_section(study.gate, study.directions_origin) +
                           self_test_section(study.self_test) + map_section(study.maps) +
                           methods_section(study) + convergence_section(study.convergence) +
                           variance_section(study.convergence) + throughput_section(study) +
                           render_section(study.renders) + level_cost_section(study.level_costs) +
                           point_section(study.points) + frame_section(study.frames) +
                           stability_section(study.stability) + split_sum_section(study.split_sum) +
                           published_section(study.published_forms, study.published_pictures);
  return html_document("Lightproof: " + headline(study), kNavigation, with_words_explained(body),
                       study.version);
}

std::string stability_page(const StabilityResult& stability, const std::string& version) {
  return html_document("Lightproof: " + stability_verdict(stability), "",
                       with_words_explained(stability_section(stability)), version);
}

}  // namespace lightproof
