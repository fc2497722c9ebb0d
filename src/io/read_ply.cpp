#include <cstdint>
#include <optional>

#include "io/binary_numbers.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/mesh_text.h"

namespace geovor {
namespace {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

struct Property {
  std::string name;
  Type type = Type::Float;
  std::optional<Type> count;  ///< a list: the type of its length
};

struct Element {
  std::string name;
  long count = 0;
  std::vector<Property> properties;
};

std::optional<Type> type_named(std::string_view name) {
  constexpr std::pair<const char*, Type> kTypes[] = {
      {"char", Type::Int8},   {"int8", Type::Int8},     {"uchar", Type::Uint8},   {"uint8", Type::Uint8},
      {"short", Type::Int16}, {"int16", Type::Int16},   {"ushort", Type::Uint16}, {"uint16", Type::Uint16},
      {"int", Type::Int32},   {"int32", Type::Int32},   {"uint", Type::Uint32},   {"uint32", Type::Uint32},
      {"float", Type::Float}, {"float32", Type::Float}, {"double", Type::Double}, {"float64", Type::Double}};
  for (const auto& [known, type] : kTypes) {
    if (name == known) return type;
  }
  return std::nullopt;
}

/// Values one after another, from text or from bytes.
class Values {
 public:
  Values(std::string_view bytes, MeshText& text, std::string_view format) : text_(text), is_text_(format == "ascii") {
    if (!is_text_ && format != "binary_little_endian" && format != "binary_big_endian") {
      text.fail("'" + std::string(format) + "' is no format of PLY; write it as text");
    }
    order_ = format == "binary_big_endian" ? std::endian::big : std::endian::little;
    at_ = bytes.data() + bytes.find("end_header");
    end_ = bytes.data() + bytes.size();
    while (at_ < end_ && *at_ != '\n') ++at_;
    ++at_;
  }

  double next(Type type, bool is_coordinate = false) {
    if (is_text_) {
      const std::string_view word = text_.any_word();
      if (is_coordinate) text_.count_digits(word);
      return text_.to_number(word);
    }
    switch (type) {
      case Type::Int8:
        return take<std::int8_t>();
      case Type::Uint8:
        return take<std::uint8_t>();
      case Type::Int16:
        return take<std::int16_t>();
      case Type::Uint16:
        return take<std::uint16_t>();
      case Type::Int32:
        return take<std::int32_t>();
      case Type::Uint32:
        return take<std::uint32_t>();
      case Type::Float:
        return take<float>();
      case Type::Double:
        return take<double>();
    }
    return 0.0;
  }
  bool is_text() const { return is_text_; }

 private:
  template <typename T>
  double take() {
    if (end_ - at_ < static_cast<std::ptrdiff_t>(sizeof(T))) {
      fail_to_read(0, "the file ends too soon; export the mesh anew");
    }
    const T value = read_bytes<T>(at_, order_);
    at_ += sizeof(T);
    return static_cast<double>(value);
  }

  MeshText& text_;
  bool is_text_;
  std::endian order_;
  const char *at_, *end_;
};

struct Header {
  std::string format;
  std::vector<Element> elements;
};

Property property(MeshText& text) {
  Property p;
  const auto type = [&text](std::string_view name) {
    const auto known = type_named(name);
    if (!known) text.fail("'" + std::string(name) + "' is no type of PLY; export the mesh anew");
    return *known;
  };
  std::string_view word = text.word();
  if (word == "list") {
    p.count = type(text.word());
    word = text.word();
  }
  p.type = type(word);
  p.name = text.word();
  return p;
}

Header header(MeshText& text) {
  Header h;
  if (!text.next_line() || text.word() != "ply") text.fail("it does not begin with 'ply'; it may be of another format");
  while (text.next_line()) {
    const std::string_view word = text.word();
    if (word == "end_header") return h;
    if (word == "format") {
      h.format = text.word();
    } else if (word == "element") {
      const std::string name(text.word());
      h.elements.push_back({name, text.whole(), {}});
    } else if (word == "property") {
      if (h.elements.empty()) text.fail("a property stands before the first element; export the mesh anew");
      h.elements.back().properties.push_back(property(text));
    }
  }
  text.fail("the header has no end; export the mesh anew");
}

/// Whether a scalar property of faces says in which group a face is.
bool names_group(const std::string& name) { return name == "face" || name == "group" || name == "label"; }

/// One vertex, face or other element; `is_float`: whether coordinates are of single precision.
void read_element(const Element& element, Values& values, MeshBuilder& builder, bool& is_float) {
  Xyz x = Xyz::Zero();
  std::vector<int> corners;
  int group = -1;
  for (const Property& p : element.properties) {
    const int axis = p.name == "x" ? 0 : p.name == "y" ? 1 : p.name == "z" ? 2 : -1;
    if (p.count) {
      const bool is_face = p.name == "vertex_indices" || p.name == "vertex_index";
      const auto n = static_cast<long>(values.next(*p.count));
      for (long i = 0; i < n; ++i) {
        const double value = values.next(p.type);
        if (is_face) corners.push_back(MeshBuilder::corner(value));
      }
    } else {
      const double value = values.next(p.type, axis >= 0);
      if (axis >= 0) x[axis] = value, is_float = is_float || p.type == Type::Float;
      if (names_group(p.name) && element.name == "face") {
        group = builder.group(std::to_string(static_cast<long>(value)));
      }
    }
  }
  if (element.name == "vertex") {
    builder.point(x);
  } else if (element.name == "face") {
    builder.polygon(corners, group);
  }
}

}  // namespace

LoadedMesh read_ply(std::string_view bytes) {
  MeshBuilder builder;
  MeshText text(bytes);
  const Header h = header(text);
  Values values(bytes, text, h.format);
  bool is_float = false;
  for (const Element& element : h.elements) {
    if (element.properties.empty()) continue;  // takes no room in the file, however many there are
    for (long i = 0; i < element.count; ++i) read_element(element, values, builder, is_float);
  }
  const int binary = is_float ? MeshBuilder::kSingle : MeshBuilder::kDouble;
  return builder.finish(values.is_text() ? text.digits() : binary);
}

}  // namespace geovor
