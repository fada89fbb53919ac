// Published forms that are wrong or incomplete, beside the corrected ones.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/published_pictures.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

constexpr std::string_view kIntroduction =
    "The systems of image-based lighting are implemented as their documents have them, and "
    "corrected. Each row computes one quantity whose exact value is known by both forms. "
    "`lightproof list systems` names the documents and the tests.";

/// The error relative to the exact value, or absolute where that is 0.
double error_of(double value, double exact) { return exact == 0.0 ? value : value / exact - 1.0; }

Cell error_cell(double value, double exact) {
  const double error = error_of(value, exact);
  if (!std::isfinite(error)) return {"none", "number", "not a finite number"};
  Cell cell = number_cell(error, 3);
  if (exact == 0.0) cell.tooltip = "absolute: the exact value is 0";
  return cell;
}

std::string finding(const std::vector<PublishedComparison>& comparisons) {
  const auto off = std::count_if(comparisons.begin(), comparisons.end(), [](const auto& c) {
    return !(std::abs(error_of(c.published, c.exact)) <= 0.01);
  });
  double worst = 0.0;
  for (const PublishedComparison& c : comparisons) {
    worst = std::max(worst, std::abs(error_of(c.corrected, c.exact)));
  }
  return fmt::format(
      "{} of {} published forms are off by more than 1 %; the corrected ones by at most {}", off,
      comparisons.size(), format_number(worst, 2));
}

std::string table_of(const std::vector<PublishedComparison>& comparisons) {
  Table table("Published forms against corrected ones",
              {"System", "Quantity", "Exact", "Published", "Corrected", "Relative error, published",
               "Relative error, corrected"});
  for (const PublishedComparison& c : comparisons) {
    table.add({text_cell(std::string(c.system)),
               {std::string(c.what), "detail", ""},
               number_cell(c.exact, 6),
               number_cell(c.published, 6),
               number_cell(c.corrected, 6),
               error_cell(c.published, c.exact),
               error_cell(c.corrected, c.exact)});
  }
  return table.html();
}

}  // namespace

std::string published_section(const std::vector<PublishedComparison>& comparisons,
                              const std::vector<PublishedPicture>& pictures) {
  std::string html = "<section id=\"published\">\n<h2>What do published forms get wrong?</h2>\n";
  if (comparisons.empty()) {
    return html + paragraph("No published forms were computed in this study.", "empty") +
           "</section>\n";
  }
  return html + paragraph(finding(comparisons), "note") + paragraph(kIntroduction, "note") +
         table_of(comparisons) + download_link("published.csv", published_csv(comparisons)) +
         published_pictures_html(pictures) + "</section>\n";
}

}  // namespace lightproof
