#include "io/diagram_svg.h"

#include "io/atomic_file.h"

namespace geovor {
namespace {

const char* const kStyle =
    ".e,.c,.d{fill:none;stroke:#1c2733}.e{stroke-width:2.2}.c{stroke-width:1.6;stroke-dasharray:1 5}"
    ".d{stroke-opacity:.45;stroke-width:.9;stroke-dasharray:6 5}"
    ".s{fill:#1c2733;stroke:#fff;stroke-width:1.2}";

void draw_edge(const DiagramEdge& e, FaceViews& views) {
  const char* style = e.kind == EdgeKind::CutLocus ? "c" : "e";
  std::vector<Xyz> space;
  std::vector<Uv> plane;
  for (const EdgePoint& p : e.points) {
    space.push_back(p.xyz);
    plane.push_back(p.uv);
  }
  views.space_line(space, style);
  views.plane_line(plane, style);
}

}  // namespace

std::string diagram_svg(const VoronoiDiagram& diagram, const DualGraph& dual, const CellRaster& raster,
                        const PictureSize& size) {
  FaceViews views(raster, "Geodesic Voronoi diagram of " + std::to_string(diagram.sites.size()) + " sites", kStyle,
                  size);
  views.paint(face_tint);
  for (const DualEdge& e : dual.edges) {
    views.space_line(e.path, "d");
    views.plane_line(e.path_uv, "d");
  }
  for (const DiagramEdge& e : diagram.edges) draw_edge(e, views);
  constexpr size_t kMany = 200;  // sites, beyond which large dots would hide the cells
  const double radius = diagram.sites.size() > kMany ? 2.0 : 4.0;
  for (const DiagramSite& s : diagram.sites) {
    views.space_dot(s.xyz, "s", radius);
    views.plane_dot(s.uv, "s", radius);
  }
  return views.finish();
}

void write_diagram_svg(const VoronoiDiagram& diagram, const DualGraph& dual, const CellRaster& raster,
                       const std::string& path, const PictureSize& size) {
  write_file(path, diagram_svg(diagram, dual, raster, size));
}

}  // namespace geovor
