#include "io/number_text.h"

#include <charconv>
#include <cmath>
#include <string_view>

namespace geovor {

void append_shortest(std::string& text, double x) {
  constexpr int kLongest = 32;  // "-1.2345678901234567e-308" has 24 characters
  char buffer[kLongest];
  text.append(buffer, std::to_chars(buffer, buffer + kLongest, x).ptr);
}

namespace {

/// "-0.5" as "-.5", "1e-05" as "1e-5", "1e+20" as "1e20", and "3" as "3.".
std::string tight(std::string text) {
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    std::size_t digits = e + 2;  // after the sign
    while (text[digits] == '0' && digits + 1 < text.size()) text.erase(digits, 1);
    if (text[e + 1] == '+') text.erase(e + 1, 1);
    return text;
  }
  const std::size_t first = text[0] == '-' ? 1 : 0;
  if (text.find('.') == std::string::npos) return text + '.';
  if (text[first] == '0') text.erase(first, 1);
  return text;
}

std::string in_format(double x, std::chars_format format, int precision) {
  constexpr int kLongest = 400;
  char buffer[kLongest];
  return tight({buffer, std::to_chars(buffer, buffer + kLongest, x, format, precision).ptr});
}

double value_of(const std::string& text) {
  double x = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), x);
  return x;
}

}  // namespace

void append_within(std::string& text, double x, std::size_t longest) {
  std::string shortest;
  append_shortest(shortest, x);
  if (shortest.size() + 1 <= longest) {  // with the point that may be missing
    text += shortest.find_first_of(".e") == std::string::npos ? shortest + '.' : shortest;
    return;
  }
  // With a point alone, or with an exponent; whichever comes nearer with the digits that have room.
  std::string best;
  for (const auto format : {std::chars_format::fixed, std::chars_format::scientific}) {
    constexpr int kDigits = 18;  // one more than a double has
    int precision = kDigits;
    std::string candidate = in_format(x, format, precision);
    while (candidate.size() > longest && precision > 0) candidate = in_format(x, format, --precision);
    if (candidate.size() > longest) continue;
    if (best.empty() || std::abs(value_of(candidate) - x) < std::abs(value_of(best) - x)) best = candidate;
  }
  text += best;
}

void append_rounded(std::string& text, double x, int decimals) {
  constexpr int kLongest = 400;  // 309 digits before the point, and the decimals
  char buffer[kLongest];
  const auto end = std::to_chars(buffer, buffer + kLongest, x, std::chars_format::fixed, decimals).ptr;
  std::string_view number(buffer, end - buffer);
  if (number.find('.') != std::string_view::npos) {
    number = number.substr(0, number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.remove_suffix(1);
  }
  text += number == "-0" ? "0" : number;
}

}  // namespace geovor
