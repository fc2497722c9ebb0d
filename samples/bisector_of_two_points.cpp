// The points of a surface that are equally far from two of its points: the geodesic Voronoi diagram of two sites.
//   bisector_of_two_points samples/cad/paraboloid.step
#include <cstdio>

#include "base/error.h"
#include "brep/face_domain.h"
#include "occ_adapter/read_cad.h"
#include "voronoi/diagram_builder.h"

int main(int argc, char** argv) try {
  using namespace geovor;
  if (argc != 2) throw Error(ErrorCode::Usage, "usage: bisector_of_two_points PARABOLOID.step");
  const CadModel model = read_cad(argv[1]);
  const double flattening = 1e-5 * model.diagonal();  // of the face's border
  const FaceDomain face(model, model.faces.at(0), flattening);

  const VoronoiDiagram diagram = build_diagram(face, {{-0.5, -0.2}, {0.4, 0.3}});
  for (const DiagramEdge& edge : diagram.edges) {
    std::printf("an edge of length %.9f, equidistant to %.1e of the distance:\n", edge.length, edge.residual);
    for (std::size_t i = 0; i < edge.points.size(); i += 8) {
      const EdgePoint& p = edge.points[i];
      std::printf("%9.6f %9.6f %9.6f   distance %.9f\n", p.xyz.x(), p.xyz.y(), p.xyz.z(), p.radius);
    }
  }
  for (const DiagramCell& cell : diagram.cells) std::printf("cell of site %d: area %.9f\n", cell.site, cell.area);
  return diagram.edges.empty() ? 1 : 0;
} catch (const geovor::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.code());
}
