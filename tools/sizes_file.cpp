#include "sizes_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string_view>

#include "base/error.h"
#include "context.h"
#include "face_list.h"
#include "numbers.h"

namespace geovor {
namespace {

/// How spreadsheet programs begin a text in UTF-8.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

[[noreturn]] void fail(const std::string& message) { throw Error(ErrorCode::Usage, message); }

struct Cell {
  std::string text;
  bool quoted = false;
};

/// The cells of a line up to its comment; a cell in quotes may hold commas, `#` and, doubled, quotes.
std::vector<Cell> quoted_cells(const std::string& line) {
  std::vector<Cell> cells(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (inside && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back().text += line[++i];
    } else if (c == '"') {
      inside = !inside;
      cells.back().quoted = true;
    } else if (!inside && c == '#') {
      break;
    } else if (!inside && c == ',') {
      cells.emplace_back();
    } else {
      cells.back().text += c;
    }
  }
  if (inside) fail("a quotation mark is not closed; add the second one");
  for (Cell& cell : cells) cell.text = without_blanks(cell.text);
  return cells;
}

enum class Column { Face, Size, Deflection, Angle };

std::vector<Column> parse_header(const std::vector<Cell>& cells) {
  static const std::map<std::string, Column> kNames = {
      {"face", Column::Face}, {"size", Column::Size}, {"deflection", Column::Deflection}, {"angle", Column::Angle}};
  std::vector<Column> columns;
  for (const auto& [text, quoted] : cells) {
    std::string cell = text;
    std::transform(cell.begin(), cell.end(), cell.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto named = kNames.find(cell);
    if (named == kNames.end()) {
      fail(fmt::format("the header has no column '{}'; begin the file with a line such as face,size,deflection,angle",
                       cell));
    }
    if (std::count(columns.begin(), columns.end(), named->second) > 0) {
      fail(fmt::format("the column {} stands twice; leave one out", cell));
    }
    columns.push_back(named->second);
  }
  if (std::count(columns.begin(), columns.end(), Column::Face) == 0 || columns.size() < 2) {
    fail("the header needs face and a rule; begin the file with a line such as face,size");
  }
  return columns;
}

bool is_number_of_faces(const std::string& cell) {
  std::string text = cell;
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  if (text.starts_with("face")) text.erase(0, 4);
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front()));
}

/// The numbers of the faces that a cell names; what stands in quotes is rather a name than a number.
std::vector<int> faces_of(const Cell& cell, const CadModel& model) {
  std::vector<int> named;
  for (const CadFace& face : model.faces) {
    if (!cell.text.empty() && face.name == cell.text) named.push_back(face.number);
  }
  if (is_number_of_faces(cell.text) && (named.empty() || !cell.quoted)) {
    const std::vector<int> numbers = parse_face_list(cell.text);
    check_faces_exist(numbers, static_cast<int>(model.faces.size()));
    return numbers;
  }
  if (named.empty()) {
    fail(fmt::format("no face is named '{}'; write 3 or Face3, or a name that geovor info lists", cell.text));
  }
  return named;
}

double positive(const std::string& cell) {
  const double value = parse_number(cell);
  if (!(value > 0.0)) fail(fmt::format("'{}' won't do; give a number greater than 0", cell));
  return value;
}

class Reader {
 public:
  explicit Reader(const CadModel& model) : model_(model) {}

  void add(const std::vector<Cell>& cells, int line) {
    if (columns_.empty()) {
      columns_ = parse_header(cells);
    } else {
      add_row(cells, line);
    }
  }

  std::vector<FaceRule> rules;

 private:
  void add_row(const std::vector<Cell>& cells, int line) {
    if (cells.size() != columns_.size()) {
      fail(fmt::format("{} cells where the header names {}; write {} a line", cells.size(), columns_.size(),
                       columns_.size()));
    }
    FaceRule rule;
    std::vector<int> faces;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (columns_[i] == Column::Face) {
        faces = faces_of(cells[i], model_);
      } else if (!cells[i].text.empty()) {
        set(rule, columns_[i], positive(cells[i].text));
      }
    }
    for (const int face : faces) {
      const auto [seen, is_new] = line_of_.emplace(face, line);
      if (!is_new) fail(fmt::format("{} has a rule on line {} already", face_label(face), seen->second));
      rule.face = face;
      rules.push_back(rule);
    }
  }

  static void set(FaceRule& rule, Column column, double value) {
    if (column == Column::Size) rule.size = value;
    if (column == Column::Deflection) rule.deflection = value;
    if (column == Column::Angle) rule.angle = value * std::numbers::pi / 180.0;
  }

  const CadModel& model_;
  std::vector<Column> columns_;
  std::map<int, int> line_of_;
};

}  // namespace

std::vector<FaceRule> read_sizes_file(const std::string& path, const CadModel& model) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail(path + ": is a folder; name a sizes file in it");
  std::ifstream stream(path);
  if (!stream) fail(path + ": the sizes file can't be read; check its name");
  Reader reader(model);
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (line == 1 && text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    in_context(fmt::format("{}: line {}", path, line), [&] {
      const std::vector<Cell> cells = quoted_cells(text);
      if (cells.size() > 1 || !cells.front().text.empty()) reader.add(cells, line);
    });
  }
  if (reader.rules.empty()) fail(path + ": holds no rule; add a line a face after the header");
  return reader.rules;
}

}  // namespace geovor
