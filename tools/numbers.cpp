#include "numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/error.h"

namespace geovor {

std::string without_blanks(const std::string& text) {
  constexpr const char* kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    cells.push_back(without_blanks(line.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  return cells;
}

double parse_number(const std::string& cell) {
  const char* begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
  const char* end = cell.data() + cell.size();
  double value = 0.0;
  const auto [stop, status] = std::from_chars(begin, end, value);
  if (status != std::errc() || stop != end || !std::isfinite(value)) {
    throw Error(ErrorCode::Usage, fmt::format("'{}' is no number; write one such as 0.25", cell));
  }
  return value;
}

FacePoint parse_point(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& cell : cells_of(text)) numbers.push_back(parse_number(cell));
  if (numbers.size() == 2) return Uv{numbers[0], numbers[1]};
  if (numbers.size() == 3) return Xyz(numbers[0], numbers[1], numbers[2]);
  throw Error(ErrorCode::Usage, fmt::format("'{}' is no point; write u,v or x,y,z", text));
}

}  // namespace geovor
