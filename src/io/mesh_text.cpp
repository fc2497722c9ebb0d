#include "io/mesh_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "io/mesh_builder.h"

namespace geovor {
namespace {

constexpr const char* kExportAnew = "; the file may be damaged, export the mesh anew";

template <typename Number>
bool read_whole_word(std::string_view word, Number& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

bool MeshText::is_blank(char c) const {
  return c == ' ' || c == '\t' || c == '\r' || separators_.find(c) != std::string_view::npos;
}

bool MeshText::any_line() {
  if (at_ >= text_.size()) {
    line_ = rest_ = {};
    return false;
  }
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  line_ = rest_ = text_.substr(at_, end - at_);
  at_ = end + 1;
  ++number_;
  return true;
}

bool MeshText::next_line(std::string_view comment) {
  while (any_line()) {
    const auto first = std::find_if(line_.begin(), line_.end(), [this](char c) { return !is_blank(c); });
    if (first != line_.end() && comment.find(*first) == std::string_view::npos) return true;
  }
  return false;
}

std::string_view MeshText::word() {
  std::size_t first = 0;
  while (first < rest_.size() && is_blank(rest_[first])) ++first;
  std::size_t last = first;
  while (last < rest_.size() && !is_blank(rest_[last])) ++last;
  const std::string_view word = rest_.substr(first, last - first);
  rest_.remove_prefix(last);
  return word;
}

std::string_view MeshText::any_word() {
  for (;;) {
    if (const std::string_view w = word(); !w.empty()) return w;
    if (!any_line()) fail(std::string("the file ends too soon") + kExportAnew);
  }
}

double MeshText::to_number(std::string_view word) const {
  double value = 0.0;
  if (!read_whole_word(word, value)) fail("'" + std::string(word.substr(0, 40)) + "' is no number" + kExportAnew);
  return value;
}

long MeshText::to_whole(std::string_view word) const {
  long value = 0;
  if (!read_whole_word(word, value)) fail("'" + std::string(word.substr(0, 40)) + "' is no whole number" + kExportAnew);
  return value;
}

double MeshText::number() { return to_number(word()); }
long MeshText::whole() { return to_whole(word()); }

Xyz MeshText::point() {
  Xyz x;
  for (int i = 0; i < 3; ++i) {
    const std::string_view w = word();
    x[i] = to_number(w);
    count_digits(w);
  }
  return x;
}

void MeshText::count_digits(std::string_view word) {
  int digits = 0;
  for (const char c : word) {
    if (c == 'e' || c == 'E') break;
    if (c >= '0' && c <= '9' && (c != '0' || digits > 0)) ++digits;
  }
  digits_ = std::max(digits_, digits);
}

void MeshText::fail(const std::string& what) const { fail_to_read(number_, what); }

}  // namespace geovor
