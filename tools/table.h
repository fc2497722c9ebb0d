// A table of text with aligned columns.
#pragma once

#include <string>
#include <vector>

namespace geovor {

enum class Align { Left, Right };

/// Every row has as many cells as there are titles.
class Table {
 public:
  Table(std::vector<std::string> titles, std::vector<Align> alignment);
  void add(std::vector<std::string> row);

  /// The table with its titles, a line a row, two blanks between columns and none at the ends of lines.
  std::string text() const;

 private:
  std::vector<Align> alignment_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace geovor
