#include "io/step_text.h"

#include <cstdint>

#include "io/colours.h"
#include "io/face_groups.h"
#include "io/length_unit.h"
#include "io/number_text.h"

namespace geovor {
namespace {

/// The code points of valid UTF-8.
std::vector<std::uint32_t> code_points(const std::string& text) {
  std::vector<std::uint32_t> points;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0U) == 0x80U && !points.empty()) {
      points.back() = points.back() << 6 | (byte & 0x3fU);
    } else {
      points.push_back(byte < 0x80 ? byte : byte < 0xe0 ? byte & 0x1fU : byte < 0xf0 ? byte & 0x0fU : byte & 0x07U);
    }
  }
  return points;
}

void append_hex(std::string& text, std::uint32_t x, int digits) {
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) text += "0123456789ABCDEF"[x >> shift & 15U];
}

/// Length of a unit in the one of STEP that it is derived from: SI's prefix, or a factor of metres.
struct StepUnit {
  const char* unit;
  const char* prefix;      ///< SI's; null: no SI unit
  const char* conversion;  ///< its name where it is none
};
constexpr StepUnit kUnits[] = {{"mm", ".MILLI.", nullptr}, {"m", "$", nullptr},        {"cm", ".CENTI.", nullptr},
                               {"km", ".KILO.", nullptr},  {"um", ".MICRO.", nullptr}, {"in", nullptr, "INCH"},
                               {"ft", nullptr, "FOOT"},    {"mi", nullptr, "MILE"}};

}  // namespace

std::string step_string(const std::string& text) {
  std::string out = "'";
  for (const std::uint32_t c : code_points(name_in(NameAlphabet::Text, text, text.size()))) {
    if (c == '\'' || c == '\\') {
      out.append(2, static_cast<char>(c));
    } else if (c < 0x7f) {
      out += static_cast<char>(c);
    } else {
      const bool wide = c > 0xffff;
      out += wide ? "\\X4\\" : "\\X2\\";
      append_hex(out, c, wide ? 8 : 4);
      out += "\\X0\\";
    }
  }
  return out + "'";
}

ByteStream& operator<<(ByteStream& out, StepReal x) {
  std::string text;
  append_shortest(text, x.value);
  const std::size_t e = text.find('e');
  if (e != std::string::npos) text[e] = 'E';
  if (text.find('.') == std::string::npos) text.insert(e == std::string::npos ? text.size() : e, ".");
  return out << text;
}

StepText::StepText(const LabelledMesh& labelled, const StepSchema& schema, ByteStream& out) : out_(out) {
  metres_of(labelled.unit);  // refuses before anything is put
  put_head(labelled, schema);
  put_units(labelled.unit);
  put_product(labelled.title, schema);
}

std::size_t StepText::reserve(std::size_t count) {
  const std::size_t first = next_;
  next_ += count;
  return first;
}

void StepText::put_head(const LabelledMesh& labelled, const StepSchema& schema) {
  // Without the clock: the same mesh gives the same bytes.
  out_ << "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('" << schema.description << "'),'2;1');\nFILE_NAME("
       << step_string(labelled.title) << ",'1970-01-01T00:00:00',(''),(''),'geovor','geovor','');\nFILE_SCHEMA(('"
       << schema.name << "'));\nENDSEC;\nDATA;\n";
}

void StepText::put_units(const std::string& unit) {
  const std::size_t length = reserve(9), angle = length + 1, solid_angle = length + 2, uncertainty = length + 3,
                    metre = length + 4, measure = length + 5, exponents = length + 6;
  context_ = length + 7;
  for (const StepUnit& known : kUnits) {
    if (unit != known.unit) continue;
    if (known.prefix != nullptr) {
      out_ << '#' << length << "=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(" << known.prefix << ",.METRE.));\n";
      break;
    }
    out_ << '#' << metre << "=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n#" << measure
         << "=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(" << StepReal{metres_of(unit)} << "),#" << metre << ");\n#"
         << exponents << "=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n#" << length << "=(CONVERSION_BASED_UNIT('"
         << known.conversion << "',#" << measure << ")LENGTH_UNIT()NAMED_UNIT(#" << exponents << "));\n";
  }
  constexpr double kMetresApart = 1e-10;  // 1e-7 mm: OpenCASCADE's smallest tolerance, in any unit
  out_ << '#' << angle << "=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n#" << solid_angle
       << "=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n#" << uncertainty
       << "=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(" << StepReal{kMetresApart / metres_of(unit)} << "),#"
       << length << ",'distance_accuracy_value','confusion accuracy');\n#" << context_
       << "=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#" << uncertainty
       << "))GLOBAL_UNIT_ASSIGNED_CONTEXT((#" << length << ",#" << angle << ",#" << solid_angle
       << "))REPRESENTATION_CONTEXT('',''));\n";
}

