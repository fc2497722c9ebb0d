// Words and numbers from a text file, line by line. Private to the room.
#pragma once

#include <string>
#include <string_view>

#include "base/xyz.h"

namespace geovor {

class MeshText {
 public:
  /// `separators`: characters between words beside blanks.
  explicit MeshText(std::string_view text, std::string_view separators = {}) : text_(text), separators_(separators) {}

  /// Goes to the next line that holds a word and starts with none of `comment`; false at the end.
  bool next_line(std::string_view comment = {});
  /// Goes to the next line, empty or not; false at the end.
  bool any_line();
  std::string_view line() const { return line_; }
  int line_number() const { return number_; }

  /// The next word of the line; empty at its end.
  std::string_view word();
  std::string_view rest() const { return rest_; }
  /// The next word of this line or of those that follow; fails at the end of the file.
  std::string_view any_word();

  /// The next word of the line as a number. Throws Error(Unreadable), naming the line.
  double number();
  long whole();
  Xyz point();
  double to_number(std::string_view word) const;
  long to_whole(std::string_view word) const;

  /// The most significant digits that a coordinate of point() had.
  int digits() const { return digits_; }
  void count_digits(std::string_view word);

  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool is_blank(char c) const;

  std::string_view text_, separators_, line_, rest_;
  std::size_t at_ = 0;
  int number_ = 0, digits_ = 0;
};

/// Lower case of ASCII letters.
std::string lower_case(std::string_view text);

}  // namespace geovor
