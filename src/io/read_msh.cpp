#include <map>

#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/mesh_text.h"

namespace geovor {
namespace {

/// Corners of the surface elements of Gmsh by their type; the points of curved elements that follow are passed over.
int corners_of(long type) {
  switch (type) {
    case 2:   // triangle
    case 9:   // of 6 points
    case 21:  // of 10
      return 3;
    case 3:   // quadrangle
    case 10:  // of 9 points
    case 16:  // of 8
      return 4;
    default:
      return 0;
  }
}

class MshReader {
 public:
  explicit MshReader(std::string_view bytes) : text_(bytes) {}

  LoadedMesh read() {
    bool has_format = false;
    while (text_.next_line()) {
      const std::string_view section = text_.word();
      if (section == "$MeshFormat") format(), has_format = true;
      if (!has_format) text_.fail("it does not begin with $MeshFormat; write it as Gmsh 2.2 or 4.1");
      if (section == "$PhysicalNames") names();
      if (section == "$Entities") entities();
      if (section == "$Nodes") is_old_ ? nodes_of_2() : nodes_of_4();
      if (section == "$Elements") is_old_ ? elements_of_2() : elements_of_4();
    }
    return builder_.finish(text_.digits());
  }

 private:
  void line() {
    if (!text_.next_line()) text_.fail("the file ends too soon; export the mesh anew");
  }
  void format() {
    line();
    const std::string_view version = text_.word();
    is_old_ = version.starts_with("2");
    if (!is_old_ && version != "4.1")
      text_.fail("it is of version " + std::string(version) + "; write it as 2.2 or 4.1");
    if (text_.whole() != 0) text_.fail("it is binary; write it as text (gmsh FILE -save -o TEXT.msh)");
  }
  void names();
  void entities();
  void nodes_of_2();
  void nodes_of_4();
  void elements_of_2();
  void elements_of_4();
  void node(long tag) {
    point_of_[tag] = builder_.points();
    builder_.point(text_.point());
  }
  void element(int corners, int group);
  int group_of(long physical, long surface);

  MeshText text_;
  MeshBuilder builder_;
  bool is_old_ = false;
  std::map<long, std::string> name_of_;  ///< physical groups of surfaces
  std::map<long, long> physical_of_;     ///< of a surface, its first physical group
  std::map<long, int> point_of_;
};

void MshReader::names() {
  line();
  for (long n = text_.whole(); n > 0; --n) {
    line();
    const long dimension = text_.whole(), tag = text_.whole();
    std::string_view name = text_.rest();
    const std::size_t open = name.find('"'), close = name.rfind('"');
    if (dimension == 2 && open < close) name_of_[tag] = name.substr(open + 1, close - open - 1);
  }
}

// Points have a place, curves and surfaces a box, then their physical groups.
void MshReader::entities() {
  line();
  long count[4];
  for (long& n : count) n = text_.whole();
  for (int dimension = 0; dimension < 3; ++dimension) {
    for (long i = 0; i < count[dimension]; ++i) {
      line();
      const long tag = text_.whole();
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) text_.word();
      const long groups = text_.whole();
      if (dimension == 2 && groups > 0) physical_of_[tag] = text_.whole();
    }
  }
}

void MshReader::nodes_of_2() {
  line();
  for (long n = text_.whole(); n > 0; --n) {
    line();
    node(text_.whole());
  }
}

void MshReader::nodes_of_4() {
  line();
  for (long blocks = text_.whole(); blocks > 0; --blocks) {
    line();
    for (int i = 0; i < 3; ++i) text_.whole();  // dimension, entity, parametric
    std::vector<long> tags;
    for (long n = text_.whole(); n > 0; --n) {
      line();
      tags.push_back(text_.whole());
    }
    for (const long tag : tags) line(), node(tag);
  }
}

int MshReader::group_of(long physical, long surface) {
  if (physical <= 0) return builder_.group("surface " + std::to_string(surface));
  const auto name = name_of_.find(physical);
  return builder_.group(name == name_of_.end() ? "physical " + std::to_string(physical) : name->second);
}

void MshReader::element(int corners, int group) {
  std::vector<int> points;
  for (int i = 0; i < corners; ++i) {
    const auto found = point_of_.find(text_.whole());
    points.push_back(found == point_of_.end() ? -1 : found->second);
  }
  builder_.polygon(points, group);
}

void MshReader::elements_of_2() {
  line();
  for (long n = text_.whole(); n > 0; --n) {
    line();
    text_.whole();
    const int corners = corners_of(text_.whole());
    long physical = 0, surface = 0;
    const long tags = text_.whole();
    for (long i = 0; i < tags; ++i) {
      const long tag = text_.whole();
      if (i == 0) physical = tag;
      if (i == 1) surface = tag;
    }
    corners > 0 ? element(corners, group_of(physical, surface)) : builder_.other_element();
  }
}

void MshReader::elements_of_4() {
  line();
  for (long blocks = text_.whole(); blocks > 0; --blocks) {
    line();
    const long dimension = text_.whole(), entity = text_.whole();
    const int corners = dimension == 2 ? corners_of(text_.whole()) : 0;
    if (dimension != 2) text_.whole();
    const long count = text_.whole();
    const auto physical = physical_of_.find(entity);
    const int group = corners > 0 ? group_of(physical == physical_of_.end() ? 0 : physical->second, entity) : -1;
    for (long i = 0; i < count; ++i) {
      line();
      text_.whole();
      corners > 0 ? element(corners, group) : builder_.other_element();
    }
  }
}

}  // namespace

LoadedMesh read_msh(std::string_view bytes) { return MshReader(bytes).read(); }

}  // namespace geovor
