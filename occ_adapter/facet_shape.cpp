// Triangles to faceted B-rep. Vertices and edges are shared by construction: sewing 10,000 triangles takes 13 s, this
// 0.05.
#include <BRep_Builder.hxx>
#include <Eigen/Geometry>
#include <GeomAbs_Shape.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Precision.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include "mesh/mesh_shells.h"
#include "occ_adapter/occ_write_private.h"

namespace geovor::occ {
namespace {

gp_Pnt to_pnt(const Xyz& p) { return {p.x(), p.y(), p.z()}; }

class FacetBuilder {
 public:
  explicit FacetBuilder(const TriangleMesh& mesh)
      : mesh_(mesh), edges_(shared_edges(mesh)), vertices_(mesh.points.size()), lines_(edges_.ends.size()) {}

  TopoDS_Shape build() {
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) facets_.push_back(facet(t));
    TopoDS_Compound compound;
    builder_.MakeCompound(compound);
    const std::vector<MeshShell> shells = shells_of(mesh_, edges_);
    TopoDS_Shape part;
    for (const MeshShell& shell : shells) {
      part = part_of(shell);
      builder_.Add(compound, part);
    }
    return shells.size() == 1 ? part : TopoDS_Shape(compound);
  }

 private:
  const TopoDS_Vertex& vertex(int index) {
    TopoDS_Vertex& vertex = vertices_[static_cast<std::size_t>(index)];
    if (vertex.IsNull()) {
      builder_.MakeVertex(vertex, to_pnt(mesh_.points[static_cast<std::size_t>(index)]), Precision::Confusion());
    }
    return vertex;
  }

  const TopoDS_Edge& edge(int index) {
    TopoDS_Edge& edge = lines_[static_cast<std::size_t>(index)];
    if (!edge.IsNull()) return edge;
    const auto& [a, b] = edges_.ends[static_cast<std::size_t>(index)];
    const gp_Pnt pa = to_pnt(mesh_.points[static_cast<std::size_t>(a)]);
    const gp_Pnt pb = to_pnt(mesh_.points[static_cast<std::size_t>(b)]);
    builder_.MakeEdge(edge, new Geom_Line(pa, gp_Dir(gp_Vec(pa, pb))), Precision::Confusion());
    builder_.Add(edge, vertex(a).Oriented(TopAbs_FORWARD));
    builder_.Add(edge, vertex(b).Oriented(TopAbs_REVERSED));
    builder_.Range(edge, 0.0, pa.Distance(pb));
    return edge;
  }

  TopoDS_Face facet(int t) {
    if (is_flat(mesh_, t)) {
      throw Error(ErrorCode::Unwritable,
                  "triangle " + std::to_string(t) +
                      " has no area and so no plane; mesh with another size, or write .stl or .obj");
    }
    const auto& [a, b, c] = mesh_.triangles[static_cast<std::size_t>(t)];
    const Xyz& pa = mesh_.points[static_cast<std::size_t>(a)];
    const Xyz ab = mesh_.points[static_cast<std::size_t>(b)] - pa;
    const Xyz normal = ab.cross(mesh_.points[static_cast<std::size_t>(c)] - pa);
    TopoDS_Face face;
    const gp_Ax3 axes(to_pnt(pa), gp_Dir(normal.x(), normal.y(), normal.z()), gp_Dir(ab.x(), ab.y(), ab.z()));
    builder_.MakeFace(face, new Geom_Plane(axes), Precision::Confusion());
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (const EdgeUse& use : edges_.uses[static_cast<std::size_t>(t)]) {
      builder_.Add(wire, edge(use.edge).Oriented(use.reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
    }
    wire.Closed(true);
    builder_.Add(face, wire);
    return face;
  }

  TopoDS_Shape part_of(const MeshShell& from) {
    TopoDS_Shell shell;
    builder_.MakeShell(shell);
    for (const int t : from.triangles) builder_.Add(shell, facets_[static_cast<std::size_t>(t)]);
    shell.Closed(from.closed);
    if (!from.closed) return shell;
    // A solid is bounded by normals that look out of it; a shell that is turned inside out is turned back.
    TopoDS_Solid solid;
    builder_.MakeSolid(solid);
    builder_.Add(solid, from.volume < 0.0 ? shell.Reversed() : TopoDS_Shape(shell));
    return solid;
  }

  const TriangleMesh& mesh_;
  const SharedEdges edges_;
  BRep_Builder builder_;
  std::vector<TopoDS_Vertex> vertices_;
  std::vector<TopoDS_Edge> lines_;
  std::vector<TopoDS_Face> facets_;
};

}  // namespace

TopoDS_Shape facet_shape(const TriangleMesh& mesh) { return FacetBuilder(mesh).build(); }

}  // namespace geovor::occ
