// Files that are part of the program: the page's style and script, and the chart libraries.
#pragma once

#include <string_view>

namespace lightproof::embedded {

/// The page's style sheet.
std::string_view page_css();
/// The page's script.
std::string_view page_js();
/// The code of Vega.
std::string_view vega();
/// The code of Vega-Lite.
std::string_view vega_lite();
/// The code of Vega-Embed.
std::string_view vega_embed();
/// The licence texts of the chart libraries and of what they contain.
std::string_view licences();

}  // namespace lightproof::embedded
