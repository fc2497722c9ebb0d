#include "surface/swept_surfaces.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "surface/revolution_cap.h"

namespace geovor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kInf = std::numeric_limits<double>::infinity();

void check(const Curve3Ptr& curve, const Xyz& direction) {
  if (!curve) throw Error(ErrorCode::FaceRejected, "a swept surface has no curve; repair the surface");
  if (!direction.allFinite() || !(direction.norm() > 0.0))
    throw Error(ErrorCode::FaceRejected, "a swept surface has no direction; repair the surface");
}

// Rodrigues: the part along the axis stays, the part across it turns. The derivative by the angle is axis x the turned
// vector.
struct Rotation {
  const Xyz& axis;
  double cosine, sine;
  Rotation(const Xyz& a, double angle) : axis(a), cosine(std::cos(angle)), sine(std::sin(angle)) {}
  Xyz operator()(const Xyz& w) const {
    const Xyz along = axis.dot(w) * axis;
    return along + cosine * (w - along) + sine * axis.cross(w);
  }
};

}  // namespace

RevolutionSurface::RevolutionSurface(Curve3Ptr meridian, const Xyz& origin, const Xyz& direction)
    : meridian_(std::move(meridian)), origin_(origin), axis_(direction.normalized()) {
  check(meridian_, direction);
}

UvBox RevolutionSurface::domain() const { return {{0.0, kTwoPi}, meridian_->domain()}; }
std::optional<double> RevolutionSurface::u_period() const { return kTwoPi; }

SurfaceJet RevolutionSurface::turn(double angle, const CurveJet<3>& c) const {
  const Rotation turned(axis_, angle);
  SurfaceJet j;
  const Xyz r = turned(c.C - origin_);
  j.S = origin_ + r;
  j.Su = axis_.cross(r);
  j.Suu = axis_.cross(j.Su);
  j.Sv = turned(c.d1);
  j.Suv = axis_.cross(j.Sv);
  j.Svv = turned(c.d2);
  return j;
}

Span RevolutionSurface::span(Uv p, UvVec towards) const {
  const CurvePiece piece = meridian_->piece(p.v, towards.v);
  return {0, piece.index, {{-kInf, kInf}, piece.box}};
}

SurfaceJet RevolutionSurface::jet(Uv p, const Span& span) const {
  return turn(p.u, meridian_->jet(p.v, CurvePiece{span.v, span.box.v}));
}

SurfaceThirds RevolutionSurface::third(Uv p, const Span& span) const {
  const CurveJet<3> c = meridian_->jet(p.v, CurvePiece{span.v, span.box.v});
  const Rotation turned(axis_, p.u);
  const Xyz su = axis_.cross(turned(c.C - origin_)), suv = axis_.cross(turned(c.d1));
  return {axis_.cross(axis_.cross(su)), axis_.cross(suv), axis_.cross(turned(c.d2)), turned(c.d3)};
}

PoleCharts RevolutionSurface::make_poles() const { return revolution_poles(*this); }

ExtrusionSurface::ExtrusionSurface(Curve3Ptr profile, const Xyz& direction)
    : profile_(std::move(profile)), direction_(direction) {
  check(profile_, direction);
}

UvBox ExtrusionSurface::domain() const { return {profile_->domain(), {-kInf, kInf}}; }

SurfaceJet ExtrusionSurface::shift(double v, const CurveJet<3>& c) const {
  return {c.C + v * direction_, c.d1, direction_, c.d2, Xyz::Zero(), Xyz::Zero()};
}

Span ExtrusionSurface::span(Uv p, UvVec towards) const {
  const CurvePiece piece = profile_->piece(p.u, towards.u);
  return {piece.index, 0, {piece.box, {-kInf, kInf}}};
}

SurfaceJet ExtrusionSurface::jet(Uv p, const Span& span) const {
  return shift(p.v, profile_->jet(p.u, CurvePiece{span.u, span.box.u}));
}

SurfaceThirds ExtrusionSurface::third(Uv p, const Span& span) const {
  const CurveJet<3> c = profile_->jet(p.u, CurvePiece{span.u, span.box.u});
  return {c.d3, Xyz::Zero(), Xyz::Zero(), Xyz::Zero()};
}

}  // namespace geovor
