#include <array>
#include <cstdint>
#include <optional>

#include "io/binary_numbers.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/mesh_text.h"

namespace geovor {
namespace {

[[noreturn]] void fail(const std::string& what) { fail_to_read(0, what); }

constexpr const char* kDamaged = "; the file may be damaged, export the mesh anew";

/// The value of name="value" in a tag; empty where there is none.
std::string_view attribute(std::string_view tag, const std::string& name) {
  const std::size_t at = tag.find(" " + name + "=\"");
  if (at == tag.npos) return {};
  const std::size_t first = at + name.size() + 3, last = tag.find('"', first);
  return last == tag.npos ? std::string_view() : tag.substr(first, last - first);
}

/// The first element of this name in `text`: its tag and what it holds.
struct XmlElement {
  std::string_view tag, inner;
  std::size_t end = 0;  ///< behind it, in `text`
};
std::optional<XmlElement> find_element(std::string_view text, const std::string& name, std::size_t from = 0) {
  for (std::size_t at = text.find("<" + name, from); at != text.npos; at = text.find("<" + name, at + 1)) {
    const std::size_t behind = at + 1 + name.size(), close = text.find('>', at);
    if (close == text.npos) return std::nullopt;
    if (text[behind] != '>' && text[behind] != '/' && text[behind] != ' ' && text[behind] != '\n') continue;
    if (text[close - 1] == '/') return XmlElement{text.substr(at, close - at), {}, close + 1};
    const std::size_t end = text.find("</" + name + ">", close);
    if (end == text.npos) return std::nullopt;
    return XmlElement{text.substr(at, close - at), text.substr(close + 1, end - close - 1), end};
  }
  return std::nullopt;
}

std::string from_base64(std::string_view text) {
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : text) {
    unsigned value = 0;
    if (c >= 'A' && c <= 'Z') {
      value = static_cast<unsigned>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      value = static_cast<unsigned>(c - 'a' + 26);
    } else if (c >= '0' && c <= '9') {
      value = static_cast<unsigned>(c - '0' + 52);
    } else if (c == '+' || c == '/') {
      value = c == '+' ? 62 : 63;
    } else if (c == '=') {
      held = 0;  // padding; another block may follow
      continue;
    } else if (c == ' ' || c == '\n' || c == '\r' || c == '\t') {
      continue;
    } else {
      fail(std::string("an array holds what is no base64") + kDamaged);
    }
    bits = bits << 6 | value;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<char>(bits >> held & 0xffU));
  }
  return bytes;
}

class VtpReader {
 public:
  explicit VtpReader(std::string_view bytes) : bytes_(bytes) {
    const auto file = bytes.find("<VTKFile");
    if (file == bytes.npos) fail("it holds no VTKFile; it may be of another format");
    tag_ = bytes.substr(file, bytes.find('>', file) - file);
    if (attribute(tag_, "type") != "PolyData") fail("it is no PolyData; extract the surface and save it as .vtp");
    if (!attribute(tag_, "compressor").empty()) fail("its arrays are compressed; save it uncompressed, or as text");
    order_ = attribute(tag_, "byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
    // Appended bytes may hold anything, angle brackets too: the elements stand before them.
    const auto appended = bytes.find("<AppendedData");
    xml_ = bytes.substr(0, appended);
    if (appended == bytes.npos) return;
    const auto tag_end = bytes.find('>', appended), underscore = bytes.find('_', tag_end);
    if (underscore == bytes.npos) fail(std::string("its appended data are missing") + kDamaged);
    raw_ = attribute(bytes.substr(appended, tag_end - appended), "encoding") == "raw";
    appended_ = bytes.substr(underscore + 1);
  }

  LoadedMesh read() {
    std::size_t at = 0;
    while (const auto piece = find_element(xml_, "Piece", at)) {
      read_piece(piece->inner);
      at = piece->end;
    }
    return builder_.finish(digits_);
  }

 private:
  void read_piece(std::string_view piece);
  std::vector<double> array(const XmlElement& element);
  std::vector<double> array_in(std::string_view parent, const std::string& name);
  std::vector<double> groups(std::string_view piece);
  std::vector<double> numbers_of(std::string_view bytes, std::string_view type) const;
  std::string_view sized(std::string_view bytes) const;

  std::string_view bytes_, xml_, tag_, appended_;
  std::endian order_ = std::endian::little;
  bool raw_ = false;
  int digits_ = MeshBuilder::kDouble;
  MeshBuilder builder_;
};

/// The bytes behind their length.
std::string_view VtpReader::sized(std::string_view bytes) const {
  const bool wide = attribute(tag_, "header_type") == "UInt64";
  const std::size_t head = wide ? 8 : 4;
  if (bytes.size() < head) fail(std::string("an array ends too soon") + kDamaged);
  const std::uint64_t length =
      wide ? read_bytes<std::uint64_t>(bytes.data(), order_) : read_bytes<std::uint32_t>(bytes.data(), order_);
  if (bytes.size() - head < length) fail(std::string("an array ends too soon") + kDamaged);
  return bytes.substr(head, length);
}

std::vector<double> VtpReader::numbers_of(std::string_view bytes, std::string_view type) const {
  std::vector<double> numbers;
  const auto all = [&]<typename T>(T) {
    for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) {
      numbers.push_back(static_cast<double>(read_bytes<T>(bytes.data() + at, order_)));
    }
    return true;
  };
  const bool known = type == "Float64"   ? all(double{})
                     : type == "Float32" ? all(float{})
                     : type == "Int64"   ? all(std::int64_t{})
                     : type == "UInt64"  ? all(std::uint64_t{})
                     : type == "Int32"   ? all(std::int32_t{})
                     : type == "UInt32"  ? all(std::uint32_t{})
                     : type == "Int16"   ? all(std::int16_t{})
                     : type == "UInt16"  ? all(std::uint16_t{})
                     : type == "Int8"    ? all(std::int8_t{})
                     : type == "UInt8"   ? all(std::uint8_t{})
                                         : false;
  if (!known) fail("'" + std::string(type) + "' is no type of numbers" + kDamaged);
  return numbers;
}