void StepText::put_product(const std::string& name, const StepSchema& schema) {
  const std::size_t a = reserve(13);
  shape_ = a + 8, origin_ = a + 12;
  const std::string text = step_string(name);
  out_ << '#' << a << "=APPLICATION_CONTEXT('" << schema.application << "');\n";
  out_ << '#' << a + 1 << "=APPLICATION_PROTOCOL_DEFINITION('international standard','" << schema.protocol << "',"
       << schema.year << ",#" << a << ");\n";
  out_ << '#' << a + 2 << "=PRODUCT_CONTEXT('',#" << a << ",'mechanical');\n";
  out_ << '#' << a + 3 << "=PRODUCT(" << text << ',' << text << ",'',(#" << a + 2 << "));\n";
  out_ << '#' << a + 4 << "=PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#" << a + 3 << "));\n";
  out_ << '#' << a + 5 << "=PRODUCT_DEFINITION_FORMATION('','',#" << a + 3 << ");\n";
  out_ << '#' << a + 6 << "=PRODUCT_DEFINITION_CONTEXT('part definition',#" << a << ",'design');\n";
  out_ << '#' << a + 7 << "=PRODUCT_DEFINITION('design','',#" << a + 5 << ",#" << a + 6 << ");\n";
  out_ << '#' << shape_ << "=PRODUCT_DEFINITION_SHAPE('','',#" << a + 7 << ");\n";
  out_ << '#' << a + 9 << "=CARTESIAN_POINT('',(0.,0.,0.));\n#" << a + 10 << "=DIRECTION('',(0.,0.,1.));\n#" << a + 11
       << "=DIRECTION('',(1.,0.,0.));\n";
  out_ << '#' << origin_ << "=AXIS2_PLACEMENT_3D('',#" << a + 9 << ",#" << a + 10 << ",#" << a + 11 << ");\n";
}

std::size_t StepText::style(const std::array<double, 3>& linear) {
  const auto [known, is_new] = styles_.try_emplace(linear, 0);
  if (!is_new) return known->second;
  const auto [red, green, blue] = srgb(linear);  // as OpenCASCADE and CAD systems read it
  const std::size_t a = reserve(7);
  out_ << '#' << a << "=COLOUR_RGB(''," << StepReal{red} << ',' << StepReal{green} << ',' << StepReal{blue} << ");\n#"
       << a + 1 << "=FILL_AREA_STYLE_COLOUR('',#" << a << ");\n#" << a + 2 << "=FILL_AREA_STYLE('',(#" << a + 1
       << "));\n#" << a + 3 << "=SURFACE_STYLE_FILL_AREA(#" << a + 2 << ");\n#" << a + 4 << "=SURFACE_SIDE_STYLE('',(#"
       << a + 3 << "));\n#" << a + 5 << "=SURFACE_STYLE_USAGE(.BOTH.,#" << a + 4 << ");\n#" << a + 6
       << "=PRESENTATION_STYLE_ASSIGNMENT((#" << a + 5 << "));\n";
  return known->second = a + 6;
}

void StepText::put_list(const std::vector<std::size_t>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) out_ << (i > 0 ? ",#" : "#") << numbers[i];
}

void StepText::finish(const char* representation, const std::vector<std::size_t>& items,
                      const std::vector<std::size_t>& styled) {
  const std::size_t shape = reserve(3);
  out_ << '#' << shape << '=' << representation << "('',(#" << origin_ << ',';
  put_list(items);
  out_ << "),#" << context_ << ");\n#" << shape + 1 << "=SHAPE_DEFINITION_REPRESENTATION(#" << shape_ << ",#" << shape
       << ");\n";
  if (!styled.empty()) {
    out_ << '#' << shape + 2 << "=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(";
    put_list(styled);
    out_ << "),#" << context_ << ");\n";
  }
  out_ << "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace geovor
