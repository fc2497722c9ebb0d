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

/// Projects points on one face's surface; in parameter ranges a little wider than the face, so that a foot on the
/// border is found from both sides.
class Foot {
 public:
  Foot(const CadModel& model, const CadFace& face)
      : surface_(*face.surface),
        reversed_(face.reversed),
        box_(FaceDomain(model, face, 1e-3 * model.diagonal()).box()) {}

  Projection of(const Xyz& point) const { return project(surface_, point, box_); }
  Projection near(const Xyz& point, Uv guess) const {
    const Projection p = project_near(surface_, point, guess, box_);
    return p.converged ? p : of(point);
  }
  Xyz outward_normal(Uv p) const { return (reversed_ ? -1.0 : 1.0) * unit_normal(surface_.jet(p)); }
  double largest_curvature(Uv p) const { return curvatures(surface_.jet(p)).largest(); }

 private:
  const Surface& surface_;
  bool reversed_;
  UvBox box_;
};

using Corners = std::array<Xyz, 3>;

/// |f - linear interpolant| <= (largest second derivative) R^2 / 2, R the radius of the smallest circle around the
/// triangle, which is at most its longest edge over the root of three (Waldron, SIAM J. Numer. Anal. 35, 1998).
double sagitta(const Corners& c, double curvature) {
  const double h = std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
  return curvature * h * h / 6.0;
}

void measure(const Foot& foot, const Corners& c, Fit& fit) {
  const Xyz middle = (c[0] + c[1] + c[2]) / 3.0;
  const Projection centre = foot.of(middle);
  double curvature = foot.largest_curvature(centre.uv);
  double farthest = centre.distance;
  for (int i = 0; i < 3; ++i) {
    const Projection corner = foot.near(c[i], centre.uv);
    fit.worst_vertex = std::max(fit.worst_vertex, corner.distance);
    curvature = std::max(curvature, foot.largest_curvature(corner.uv));
    farthest = std::max(farthest, foot.near(0.5 * (c[i] + c[(i + 1) % 3]), centre.uv).distance);
  }
  const Xyz normal = (c[1] - c[0]).cross(c[2] - c[0]);
  // NaN where the surface has no normal (a pole, a tip): no statement about the triangle.
  fit.inverted += normal.dot(foot.outward_normal(centre.uv)) < 0.0;
  fit.worst_triangle = std::max(fit.worst_triangle, farthest);
  const double bound = sagitta(c, curvature);
  if (std::isfinite(bound) && bound > 0.0) fit.worst_bound = std::max(fit.worst_bound, farthest / bound);
  ++fit.measured;
}

}  // namespace

Fit fit(const CadModel& model, const TriangleMesh& mesh, int stride) {
  std::map<int, Foot> feet;
  for (const CadFace& face : model.faces)
    if (face.surface) feet.emplace(face.number, Foot(model, face));
  Fit result;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += stride) {
    const auto& t = mesh.triangles[i];
    measure(feet.at(mesh.face_of[i]), {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, result);
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

double area_by_quadrature(const CadModel& model) {
  double sum = 0.0;
  for (const CadFace& face : model.faces)
    if (face.surface) sum += face_area(model, face).value;
  return sum;
}

}  // namespace geovor::testing
