// Numbers as text, the same on every machine and in every locale.
#pragma once

#include <string>

namespace geovor {

/// Appends the shortest text that reads back as the same double: "0.1", "1e+300".
void append_shortest(std::string& text, double x);

/// Appends x as text of at most `longest` characters, always with a '.' or an exponent: the same double where so many
/// are enough, else the nearest to it that fits. REQUIRES: x finite, 12 <= longest.
void append_within(std::string& text, double x, std::size_t longest);

/// Appends x rounded to `decimals` places, without trailing zeros and without "-0": for pictures.
void append_rounded(std::string& text, double x, int decimals);

}  // namespace geovor
