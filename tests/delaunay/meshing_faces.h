// Models of one face with true edge curves, for the tests of the mesher.
#pragma once

#include <numbers>

#include "brep/model.h"
#include "support/segment.h"
#include "surface/elementary_surfaces.h"

namespace geovor::testing {

inline constexpr double kPi = std::numbers::pi;

/// The image of a segment on a surface.
class SegmentOnSurface final : public Curve3 {
 public:
  SegmentOnSurface(SurfacePtr surface, Segment segment) : surface_(std::move(surface)), segment_(segment) {}
  Interval domain() const override { return {0, 1}; }
  CurveJet<3> jet(double t) const override {
    const SurfaceJet j = surface_->jet(segment_.at(t));
    const UvVec d = segment_.direction();
    return {j.S, j.Su * d.u + j.Sv * d.v, j.Suu * (d.u * d.u) + j.Suv * (2 * d.u * d.v) + j.Svv * (d.v * d.v),
            Xyz::Zero()};
  }

 private:
  SurfacePtr surface_;
  Segment segment_;
};

/// Adds to the face a loop through the corners; corners that agree in `vertex` are one vertex, and segments that agree
/// in `edge` are one edge (a seam).
struct Corner {
  Uv uv;
  int vertex;
};
inline void add_polygon(CadModel& model, const std::vector<Corner>& corners) {
  CadFace& face = model.faces[0];
  TrimLoop loop;
  const int first = static_cast<int>(model.edges.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner a = corners[i], b = corners[(i + 1) % corners.size()];
    const int most = std::max(a.vertex, b.vertex);
    if (static_cast<int>(model.vertices.size()) <= most) model.vertices.resize(most + 1);
    model.vertices[a.vertex].position = face.surface->position(a.uv);
    Coedge use{static_cast<int>(model.edges.size()), std::make_shared<Segment>(a.uv, b.uv), {0, 1}, false};
    for (int e = first; e < static_cast<int>(model.edges.size()); ++e) {  // the seam, run the other way
      if (model.edges[e].first_vertex == b.vertex && model.edges[e].last_vertex == a.vertex && a.vertex != b.vertex) {
        use = {e, std::make_shared<Segment>(b.uv, a.uv), {0, 1}, true};
      }
    }
    if (use.edge == static_cast<int>(model.edges.size())) {
      const bool pole = (face.surface->position(a.uv) - face.surface->position(lerp(a.uv, b.uv, 0.3))).norm() < 1e-12;
      CadEdge edge;
      if (!pole) edge.curve = std::make_shared<SegmentOnSurface>(face.surface, Segment(a.uv, b.uv));
      edge.range = {0, 1};
      edge.first_vertex = a.vertex;
      edge.last_vertex = b.vertex;
      model.edges.push_back(edge);
    }
    loop.coedges.push_back(use);
  }
  face.loops.push_back(loop);
}

inline CadModel one_face(SurfacePtr surface, const std::vector<Corner>& corners) {
  CadModel model;
  model.faces.resize(1);
  model.faces[0].number = 1;
  model.faces[0].surface = std::move(surface);
  add_polygon(model, corners);
  return model;
}

inline Frame origin_frame() { return {Xyz::Zero(), Xyz::UnitX(), Xyz::UnitY(), Xyz::UnitZ()}; }

/// A whole sphere: one seam, two poles.
inline CadModel whole_sphere(double radius) {
  return one_face(std::make_shared<Sphere>(origin_frame(), radius),
                  {{{0, -kPi / 2}, 0}, {{2 * kPi, -kPi / 2}, 0}, {{2 * kPi, kPi / 2}, 1}, {{0, kPi / 2}, 1}});
}

/// A square of the plane with a square hole.
inline CadModel plate(double side, double hole) {
  CadModel model = one_face(std::make_shared<Plane>(origin_frame()),
                            {{{0, 0}, 0}, {{side, 0}, 1}, {{side, side}, 2}, {{0, side}, 3}});
  const double a = (side - hole) / 2, b = (side + hole) / 2;
  if (hole > 0) add_polygon(model, {{{a, a}, 4}, {{a, b}, 5}, {{b, b}, 6}, {{b, a}, 7}});
  return model;
}

}  // namespace geovor::testing
