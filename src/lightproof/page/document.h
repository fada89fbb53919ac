// A self-contained HTML document around its content.
#pragma once

#include <string>
#include <string_view>

namespace lightproof {

/// An HTML document that needs nothing else: the style, the chart libraries and the script that
/// draws every chart_figure() are inside. `title` and `version` are plain text.
std::string html_document(std::string_view title, std::string_view navigation_html,
                          std::string_view body_html, std::string_view version);

}  // namespace lightproof
