// Files that are part of the program: the page's style and script, and the chart libraries.
#pragma once

#include <string_view>

namespace lightproof::embedded {

std::string_view page_css();
std::string_view page_js();
std::string_view vega();
std::string_view vega_lite();
std::string_view vega_embed();
/// The licence texts of everything above that was written elsewhere.
std::string_view licences();

}  // namespace lightproof::embedded
