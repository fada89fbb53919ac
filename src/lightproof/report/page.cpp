#include "lightproof/report/page.h"

#include <fmt/format.h>

#include "lightproof/report/embedded.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/html.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

constexpr std::string_view kNavigation = R"(<nav aria-label="Sections"><ul>
<li><a href="#overview">Overview</a></li>
<li><a href="#gate">Gate</a></li>
<li><a href="#self-test">Trust</a></li>
<li><a href="#maps">Maps</a></li>
<li><a href="#convergence">Convergence</a></li>
<li><a href="#variance">Variance</a></li>
<li><a href="#throughput">Throughput</a></li>
<li><a href="#renders">Renders</a></li>
</ul></nav>
)";

std::string head(const StudyResult& study) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Lightproof: {}</title>\n<link rel=\"icon\" href=\"data:,\">\n"
      "<style>\n{}</style>\n</head>\n<body>\n",
      escaped(headline(study)), embedded::page_css());
}

std::string script(std::string_view code) {
  return "<script>" + script_safe_code(code) + "</script>\n";
}

std::string footer(const StudyResult& study) {
  return fmt::format(
             "<footer>\n<p>Made by Lightproof {}. Charts are drawn by Vega, Vega-Lite and "
             "Vega-Embed (BSD 3-clause licence).</p>\n",
             escaped(study.version)) +
         collapsible("Licences of the chart libraries in this file",
                     "<pre>" + escaped(embedded::licences()) + "</pre>\n") +
         "</footer>\n";
}

std::string scripts() {
  return script(embedded::vega()) + script(embedded::vega_lite()) + script(embedded::vega_embed()) +
         script(embedded::page_js());
}

}  // namespace

std::string report_page(const StudyResult& study) {
  return head(study) + std::string(kNavigation) + "<main>\n" + overview_section(study) +
         gate_section(study.gate) + self_test_section(study.self_test) + map_section(study.maps) +
         convergence_section(study.convergence) + variance_section(study.convergence) +
         throughput_section(study) + render_section(study.renders) +
         "<noscript><p class=\"empty\">The charts need JavaScript; every number is also in the "
         "tables and CSV files.</p></noscript>\n</main>\n" +
         footer(study) + scripts() + "</body>\n</html>\n";
}

}  // namespace lightproof
