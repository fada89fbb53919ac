// Numbers as a reader wants them: three significant digits, no noise, the same everywhere.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lightproof/core/grid.h"

namespace lightproof {

/// A number in ASCII, in its shortest form with at most `digits` significant digits: "0.0123",
/// "1230", "1.23e-7". Whole numbers that fit have no decimals. NaN is "nan", infinities are "inf"
/// and "-inf".
std::string significant(double value, int digits = 3);

/// A number for a page, in its shortest form with at most `digits` significant digits and with a
/// true minus sign: "−0.0123", "1.23e−7"; "n/a" and "∞" for what is no number.
std::string format_number(double value, int digits = 3);

/// A value with its standard error, "−0.498 ± 0.004": the value to the decimals that its standard
/// error allows.
std::string with_error(double value, double error);

/// A fraction in percent, "2.1 %", with a space that does not break; two significant digits.
std::string percent(double fraction);

/// A fraction with its standard error in percent, "2.1 ± 0.3 %"; without one as percent().
std::string percent_with_error(double fraction, double error);

/// A time in the unit that suits it, "1.3 µs": ns, µs, ms or s; two significant digits.
std::string seconds_text(double seconds);

/// A whole number with its thousands apart: "4,194,304".
std::string with_thousands(std::uint64_t value);

/// A number as a word up to twelve, "eight", and in digits beyond.
std::string count_word(std::size_t count);

/// A number of things: "1 map", "2 maps".
std::string counted(std::size_t count, std::string_view noun);

/// A number of bytes, "1.5 MiB", in the largest of B, KiB, MiB and GiB that leaves no 0 before the
/// point.
std::string bytes_text(double bytes);

/// An extent in words: "1024×512".
std::string extent_text(Extent extent);

}  // namespace lightproof
