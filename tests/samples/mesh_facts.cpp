#include "samples/mesh_facts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "brep/face_domain.h"
#include "surface/forms.h"
#include "surface/project.h"

namespace geovor::testing {

namespace {

/// Projects points on one face's surface, within the rectangle around the face.
class Foot {
 public:
  Foot(const CadModel& model, const CadFace& face)
      : surface_(*face.surface),
        reversed_(face.reversed),
        box_(FaceDomain(model, face, 1e-3 * model.diagonal()).box()) {}

  /// The foot found from `guess` if it is no farther than `enough`, else the nearest of all.
  Projection of(const Xyz& point, Uv guess, double enough) const {
    const Projection p = project_near(surface_, point, guess, box_);
    return p.converged && p.distance <= enough ? p : project(surface_, point, box_);
  }
  /// On a side of the rectangle the nearest point need not be a foot of a perpendicular.
  bool inside(Uv p) const {
    const auto strictly = [](Interval range, double x) {
      const double margin = 1e-9 * range.length();
      return x > range.lo + margin && x < range.hi - margin;
    };
    return strictly(box_.u, p.u) && strictly(box_.v, p.v);
  }
  Xyz outward_normal(Uv p) const { return (reversed_ ? -1.0 : 1.0) * unit_normal(surface_.jet(p)); }
  double largest_curvature(Uv p) const { return curvatures(surface_.jet(p)).largest(); }

 private:
  const Surface& surface_;
  bool reversed_;
  UvBox box_;
};

using Corners = std::array<Xyz, 3>;

double longest_edge(const Corners& c) {
  return std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
}

/// |f - linear interpolant| <= (largest second derivative) R^2 / 2, R the radius of the smallest circle around the
/// triangle, which is at most its longest edge over the root of three (Waldron, SIAM J. Numer. Anal. 35, 1998).
double sagitta(const Corners& c, double curvature) {
  const double h = longest_edge(c);
  return curvature * h * h / 6.0;
}

/// `last`: where the triangle measured before lies in the parameters, a good guess for this one.
void measure(const Foot& foot, const Corners& c, Uv& last, Fit& fit) {
  const Xyz middle = (c[0] + c[1] + c[2]) / 3.0;
  const double near = 0.1 * longest_edge(c);
  const Projection centre = foot.of(middle, last, near);
  last = centre.uv;
  double curvature = foot.largest_curvature(centre.uv);
  double farthest = centre.distance, farthest_foot = centre.distance;
  for (int i = 0; i < 3; ++i) {
    const Projection corner = foot.of(c[i], centre.uv, near);
    fit.worst_vertex = std::max(fit.worst_vertex, corner.distance);
    curvature = std::max(curvature, foot.largest_curvature(corner.uv));
    const Projection middle_of_edge = foot.of(0.5 * (c[i] + c[(i + 1) % 3]), centre.uv, near);
    farthest = std::max(farthest, middle_of_edge.distance);
    if (foot.inside(middle_of_edge.uv)) farthest_foot = std::max(farthest_foot, middle_of_edge.distance);
  }
  const Xyz normal = (c[1] - c[0]).cross(c[2] - c[0]);
  // NaN where the surface has no normal (a pole, a tip): no statement about the triangle.
  fit.inverted += normal.dot(foot.outward_normal(centre.uv)) < 0.0;
  fit.worst_triangle = std::max(fit.worst_triangle, farthest);
  const double bound = sagitta(c, curvature);
  if (std::isfinite(bound) && bound > 0.0) fit.worst_bound = std::max(fit.worst_bound, farthest_foot / bound);
  ++fit.measured;
}

}  // namespace

Fit fit(const CadModel& model, const TriangleMesh& mesh, int stride) {
  std::map<int, Foot> feet;
  for (const CadFace& face : model.faces)
    if (face.surface) feet.emplace(face.number, Foot(model, face));
  Fit result;
  Uv last{0.0, 0.0};
  for (std::size_t i = 0; i < mesh.triangles.size(); i += stride) {
    const auto& t = mesh.triangles[i];
    measure(feet.at(mesh.face_of[i]), {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, last, result);
  }
  return result;
}

TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<int>& face_numbers) {
  TriangleMesh part;
  part.points = mesh.points;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (std::find(face_numbers.begin(), face_numbers.end(), mesh.face_of[i]) == face_numbers.end()) continue;
    part.triangles.push_back(mesh.triangles[i]);
    part.face_of.push_back(mesh.face_of[i]);
  }
  return part;
}

double area_by_dense_sum(const CadModel& model) {
  constexpr int kCells = 200;
  double sum = 0.0;
  for (const CadFace& face : model.faces) {
    if (!face.surface) continue;
    const FaceDomain domain(model, face, 1e-5 * model.diagonal());
    const UvBox box = domain.box();
    const double du = box.u.length() / kCells, dv = box.v.length() / kCells;
    for (int i = 0; i < kCells; ++i) {
      for (int k = 0; k < kCells; ++k) {
        const Uv middle{box.u.lo + (i + 0.5) * du, box.v.lo + (k + 0.5) * dv};
        if (!domain.contains(middle)) continue;
        const SurfaceJet j = face.surface->jet(middle);
        sum += j.Su.cross(j.Sv).norm() * du * dv;
      }
    }
  }
  return sum;
}

}  // namespace geovor::testing
