#include "surface/offset_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "surface/derived_caps.h"
#include "surface/tangent_frame.h"

namespace geovor {
namespace {

// |Bu x Bv| below this part of |Bu| |Bv|, or of the larger of their squares, counts as a pole: the normal then has
// fewer than six good digits.
constexpr double kPole = 1e-10;

// At a pole the normal is taken this part of the domain further inside.
constexpr double kPoleStep = 1e-7;

// Below this part the normal is asked of the pole's chart, which has all its digits.
constexpr double kNearPole = 1e-3;

bool small_area(const SurfaceJet& b, double part) {
  const double longest = std::max(b.Su.squaredNorm(), b.Sv.squaredNorm());
  return !(b.Su.cross(b.Sv).norm() > part * longest);
}

bool is_pole(const SurfaceJet& b) { return small_area(b, kPole); }

// n = N / |N| and its derivatives from those of N = Bu x Bv.
struct Normal {
  double length;
  Xyz n, u, v;
  Normal(const SurfaceJet& b, const Xyz& Nu, const Xyz& Nv) {
    const Xyz N = b.Su.cross(b.Sv);
    length = N.norm();
    n = N / length;
    u = (Nu - n.dot(Nu) * n) / length;
    v = (Nv - n.dot(Nv) * n) / length;
  }
  // From |N| n = N by differentiating twice; the part along n follows from n.n = 1.
  Xyz second(const Xyz& Nab, const Xyz& Na, const Xyz& Nb, const Xyz& na, const Xyz& nb) const {
    const Xyz across = (Nab - n.dot(Na) * nb - n.dot(Nb) * na) / length;
    return across - (n.dot(across) + na.dot(nb)) * n;
  }
};

}  // namespace

OffsetSurface::OffsetSurface(SurfacePtr basis, double distance) : basis_(std::move(basis)), distance_(distance) {
  if (!basis_ || !std::isfinite(distance_))
    throw Error(ErrorCode::FaceRejected, "an offset surface has no basis or no finite distance; repair the surface");
}

// Towards the middle of the domain, in the directions in which that is finite.
Uv OffsetSurface::off_the_pole(Uv p) const {
  const UvBox box = basis_->domain();
  auto inward = [](const Interval& range, double x) {
    if (!std::isfinite(range.length())) return x + kPoleStep;
    return x < range.middle() ? x + kPoleStep * range.length() : x - kPoleStep * range.length();
  };
  return {inward(box.u, p.u), inward(box.v, p.v)};
}

// NaN where the basis has no normal.
Xyz OffsetSurface::moved(Uv p, const SurfaceJet& b) const {
  if (small_area(b, kNearPole)) return b.S + distance_ * tangent_frame(*basis_, p).n;
  return b.S + distance_ * b.Su.cross(b.Sv).normalized();
}

Xyz OffsetSurface::position(Uv p) const {
  const SurfaceJet b = basis_->jet(p);
  return is_pole(b) ? jet(p).S : moved(p, b);
}

SurfaceJet OffsetSurface::jet(Uv p, const Span& span) const {
  SurfaceJet b = basis_->jet(p, span);
  if (is_pole(b)) {
    const Uv q = off_the_pole(p);
    const SurfaceJet inside = basis_->jet(q, span);
    if (is_pole(inside)) return b;  // degenerate all around: no normal to follow
    SurfaceJet j = jet(q, span);
    const Xyz S = moved(p, b);
    j.S = S.allFinite() ? S : Xyz(b.S + (j.S - inside.S));
    return j;
  }
  const SurfaceThirds t = basis_->third(p, span);

  const Xyz Nu = b.Suu.cross(b.Sv) + b.Su.cross(b.Suv);
  const Xyz Nv = b.Suv.cross(b.Sv) + b.Su.cross(b.Svv);
  const Xyz Nuu = t.uuu.cross(b.Sv) + 2.0 * b.Suu.cross(b.Suv) + b.Su.cross(t.uuv);
  const Xyz Nuv = t.uuv.cross(b.Sv) + b.Suu.cross(b.Svv) + b.Su.cross(t.uvv);
  const Xyz Nvv = t.uvv.cross(b.Sv) + 2.0 * b.Suv.cross(b.Svv) + b.Su.cross(t.vvv);
  const Normal n(b, Nu, Nv);

  SurfaceJet j;
  j.S = moved(p, b);
  j.Su = b.Su + distance_ * n.u;
  j.Sv = b.Sv + distance_ * n.v;
  j.Suu = b.Suu + distance_ * n.second(Nuu, Nu, Nu, n.u, n.u);
  j.Suv = b.Suv + distance_ * n.second(Nuv, Nu, Nv, n.u, n.v);
  j.Svv = b.Svv + distance_ * n.second(Nvv, Nv, Nv, n.v, n.v);
  return j;
}

// The normal has one derivative less than the basis.
int OffsetSurface::continuity() const {
  const int order = basis_->continuity();
  return order == kSmooth ? kSmooth : std::max(order - 1, 0);
}

PoleCharts OffsetSurface::make_poles() const { return offset_poles(*this); }

}  // namespace geovor
