#include "table.h"

#include <algorithm>
#include <cstdio>

namespace geovor::bench {
namespace {

// Columns of characters, not of bytes: µ and × are two bytes each.
size_t width_of(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
}

}  // namespace

void print_table(const std::string& heading, const std::vector<Row>& rows) {
  std::vector<size_t> widths(rows.front().size());
  for (const Row& row : rows)
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  std::string text = heading + "\n";
  for (const Row& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - width_of(row[i]), ' ');
      text += i == 0 ? "  " + row[i] + padding : "  " + padding + row[i];
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  std::printf("%s\n", text.c_str());
}

std::string digits(double x, int after_point) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", after_point, x);
  return text;
}

}  // namespace geovor::bench
