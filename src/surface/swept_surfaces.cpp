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

}  // namespace

RevolutionSurface::RevolutionSurface(Curve3Ptr meridian, const Xyz& origin, const Xyz& direction)
    : meridian_(std::move(meridian)), origin_(origin), axis_(direction.normalized()) {
  check(meridian_, direction);
}

UvBox RevolutionSurface::domain() const { return {{0.0, kTwoPi}, meridian_->domain()}; }
std::optional<double> RevolutionSurface::u_period() const { return kTwoPi; }

// Rodrigues: the part along the axis stays, the part across it turns. The derivative by the angle is axis x the turned
// vector.
SurfaceJet RevolutionSurface::turn(double angle, const CurveJet<3>& c) const {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  auto turned = [&](const Xyz& w) -> Xyz {
    const Xyz along = axis_.dot(w) * axis_;
    return along + cosine * (w - along) + sine * axis_.cross(w);
  };
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

}  // namespace geovor
