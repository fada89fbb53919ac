// What the charts share: the look, the scales, the way a series is told apart.
#pragma once

#include <cmath>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace lightproof {

using Json = nlohmann::ordered_json;

/// Names in the order of their first appearance, each once.
std::vector<std::string> unique_names(const std::vector<std::string>& names);

/// How an estimator or sampler is told apart: by colour and by shape.
struct SeriesStyle {
  std::string name;
  std::string colour;  ///< "#rrggbb"
  std::string shape;   ///< a Vega symbol: "circle", "square", …
};

/// The styles of names in the order of their first appearance; they repeat after eight names.
std::vector<SeriesStyle> series_styles(const std::vector<std::string>& names);

/// Half the length of an error bar, in standard errors.
inline constexpr double kBarHalfLength = 2.0;

/// What every chart begins with: size, background, fonts and colours; `height` in pixels, the width
/// is the container's.
Json base_chart(int height);

/// An encoding of the field "series" by colour or shape. Both share one legend, because its title
/// and domain agree.
Json series(const std::vector<SeriesStyle>& styles, std::string SeriesStyle::*property,
            const Json& legend);

/// A quantitative encoding; `scale` is "log" or "linear", neither starts at zero.
Json quantity(const std::string& field, const std::string& title, const std::string& scale);

/// The axis, with its labels, of a logarithmic scale from `low` to `high`. `text` is the Vega
/// expression of a label.
Json log_axis(double low, double high, const std::string& text = "format(datum.value, ',~g')");

/// The range of values on a logarithmic axis: of those that are positive and finite.
struct LogRange {
  double low = HUGE_VAL;
  double high = 0.0;
  void add(double value);
};

/// A layer of error bars from the channel y, whose field is "low", to the field "high".
Json error_bars(const Json& y, const Json& colour);

/// A layer of points as filled symbols.
Json points(const Json& y, const Json& colour, const Json& shape);

/// One line of a tool-tip; a name if `format` (d3) is empty, else a number.
Json tooltip(const std::string& field, const std::string& title, const std::string& format);

/// Whether a value can be shown on a logarithmic axis: it is positive and finite.
bool drawable(double value);

/// A value to five significant digits: finer than a pixel, and short. Null if it is not finite.
Json rounded(double value);

/// A chart as compact UTF-8 JSON.
std::string text_of(const Json& chart);

}  // namespace lightproof
