// One trimmed face under several parameterizations: the border is the same curve of space, though each has a polyline
// of its own.
#include <gtest/gtest.h>

#include <algorithm>

#include "surface/elementary_curves.h"
#include "surface/reparameterize.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

constexpr UvBox kPatch = {{0.2, 2.2}, {-1.0, 1.0}};

/// The part of a torus over kPatch: maps of these intervals are regular there, and need not be beyond.
class TorusPatch final : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return kPatch; }
  SurfaceJet jet(Uv p) const override { return torus_.jet(p); }
  using Surface::jet;

 private:
  Torus torus_{Frame{}, 3.0, 1.0};
};

struct Maps {
  ParameterMapPtr u, v;
  bool swap = false;
};

/// A p-curve of the base surface in the parameters of the other.
class MappedCurve final : public Curve2 {
 public:
  MappedCurve(Curve2Ptr base, std::shared_ptr<const Reparameterized> surface, Maps maps)
      : base_(std::move(base)), surface_(std::move(surface)), maps_(std::move(maps)) {}
  Interval domain() const override { return base_->domain(); }
  CurveJet<2> jet(double t) const override {
    const CurveJet<2> c = base_->jet(t);
    const Uv old{c.C[0], c.C[1]}, p = surface_->from_base(old);
    const double in_u = c.d1[0] / maps_.u->jet(maps_.swap ? p.v : p.u).d1;
    const double in_v = c.d1[1] / maps_.v->jet(maps_.swap ? p.u : p.v).d1;
    const Eigen::Vector2d zero(0, 0);
    if (maps_.swap) return {{p.u, p.v}, {in_v, in_u}, zero, zero};
    return {{p.u, p.v}, {in_u, in_v}, zero, zero};
  }

 private:
  Curve2Ptr base_;
  std::shared_ptr<const Reparameterized> surface_;
  Maps maps_;
};

/// A round patch of a torus with a hole; loops that the parameterization turns over run the other way.
VoronoiDiagram diagram(const Maps& maps) {
  const auto surface =
      std::make_shared<const Reparameterized>(std::make_shared<TorusPatch>(), maps.u, maps.v, maps.swap);
  TestFace face(surface);
  const bool turned = surface->u_turned() != surface->v_turned();
  const auto add = [&](Uv c, double r, bool hole) {
    const auto circle = std::make_shared<Circle<2>>(ConicFrame<2>{{c.u, c.v}, {1, 0}, {0, 1}}, r);
    const bool reversed = hole != (turned != maps.swap);
    face.model.faces[0].loops.push_back(
        {{{face.edge(), std::make_shared<MappedCurve>(circle, surface, maps), {0.0, 2.0 * kPi}, reversed}}});
  };
  add({1.2, 0.0}, 0.9, false);
  add({1.3, 0.1}, 0.25, true);
  std::vector<Uv> sites;
  for (const Uv p : {Uv{0.7, 0.3}, Uv{1.7, 0.35}, Uv{1.25, -0.45}, Uv{1.0, -0.1}, Uv{1.1, 0.6}}) {
    sites.push_back(surface->from_base(p));
  }
  VoronoiOptions options;
  options.measure = false;
  return build_diagram(face.domain(), sites, options);
}

std::vector<DiagramVertex> border_vertices(const Maps& maps) {
  std::vector<DiagramVertex> out;
  for (DiagramVertex v : diagram(maps).vertices) {
    std::sort(v.sites.begin(), v.sites.end());
    if (v.on_boundary) out.push_back(v);
  }
  std::sort(out.begin(), out.end(), [](const DiagramVertex& a, const DiagramVertex& b) {
    if (a.sites != b.sites) return a.sites < b.sites;
    return a.xyz.z() < b.xyz.z();
  });
  return out;
}

TEST(ReparameterizedBorder, HasTheSameBorderVerticesInSpace) {
  const auto shift = affine_map(1.0, 0.0);
  const auto plain = border_vertices({shift, shift});
  ASSERT_GE(plain.size(), 8u);
  const Maps others[] = {
      {cubic_map(kPatch.u, 0.8), cubic_map(kPatch.v, -0.5)},
      {moebius_map(kPatch.u, 4.0), moebius_map(kPatch.v, 0.3)},
      {cubic_map(kPatch.u, 1.5), moebius_map(kPatch.v, 2.0), true},
      {affine_map(-0.5, 3.0), cubic_map(kPatch.v, 0.5)},
  };
  for (const Maps& maps : others) {
    const auto there = border_vertices(maps);
    ASSERT_EQ(there.size(), plain.size());
    for (size_t i = 0; i < plain.size(); ++i) {
      EXPECT_EQ(there[i].sites, plain[i].sites);
      EXPECT_LT((there[i].xyz - plain[i].xyz).norm(), 1e-11) << i;
    }
  }
}

TEST(ReparameterizedBorder, HasItsVerticesOnTheTrueCircles) {
  const auto shift = affine_map(1.0, 0.0);
  for (const DiagramVertex& v : border_vertices({shift, shift})) {
    const double to_rim = std::hypot(v.uv.u - 1.2, v.uv.v) - 0.9,
                 to_hole = std::hypot(v.uv.u - 1.3, v.uv.v - 0.1) - 0.25;
    EXPECT_LT(std::min(std::abs(to_rim), std::abs(to_hole)), 1e-12);
  }
}

}  // namespace
}  // namespace geovor::testing
