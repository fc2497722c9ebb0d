#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/mesh_text.h"

namespace geovor {

// Groups: `g`; in a file without any, `o`.
LoadedMesh read_obj(std::string_view bytes) {
  MeshBuilder builder;
  MeshText text(bytes);
  std::string group_name, object_name;
  bool has_groups = false;
  while (text.next_line("#")) {
    const std::string_view word = text.word();
    if (word == "v") {
      builder.point(text.point());
    } else if (word == "g") {
      group_name = text.word();
      has_groups = true;
    } else if (word == "o" && !has_groups) {
      object_name = text.word();
    } else if (word == "l" || word == "p") {
      builder.other_element();
    } else if (word == "f") {
      std::vector<int> corners;
      for (std::string_view corner = text.word(); !corner.empty(); corner = text.word()) {
        const long number = text.to_whole(corner.substr(0, corner.find('/')));
        corners.push_back(MeshBuilder::corner(number < 0 ? builder.points() + number : number - 1));
      }
      const std::string& name = has_groups ? group_name : object_name;
      builder.polygon(corners, name.empty() ? -1 : builder.group(name));
    }
  }
  return builder.finish(text.digits());
}

}  // namespace geovor
