#include "io/number_text.h"

#include <charconv>
#include <string_view>

namespace geovor {

void append_shortest(std::string& text, double x) {
  constexpr int kLongest = 32;  // "-1.2345678901234567e-308" has 24 characters
  char buffer[kLongest];
  text.append(buffer, std::to_chars(buffer, buffer + kLongest, x).ptr);
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
