#include "delaunay/face_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "delaunay/front.h"
#include "delaunay/refine.h"
#include "delaunay/scaffold.h"
#include "delaunay/size_field.h"
#include "delaunay/stars.h"
#include "delaunay/surface_triangulation.h"

namespace geovor {
namespace {

// An inner edge this many times longer than the size wanted at its triangle's corners is told.
constexpr double kTooLong = 2.5;
// Points that fronts have placed are nearly good; those of a scaffold are all replaced.
constexpr int kRoundsOnFronts = 2, kRoundsOnScaffold = 3;
// Each mesh tells the next one where sizes are smaller; after so many the last one is refined as it is.
constexpr int kMostFillings = 6;

// Places, a side, at which a face is looked at for any area.
constexpr int kLooks = 8;

// A face may be one line or one point: a trailing edge without thickness.
bool has_area(const SurfaceProbe& probe) {
  for (int i = 0; i < kLooks; ++i) {
    for (int k = 0; k < kLooks; ++k) {
      const Uv p{probe.box().u.lo + (i + 0.5) / kLooks * probe.box().u.length(),
                 probe.box().v.lo + (k + 0.5) / kLooks * probe.box().v.length()};
      if (probe.at(p).regular) return true;
    }
  }
  return false;
}

void measure(const SurfaceTriangulation& mesh, FaceMesh& out) {
  const HalfEdges& topo = mesh.topology();
  for (int t = 0; t < topo.triangle_count(); ++t) {
    const auto [a, b, c] = topo.corners(t);
    const Xyz &p = mesh.vertex(a).x, &q = mesh.vertex(b).x, &r = mesh.vertex(c).x;
    const auto foot = mesh.foot((p + q + r) / 3.0, t);
    if (!foot || !(foot->n.dot((q - p).cross(r - p)) > 0.0)) ++out.inverted;
    for (const Xyz& x : {Xyz((p + q + r) / 3.0), Xyz((p + q) / 2.0), Xyz((q + r) / 2.0), Xyz((r + p) / 2.0)}) {
      if (const auto f = mesh.foot(x, t)) out.largest_distance = std::max(out.largest_distance, (f->x - x).norm());
    }
    const double wanted = std::max({mesh.vertex(a).h, mesh.vertex(b).h, mesh.vertex(c).h});
    double longest = 0.0;
    for (int e = 3 * t; e < 3 * t + 3; ++e) {
      if (!topo.fixed(e))
        longest = std::max(longest, (mesh.vertex(topo.origin(e)).x - mesh.vertex(topo.target(e)).x).norm());
    }
    if (longest > kTooLong * wanted) ++out.too_large;
  }
}

// Fills the face by fronts until no size is found in it that they did not know of, or as often as it can be done.
// Nothing where it can't be done once.
std::optional<SurfaceTriangulation> fill(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border,
                                         const SizeRule& rule) {
  const MeshBorder rim = mesh_border(face, probe, border);
  if (!rim.why.empty()) return std::nullopt;
  SizeField field(rule, rim.points);
  std::optional<SurfaceTriangulation> mesh;
  for (int i = 1; i <= kMostFillings; ++i) {
    std::vector<MeshVertex> points = fill_by_fronts(probe, rule, field, rim);
    if (points.empty()) return std::nullopt;
    if (field.learn(points) && i < kMostFillings) continue;
    auto triangles = triangulate_by_stars(points, rim, rule.size);
    if (!triangles) break;
    mesh.emplace(std::move(*triangles), std::move(points), probe, rule);
    if (!field.learn(*mesh)) break;
  }
  return mesh;
}

FaceMesh finished(const SurfaceTriangulation& mesh) {
  FaceMesh out;
  std::vector<int> id(mesh.vertices().size());
  for (size_t v = 0; v < id.size(); ++v) {
    const MeshVertex& vertex = mesh.vertex(static_cast<int>(v));
    if (vertex.border >= 0) {
      id[v] = vertex.border;
    } else if (mesh.topology().outgoing(static_cast<int>(v)) != HalfEdges::kNone) {
      id[v] = -1 - static_cast<int>(out.inner.size());
      out.inner.push_back(vertex.x);
    }
  }
  for (int t = 0; t < mesh.topology().triangle_count(); ++t) {
    const auto [a, b, c] = mesh.topology().corners(t);
    out.triangles.push_back({id[a], id[b], id[c]});
  }
  measure(mesh, out);
  out.estimated_lengths = mesh.estimates_used();
  out.ok = true;
  return out;
}

}  // namespace

FaceMesh mesh_face(const CadFace& face, const BorderPoints& border, const SizeRule& rule) {
  const SurfaceProbe probe(*face.surface, parameter_box(face));
  if (!has_area(probe)) {
    FaceMesh empty;
    empty.why = "it has no area, all of it is one line or one point";
    return empty;
  }
  if (auto mesh = fill(face, probe, border, rule)) {
    refine(*mesh, kRoundsOnFronts);
    return finished(*mesh);
  }
  Scaffold scaffold = build_scaffold(face, probe, border, rule);
  if (!scaffold.ok) {
    FaceMesh failed;
    failed.why = scaffold.why;
    return failed;
  }
  SurfaceTriangulation mesh(std::move(scaffold.triangles), std::move(scaffold.vertices), probe, rule);
  refine(mesh, kRoundsOnScaffold);
  return finished(mesh);
}

std::vector<int> points_to_refine(const CadFace& face, const BorderPoints& border) {
  return border_faults(face, SurfaceProbe(*face.surface, parameter_box(face)), border);
}

}  // namespace geovor
