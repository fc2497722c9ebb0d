#include "occ_adapter/check_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"

namespace geovor {
namespace {

namespace fs = std::filesystem;

// Enough of either end to hold the marks of every format, comments and blank lines included.
constexpr std::streamoff kPeek = 64 * 1024;

// Fixed columns of an IGES line, counted from 0: the letter of the section, and the field of the parameter section that
// points back to the directory entry.
constexpr std::size_t kIgesSection = 72;
constexpr std::size_t kIgesPointer = 64;

[[noreturn]] void fail(const std::string& message) { throw Error(ErrorCode::Unreadable, message); }

std::string lower_ending(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

CadFormat format_of(const std::string& path) {
  const std::string ending = lower_ending(path);
  if (ending == ".step" || ending == ".stp" || ending == ".p21") return CadFormat::Step;
  if (ending == ".iges" || ending == ".igs") return CadFormat::Iges;
  if (ending == ".brep" || ending == ".brp" || ending == ".rle") return CadFormat::Brep;
  fail((ending.empty() ? std::string("the file name has no ending") : "the ending '" + ending + "' is not known") +
       "; name a .step, .stp, .p21, .iges, .igs or .brep file");
}

struct Ends {
  std::string head;
  std::string tail;
};

Ends read_ends(const std::string& path) {
  if (path.empty()) fail("the path is empty; name a CAD file");
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (!fs::exists(status)) fail("there is no such file; check the path");
  if (fs::is_directory(status)) fail("this is a directory; name a CAD file in it");
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) fail("the file can't be opened; check its permissions");
  const std::streamoff size = in.tellg();
  if (size <= 0) fail("the file is empty; export it again from the CAD system");
  Ends ends;
  ends.head.resize(static_cast<std::size_t>(std::min(size, kPeek)));
  in.seekg(0);
  in.read(ends.head.data(), static_cast<std::streamsize>(ends.head.size()));
  ends.tail.resize(ends.head.size());
  in.seekg(size - static_cast<std::streamoff>(ends.tail.size()));
  in.read(ends.tail.data(), static_cast<std::streamsize>(ends.tail.size()));
  if (!in) fail("the file can't be read; check the disk it lies on");
  return ends;
}

bool holds(const std::string& text, const char* mark) { return text.find(mark) != std::string::npos; }

/// The last line that is not blank, without its line end.
std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return {};
  const std::size_t before = text.find_last_of("\r\n", end);
  return text.substr(before == std::string::npos ? 0 : before + 1,
                     end - (before == std::string::npos ? 0 : before + 1) + 1);
}

void check_step(const Ends& ends) {
  if (!holds(ends.head, "ISO-10303-21")) {
    fail("this is not a STEP file (it does not begin with ISO-10303-21); export it as STEP AP203, AP214 or AP242");
  }
  if (!holds(ends.tail, "END-ISO-10303-21")) {
    fail("the STEP file is cut short (END-ISO-10303-21 is missing); copy or export it again");
  }
}

void check_iges(const Ends& ends) {
  const std::string first = ends.head.substr(0, ends.head.find_first_of("\r\n"));
  const auto section = [](const std::string& line) { return line.size() > kIgesSection ? line[kIgesSection] : ' '; };
  if (section(first) != 'S') {
    fail("this is not an IGES file (no start section in column 73); export it as IGES 5.3, fixed line length");
  }
  if (section(last_line(ends.tail)) != 'T') {
    fail("the IGES file is cut short (the terminate section is missing); copy or export it again");
  }
}

/// A text BREP ends with the reference to its root shape ("+1 0"), behind the '*' that closes the last shape.
bool brep_is_complete(const std::string& tail) {
  const std::string last = last_line(tail);
  if (last == "*") return true;
  const std::size_t space = last.find(' ');
  if (space == std::string::npos || last.empty() || std::string("+-ie").find(last[0]) == std::string::npos)
    return false;
  const std::string numbers = last.substr(1, space - 1) + last.substr(space + 1);
  if (!std::all_of(numbers.begin(), numbers.end(), [](unsigned char c) { return std::isdigit(c) || c == ' '; }))
    return false;
  const std::string rest = tail.substr(0, tail.rfind(last));
  const std::size_t end = rest.find_last_not_of(" \t\r\n");
  return end != std::string::npos && rest[end] == '*';
}

CadFormat check_brep(const Ends& ends) {
  if (holds(ends.head.substr(0, 256), "Open CASCADE Topology")) return CadFormat::BinaryBrep;
  if (!holds(ends.head, "CASCADE Topology")) {
    fail("this is not a BREP file (no line 'CASCADE Topology'); export it as OpenCASCADE BREP");
  }
  if (!brep_is_complete(ends.tail))
    fail("the BREP file is cut short (its root shape is missing); copy or export it again");
  return CadFormat::Brep;
}

}  // namespace

CadFormat check_cad_file(const std::string& path) {
  const Ends ends = read_ends(path);
  const CadFormat format = format_of(path);
  if (format == CadFormat::Step) check_step(ends);
  if (format == CadFormat::Iges) check_iges(ends);
  return format == CadFormat::Brep ? check_brep(ends) : format;
}

bool iges_overflows_column_64(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  for (std::string line; std::getline(in, line);) {
    if (line.size() <= kIgesSection || line[kIgesSection] != 'P') continue;
    const auto from = line.begin() + kIgesPointer;
    const bool pointer =
        std::all_of(from, line.begin() + kIgesSection, [](unsigned char c) { return std::isdigit(c) || c == ' '; });
    if (!pointer) return true;
  }
  return false;
}

}  // namespace geovor
