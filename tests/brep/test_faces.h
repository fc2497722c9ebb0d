// Small surfaces, curves and faces for the tests of this room.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "brep/model.h"
#include "support/segment.h"

namespace geovor::testing {

inline constexpr double kPi = std::numbers::pi;

/// A surface given by its position and first derivatives; second derivatives are left zero, this room doesn't read
/// them.
class FunctionSurface final : public Surface {
 public:
  using Function = std::function<SurfaceJet(Uv)>;
  FunctionSurface(UvBox domain, Function f) : domain_(domain), f_(std::move(f)) {}
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return domain_; }
  std::optional<double> u_period() const override { return u_period_; }
  std::optional<double> v_period() const override { return v_period_; }
  SurfaceJet jet(Uv p) const override { return f_(p); }
  using Surface::jet;

  std::optional<double> u_period_, v_period_;

 private:
  UvBox domain_;
  Function f_;
};

inline SurfacePtr plane() {
  return std::make_shared<FunctionSurface>(UvBox{{-1e9, 1e9}, {-1e9, 1e9}}, [](Uv p) {
    return SurfaceJet{{p.u, p.v, 0}, {1, 0, 0}, {0, 1, 0}, Xyz::Zero(), Xyz::Zero(), Xyz::Zero()};
  });
}

/// (R + r cos v) rho(u) + r sin v Z; R = 0 is the sphere of radius r, with v in [-pi/2, pi/2].
inline SurfacePtr torus(double R, double r) {
  const double top = R > 0 ? 2 * kPi : kPi / 2;
  auto s = std::make_shared<FunctionSurface>(UvBox{{0, 2 * kPi}, {R > 0 ? 0 : -top, top}}, [R, r](Uv p) {
    const double cu = std::cos(p.u), su = std::sin(p.u), cv = std::cos(p.v), sv = std::sin(p.v), d = R + r * cv;
    return SurfaceJet{{d * cu, d * su, r * sv},
                      {-d * su, d * cu, 0},
                      {-r * sv * cu, -r * sv * su, r * cv},
                      Xyz::Zero(),
                      Xyz::Zero(),
                      Xyz::Zero()};
  });
  s->u_period_ = 2 * kPi;
  if (R > 0) s->v_period_ = 2 * kPi;
  return s;
}

inline SurfacePtr sphere(double r) { return torus(0.0, r); }

inline SurfacePtr cylinder(double r) {
  auto s = std::make_shared<FunctionSurface>(UvBox{{0, 2 * kPi}, {-1e9, 1e9}}, [r](Uv p) {
    const double c = std::cos(p.u), w = std::sin(p.u);
    return SurfaceJet{{r * c, r * w, p.v}, {-r * w, r * c, 0}, {0, 0, 1}, Xyz::Zero(), Xyz::Zero(), Xyz::Zero()};
  });
  s->u_period_ = 2 * kPi;
  return s;
}

/// z = a (u^2 + v^2).
inline SurfacePtr paraboloid(double a) {
  return std::make_shared<FunctionSurface>(UvBox{{-10, 10}, {-10, 10}}, [a](Uv p) {
    return SurfaceJet{{p.u, p.v, a * (p.u * p.u + p.v * p.v)},
                      {1, 0, 2 * a * p.u},
                      {0, 1, 2 * a * p.v},
                      Xyz::Zero(),
                      Xyz::Zero(),
                      Xyz::Zero()};
  });
}

/// An ellipse with axes along u and v; t from 0 to 2 pi, counter-clockwise.
class Ellipse2 final : public Curve2 {
 public:
  Ellipse2(Uv centre, double a, double b) : c_(centre), a_(a), b_(b) {}
  Interval domain() const override { return {0, 2 * kPi}; }
  CurveJet<2> jet(double t) const override {
    const double c = std::cos(t), s = std::sin(t);
    return {{c_.u + a_ * c, c_.v + b_ * s}, {-a_ * s, b_ * c}, {-a_ * c, -b_ * s}, {a_ * s, -b_ * c}};
  }

 private:
  Uv c_;
  double a_, b_;
};

/// A model of one face; edges are numbered as they come, none is degenerated.
class FaceBuilder {
 public:
  explicit FaceBuilder(SurfacePtr surface) { face_.surface = std::move(surface), face_.number = 1; }

  int edge(bool degenerate = false) {
    CadEdge e;
    if (!degenerate) e.curve = some_curve();
    model_.edges.push_back(e);
    return static_cast<int>(model_.edges.size()) - 1;
  }
  FaceBuilder& loop() {
    face_.loops.emplace_back();
    return *this;
  }
  FaceBuilder& add(int edge, Curve2Ptr curve, bool reversed = false) {
    face_.loops.back().coedges.push_back({edge, curve, curve->domain(), reversed});
    return *this;
  }
  FaceBuilder& polygon(const std::vector<Uv>& corners) {
    loop();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      add(edge(), std::make_shared<Segment>(corners[i], corners[(i + 1) % corners.size()]));
    }
    return *this;
  }
  FaceBuilder& rectangle(double u0, double v0, double u1, double v1) {
    return polygon({{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}});
  }
  FaceBuilder& ellipse(Uv c, double a, double b, bool hole = false) {
    loop();
    return add(edge(), std::make_shared<Ellipse2>(c, a, b), hole);
  }
  /// The strip u0 <= u <= u0 + 2 pi, v0 <= v <= v1 of a closed surface: a seam used twice, bottom and top.
  FaceBuilder& strip(double u0, double v0, double v1, bool bottom_is_pole = false, bool top_is_pole = false) {
    loop();
    const int seam = edge(), bottom = edge(bottom_is_pole), top = edge(top_is_pole);
    const double u1 = u0 + 2 * kPi;
    add(bottom, std::make_shared<Segment>(Uv{u0, v0}, Uv{u1, v0}));
    add(seam, std::make_shared<Segment>(Uv{u1, v0}, Uv{u1, v1}));
    add(top, std::make_shared<Segment>(Uv{u0, v1}, Uv{u1, v1}), true);
    return add(seam, std::make_shared<Segment>(Uv{u0, v0}, Uv{u0, v1}), true);
  }

  const CadModel& model() const { return model_; }
  CadFace& face() { return face_; }

 private:
  class Point3 final : public Curve3 {
   public:
    Interval domain() const override { return {0, 1}; }
    CurveJet<3> jet(double) const override { return {Xyz::Zero(), Xyz::Zero(), Xyz::Zero(), Xyz::Zero()}; }
  };
  static Curve3Ptr some_curve() { return std::make_shared<Point3>(); }

  CadModel model_;
  CadFace face_;
};

}  // namespace geovor::testing
