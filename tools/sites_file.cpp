#include "sites_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "context.h"
#include "numbers.h"

namespace geovor {
namespace {

/// How spreadsheet programs begin a text in UTF-8.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

[[noreturn]] void fail(const std::string& path, int line, const std::string& message) {
  throw Error(ErrorCode::Usage, fmt::format("{}: line {}: {}", path, line, message));
}

double number(const std::string& cell, const std::string& path, int line) {
  return in_context(fmt::format("{}: line {}", path, line), [&] { return parse_number(cell); });
}

/// Whether the header says x,y,z.
bool parse_header(std::vector<std::string> cells, const std::string& path, int line) {
  for (std::string& cell : cells) {
    std::transform(cell.begin(), cell.end(), cell.begin(), [](unsigned char c) { return std::tolower(c); });
  }
  if (cells == std::vector<std::string>{"u", "v"}) return false;
  if (cells == std::vector<std::string>{"x", "y", "z"}) return true;
  fail(path, line, "the header is missing; begin the file with the line u,v or x,y,z");
}

SiteRow parse_row(const std::vector<std::string>& cells, std::size_t columns, const std::string& path, int line) {
  if (cells.size() != columns) {
    fail(path, line,
         fmt::format("{} numbers where the header names {}; write {} a line", cells.size(), columns, columns));
  }
  SiteRow row;
  row.line = line;
  for (std::size_t i = 0; i < columns; ++i) row.values[i] = number(cells[i], path, line);
  return row;
}

}  // namespace

SitesFile read_sites_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(ErrorCode::Usage, path + ": is a folder; name a sites file in it");
  }
  std::ifstream stream(path);
  if (!stream) throw Error(ErrorCode::Usage, path + ": the sites file can't be read; check its name");
  SitesFile file;
  bool header_seen = false;
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (line == 1 && text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    const std::string content = without_blanks(text.substr(0, text.find('#')));
    if (content.empty()) continue;
    const std::vector<std::string> cells = cells_of(content);
    if (!header_seen) {
      file.in_space = parse_header(cells, path, line);
      header_seen = true;
      continue;
    }
    file.rows.push_back(parse_row(cells, file.in_space ? 3 : 2, path, line));
  }
  if (file.rows.empty()) throw Error(ErrorCode::Usage, path + ": holds no site; add a line a site after the header");
  return file;
}

}  // namespace geovor
