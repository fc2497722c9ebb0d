// Faceted STEP (ISO 10303-42, advanced boundary representation). Points, edges and faces are numbered by formula, so
// that nothing has to be kept: 10,000 triangles take hundredths of a second, where OpenCASCADE's writer took seconds.
#include <Eigen/Geometry>
#include <algorithm>

#include "base/error.h"
#include "io/face_groups.h"
#include "io/mesh_writers.h"
#include "io/step_text.h"
#include "mesh/mesh_shells.h"

namespace geovor {
namespace {

constexpr StepSchema kSchema = {"AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }",
                                "core data for automotive mechanical design processes", "automotive_design", 2000,
                                "faceted boundary representation"};
// Entities a vertex, an edge, a triangle.
constexpr std::size_t kOfVertex = 2, kOfEdge = 4, kOfTriangle = 10;

class FacetWriter {
 public:
  FacetWriter(const LabelledMesh& labelled, ByteStream& out)
      : mesh_(labelled.mesh),
        groups_(labelled, NameAlphabet::Text),
        edges_(shared_edges(mesh_)),
        out_(out),
        text_(labelled, kSchema, out),
        vertices_(text_.reserve(kOfVertex * mesh_.points.size())),
        lines_(text_.reserve(kOfEdge * edges_.ends.size())),
        facets_(text_.reserve(kOfTriangle * mesh_.triangles.size())) {}

  void put() {
    put_vertices();
    for (std::size_t e = 0; e < edges_.ends.size(); ++e) put_edge(e);
    std::vector<std::size_t> styled;
    for (const FaceGroup& group : groups_) {
      const std::string name = step_string(group.name);
      for (const int t : group.triangles) put_facet(static_cast<std::size_t>(t), name);
      if (!group.colour) continue;
      const std::size_t style = text_.style(*group.colour);
      std::size_t item = text_.reserve(group.triangles.size());
      for (const int t : group.triangles) {
        out_ << '#' << item << "=STYLED_ITEM('colour',(#" << style << "),#" << facet(t) << ");\n";
        styled.push_back(item++);
      }
    }
    put_shells(styled);
  }

 private:
  std::size_t vertex(int point) const { return vertices_ + kOfVertex * static_cast<std::size_t>(point); }
  std::size_t facet(int t) const { return facets_ + kOfTriangle * static_cast<std::size_t>(t) + kOfTriangle - 1; }

  void put_triple(const Xyz& x) {
    out_ << "('',(" << StepReal{x.x()} << ',' << StepReal{x.y()} << ',' << StepReal{x.z()} << "));\n";
  }

  void put_vertices() {
    std::vector<bool> used(mesh_.points.size(), false);
    for (const auto& corners : mesh_.triangles) {
      for (const int c : corners) used[c] = true;
    }
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      if (!used[i]) continue;
      const std::size_t id = vertex(static_cast<int>(i));
      out_ << '#' << id << "=CARTESIAN_POINT", put_triple(mesh_.points[i]);
      out_ << '#' << id + 1 << "=VERTEX_POINT('',#" << id << ");\n";
    }
  }

  void put_edge(std::size_t e) {
    const auto& [a, b] = edges_.ends[e];
    const std::size_t id = lines_ + kOfEdge * e;
    out_ << '#' << id << "=DIRECTION", put_triple((mesh_.points[b] - mesh_.points[a]).stableNormalized());
    out_ << '#' << id + 1 << "=VECTOR('',#" << id << ",1.);\n#" << id + 2 << "=LINE('',#" << vertex(a) << ",#" << id + 1
         << ");\n#" << id + 3 << "=EDGE_CURVE('',#" << vertex(a) + 1 << ",#" << vertex(b) + 1 << ",#" << id + 2
         << ",.T.);\n";
  }

  void put_facet(std::size_t t, const std::string& name) {
    if (is_flat(mesh_, static_cast<int>(t))) {
      throw Error(ErrorCode::Unwritable, "triangle " + std::to_string(t) +
                                             " has no area and so no plane; mesh with another size, or write .stl or "
                                             ".obj");
    }
    const auto& [a, b, c] = mesh_.triangles[t];
    // Sides of length 1 first: the product of two tiny ones may underflow.
    const Xyz along = (mesh_.points[b] - mesh_.points[a]).stableNormalized();
    const Xyz normal = along.cross((mesh_.points[c] - mesh_.points[a]).stableNormalized()).normalized();
    const std::size_t id = facets_ + kOfTriangle * t;
    out_ << '#' << id << "=DIRECTION", put_triple(normal);
    out_ << '#' << id + 1 << "=DIRECTION", put_triple(along);
    out_ << '#' << id + 2 << "=AXIS2_PLACEMENT_3D('',#" << vertex(a) << ",#" << id << ",#" << id + 1 << ");\n#"
         << id + 3 << "=PLANE('',#" << id + 2 << ");\n";
    for (std::size_t k = 0; k < 3; ++k) {
      const EdgeUse& use = edges_.uses[t][k];
      out_ << '#' << id + 4 + k << "=ORIENTED_EDGE('',*,*,#"
           << lines_ + kOfEdge * static_cast<std::size_t>(use.edge) + 3 << (use.reversed ? ",.F.);\n" : ",.T.);\n");
    }
    out_ << '#' << id + 7 << "=EDGE_LOOP('',(#" << id + 4 << ",#" << id + 5 << ",#" << id + 6 << "));\n#" << id + 8
         << "=FACE_OUTER_BOUND('',#" << id + 7 << ",.T.);\n#" << id + 9 << "=ADVANCED_FACE(" << name << ",(#" << id + 8
         << "),#" << id + 3 << ",.T.);\n";
  }

  /// A solid a closed shell, a surface model an open one.
  void put_shells(const std::vector<std::size_t>& styled) {
    std::vector<std::size_t> items;
    bool solids = false, sheets = false;
    for (const MeshShell& shell : shells_of(mesh_, edges_)) {
      const std::size_t id = text_.reserve(3);
      out_ << '#' << id << (shell.closed ? "=CLOSED_SHELL('',(" : "=OPEN_SHELL('',(");
      const char* comma = "";
      for (const int t : shell.triangles) out_ << comma << '#' << facet(t), comma = ",";
      out_ << "));\n";
      if (!shell.closed) {
        out_ << '#' << id + 2 << "=SHELL_BASED_SURFACE_MODEL('',(#" << id << "));\n";
      } else if (shell.volume < 0.0) {
        // A solid lies behind the normals of its faces: a shell that is turned inside out is turned back.
        out_ << '#' << id + 1 << "=ORIENTED_CLOSED_SHELL('',*,#" << id << ",.F.);\n#" << id + 2
             << "=MANIFOLD_SOLID_BREP('',#" << id + 1 << ");\n";
      } else {
        out_ << '#' << id + 2 << "=MANIFOLD_SOLID_BREP('',#" << id << ");\n";
      }
      (shell.closed ? solids : sheets) = true;
      items.push_back(id + 2);
    }
    text_.finish(!sheets   ? "ADVANCED_BREP_SHAPE_REPRESENTATION"
                 : !solids ? "MANIFOLD_SURFACE_SHAPE_REPRESENTATION"
                           : "SHAPE_REPRESENTATION",
                 items, styled);
  }

  const TriangleMesh& mesh_;
  const FaceGroups groups_;
  const SharedEdges edges_;
  ByteStream& out_;
  StepText text_;
  const std::size_t vertices_, lines_, facets_;  ///< the first number of each kind
};

}  // namespace

void put_step_facets(const LabelledMesh& labelled, ByteStream& out) { FacetWriter(labelled, out).put(); }

}  // namespace geovor
