// Pictures inside a page.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// Exposures at which a page shows a map, in stops from the one that it is drawn at.
inline constexpr std::array<int, 3> kStops = {-3, 0, 3};

/// An `<img>` with the picture inside, from sRGB-encoded values. `alternative` is plain text for
/// those who cannot see it.
std::string image_html(const Grid<Rgb>& encoded, std::string_view alternative);

/// The colours of diverging_picture() with their numbers.
std::string colour_bar_html(double range);

/// The picture at each of kStops from the exposure of `scale`, each with its caption, in a `<div>`
/// of the class "exposures". `name` is plain text, for those who cannot see it.
std::string exposures_html(const Grid<Rgb>& linear, double scale, std::string_view name);

/// An unfolded_cube() at each of kStops, as exposures_html() shows a picture: what is outside of
/// the cross is hatched.
std::string unfolded_exposures_html(const Grid<Rgb>& linear, double scale, std::string_view name);

}  // namespace lightproof
