#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/mesh_text.h"

namespace geovor {

// OFF with optional letters in front (COFF, NOFF, …): what follows a point's coordinates on its line is passed over.
LoadedMesh read_off(std::string_view bytes) {
  MeshBuilder builder;
  MeshText text(bytes);
  const auto line = [&] {
    if (!text.next_line("#")) text.fail("the file ends too soon; export the mesh anew");
  };
  line();
  const std::string_view keyword = text.word();
  if (keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF" || keyword.find('4') != keyword.npos) {
    text.fail("it does not begin with OFF; it may be of another format");
  }
  std::string_view first = text.word();
  if (first == "BINARY") text.fail("it is binary; write it as text");
  if (first.empty()) line(), first = text.word();
  const long points = text.to_whole(first), faces = text.whole();
  for (long i = 0; i < points; ++i) {
    line();
    builder.point(text.point());
  }
  for (long i = 0; i < faces; ++i) {
    line();
    std::vector<int> corners;
    for (long n = text.whole(); n > 0; --n) corners.push_back(MeshBuilder::corner(text.whole()));
    builder.polygon(corners, -1);
  }
  return builder.finish(text.digits());
}

}  // namespace geovor
