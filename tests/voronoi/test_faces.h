// Faces and site sets for the tests of diagrams.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "brep/face_domain.h"
#include "support/segment.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"

namespace geovor::testing {

inline constexpr double kPi = std::numbers::pi;

/// Stands for an edge's curve, of which diagrams ask nothing.
class NoCurve final : public Curve3 {
 public:
  Interval domain() const override { return {0, 1}; }
  CurveJet<3> jet(double) const override { return {Xyz::Zero(), Xyz::Zero(), Xyz::Zero(), Xyz::Zero()}; }
};

/// A face in a model of its own.
struct TestFace {
  CadModel model;
  FaceDomain domain() const { return {model, model.faces[0], 1e-6}; }

  explicit TestFace(SurfacePtr surface) {
    model.faces.emplace_back();
    model.faces[0].surface = std::move(surface);
    model.faces[0].number = 1;
  }

  int edge() {
    model.edges.emplace_back();
    model.edges.back().curve = std::make_shared<NoCurve>();
    model.edges.back().range = {0, 1};
    return static_cast<int>(model.edges.size()) - 1;
  }

  void side(int edge, Uv a, Uv b, bool reversed = false) {
    model.faces[0].loops.back().coedges.push_back({edge, std::make_shared<Segment>(a, b), {0, 1}, reversed});
  }

  TestFace& polygon(const std::vector<Uv>& corners) {
    model.faces[0].loops.emplace_back();
    for (size_t i = 0; i < corners.size(); ++i) side(edge(), corners[i], corners[(i + 1) % corners.size()]);
    return *this;
  }

  TestFace& rectangle(const UvBox& b) {
    return polygon({{b.u.lo, b.v.lo}, {b.u.hi, b.v.lo}, {b.u.hi, b.v.hi}, {b.u.lo, b.v.hi}});
  }

  /// Once around in u: the seam is used twice.
  TestFace& ring(const UvBox& b) {
    model.faces[0].loops.emplace_back();
    const int bottom = edge(), seam = edge(), top = edge();
    side(bottom, {b.u.lo, b.v.lo}, {b.u.hi, b.v.lo});
    side(seam, {b.u.hi, b.v.lo}, {b.u.hi, b.v.hi});
    side(top, {b.u.hi, b.v.hi}, {b.u.lo, b.v.hi});
    side(seam, {b.u.lo, b.v.lo}, {b.u.lo, b.v.hi}, true);
    return *this;
  }
};

inline constexpr UvBox kSquare = {{-1.0, 1.0}, {-1.0, 1.0}};

inline TestFace plane_square() { return TestFace(std::make_shared<Plane>(Frame{})).rectangle(kSquare); }

/// Without loops a face is its surface's whole domain.
inline TestFace whole(SurfacePtr surface) { return TestFace(std::move(surface)); }

/// Uniform numbers of [0, 1), the same with every standard library.
class Uniform {
 public:
  explicit Uniform(unsigned seed) : engine_(seed) {}
  double operator()() { return engine_() / 4294967296.0; }
  Uv in(const UvBox& b) {
    const double u = (*this)(), v = (*this)();
    return {b.u.lo + u * b.u.length(), b.v.lo + v * b.v.length()};
  }

 private:
  std::mt19937 engine_;
};

inline std::vector<Uv> random_sites(const FaceDomain& domain, int count, unsigned seed) {
  Uniform random(seed);
  std::vector<Uv> sites;
  for (int i = 0; i < count; ++i) sites.push_back(random.in(domain.box()));
  return sites;
}

}  // namespace geovor::testing