std::vector<double> VtpReader::array(const XmlElement& element) {
  const std::string_view format = attribute(element.tag, "format"), type = attribute(element.tag, "type");
  if (format == "appended") {
    const auto offset = static_cast<std::size_t>(MeshText("").to_whole(attribute(element.tag, "offset")));
    if (offset > appended_.size()) fail(std::string("an array lies beyond the end of the file") + kDamaged);
    const std::string_view from = appended_.substr(offset);
    return raw_ ? numbers_of(sized(from), type)
                : numbers_of(sized(from_base64(from.substr(0, from.find_first_of("<=")))), type);
  }
  if (format == "binary") return numbers_of(sized(from_base64(element.inner)), type);
  std::vector<double> numbers;
  MeshText text(element.inner);
  while (text.next_line()) {
    for (std::string_view w = text.word(); !w.empty(); w = text.word()) numbers.push_back(text.to_number(w));
  }
  return numbers;
}

std::vector<double> VtpReader::array_in(std::string_view parent, const std::string& name) {
  std::size_t at = 0;
  while (const auto element = find_element(parent, "DataArray", at)) {
    if (attribute(element->tag, "Name") == name) return array(*element);
    at = element->end;
  }
  return {};
}

// The groups of cells are a data array of integers named "face", or of another program's name for the same.
std::vector<double> VtpReader::groups(std::string_view piece) {
  const auto data = find_element(piece, "CellData");
  if (!data) return {};
  for (const char* name : {"face", "Face", "group", "CellEntityIds", "gmsh:physical", "gmsh:geometrical"}) {
    std::vector<double> values = array_in(data->inner, name);
    if (!values.empty()) return values;
  }
  return {};
}

// Cells are numbered vertices first, then lines, polygons and strips.
void VtpReader::read_piece(std::string_view piece) {
  const int first = builder_.points();
  const auto points = find_element(piece, "Points"), polys = find_element(piece, "Polys");
  const auto coordinates = points ? find_element(points->inner, "DataArray") : std::nullopt;
  if (!coordinates) return;
  if (attribute(coordinates->tag, "type") == "Float32") digits_ = MeshBuilder::kSingle;
  const std::vector<double> x = array(*coordinates);
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) builder_.point({x[i], x[i + 1], x[i + 2]});
  std::size_t before = 0;
  for (const char* kind : {"Verts", "Lines"}) {
    const auto cells = find_element(piece, kind);
    if (cells) before += array_in(cells->inner, "offsets").size();
  }
  for (std::size_t i = 0; i < before; ++i) builder_.other_element();
  if (!polys) return;
  const std::vector<double> corners = array_in(polys->inner, "connectivity"), ends = array_in(polys->inner, "offsets");
  const std::vector<double> group = groups(piece);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (!(ends[i] >= static_cast<double>(begin) && ends[i] <= static_cast<double>(corners.size())))
      fail(std::string("the offsets of its polygons do not ascend") + kDamaged);
    const auto end = static_cast<std::size_t>(ends[i]);
    std::vector<int> polygon;
    for (; begin < end; ++begin) polygon.push_back(MeshBuilder::corner(corners[begin], first));
    const bool grouped = before + i < group.size();
    builder_.polygon(polygon, grouped ? builder_.group(std::to_string(static_cast<long>(group[before + i]))) : -1);
  }
}

}  // namespace

LoadedMesh read_vtp(std::string_view bytes) { return VtpReader(bytes).read(); }

}  // namespace geovor
