// A self-contained HTML document around its content.
#pragma once

#include <string>
#include <string_view>

namespace lightproof {

/// Whether a page holds a chart_figure().
enum class Charts { some, none };

/// An HTML document that needs nothing else: the style is inside and, if there are charts, the
/// chart libraries and the script that draws every chart_figure(). `title` and `version` are plain
/// text.
std::string html_document(std::string_view title, std::string_view navigation_html,
                          std::string_view body_html, std::string_view version,
                          Charts charts = Charts::some);

}  // namespace lightproof
