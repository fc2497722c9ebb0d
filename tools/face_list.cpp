#include "face_list.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <set>

#include "base/error.h"
#include "context.h"

namespace geovor {
namespace {

/// No CAD file has more faces; a typing error such as "1-99999999999" is caught before it fills the memory.
constexpr int kMostFaces = 10'000'000;

bool starts_with_face(const std::string& text) {
  const std::string word = "face";
  if (text.size() < word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(text[i])) != word[i]) return false;
  }
  return true;
}

}  // namespace

int parse_face(const std::string& text) {
  const std::string digits = starts_with_face(text) ? text.substr(4) : text;
  int number = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (status != std::errc() || end != digits.data() + digits.size() || number < 1 || number > kMostFaces) {
    throw Error(ErrorCode::Usage, fmt::format("'{}' names no face; write 3 or Face3", text));
  }
  return number;
}

std::vector<int> parse_face_list(const std::string& text) {
  std::set<int> numbers;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, comma - begin);
    const std::size_t dash = part.find('-');
    const int first = parse_face(part.substr(0, dash));
    const int last = dash == std::string::npos ? first : parse_face(part.substr(dash + 1));
    if (last < first) {
      throw Error(ErrorCode::Usage, fmt::format("'{}' runs backwards; write {}-{}", part, last, first));
    }
    for (int number = first; number <= last; ++number) numbers.insert(number);
    begin = comma + 1;
  }
  return {numbers.begin(), numbers.end()};
}

void check_faces_exist(const std::vector<int>& numbers, int count) {
  for (const int number : numbers) {
    if (number <= count) continue;
    throw Error(ErrorCode::Usage,
                count == 1
                    ? fmt::format("{} is not there; the file has Face1 only", face_label(number))
                    : fmt::format("{} is not there; the file has Face1 to {}", face_label(number), face_label(count)));
  }
}

const CadFace& chosen_face(const CadModel& model, std::optional<int> number) {
  const int count = static_cast<int>(model.faces.size());
  if (!number && count > 1) {
    throw Error(ErrorCode::Usage, fmt::format("the file has {} faces; choose one with --face N", count));
  }
  check_faces_exist({number.value_or(1)}, count);
  return model.faces[static_cast<std::size_t>(number.value_or(1) - 1)];
}

}  // namespace geovor
