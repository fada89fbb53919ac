#include "lightproof/page/document.h"

#include <fmt/format.h>

#include "lightproof/page/embedded.h"
#include "lightproof/page/html.h"

namespace lightproof {
namespace {

std::string head(std::string_view title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<link rel=\"icon\" href=\"data:,\">\n"
      "<style>\n{}</style>\n</head>\n<body>\n",
      escaped(title), embedded::page_css());
}

std::string script(std::string_view code) {
  return "<script>" + script_safe_code(code) + "</script>\n";
}

std::string footer(std::string_view version, Charts charts) {
  const std::string made_by = fmt::format("Made by Lightproof {}.", escaped(version));
  if (charts == Charts::none) return "<footer>\n<p>" + made_by + "</p>\n</footer>\n";
  return "<footer>\n<p>" + made_by +
         " Charts are drawn by Vega, Vega-Lite and Vega-Embed (BSD 3-clause licence).</p>\n" +
         collapsible("Licences of the chart libraries in this file",
                     "<pre>" + escaped(embedded::licences()) + "</pre>\n") +
         "</footer>\n";
}

std::string scripts(Charts charts) {
  const std::string libraries = charts == Charts::none
                                    ? ""
                                    : script(embedded::vega()) + script(embedded::vega_lite()) +
                                          script(embedded::vega_embed());
  return libraries + script(embedded::page_js());
}

std::string_view without_scripts(Charts charts) {
  if (charts == Charts::none) return "";
  return "<noscript><p class=\"empty\">The charts need JavaScript; every number is also in the "
         "tables and CSV files.</p></noscript>\n";
}

}  // namespace

std::string html_document(std::string_view title, std::string_view navigation_html,
                          std::string_view body_html, std::string_view version, Charts charts) {
  return head(title) + std::string(navigation_html) + "<main>\n" + std::string(body_html) +
         std::string(without_scripts(charts)) + "</main>\n" + footer(version, charts) +
         scripts(charts) + "</body>\n</html>\n";
}

}  // namespace lightproof
