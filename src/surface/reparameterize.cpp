#include "surface/reparameterize.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "surface/derived_caps.h"

namespace geovor {
namespace {

class Affine final : public ParameterMap {
 public:
  Affine(double scale, double shift) : scale_(scale), shift_(shift) { assert(scale != 0.0); }
  Jet jet(double t) const override { return {scale_ * t + shift_, scale_, 0.0, 0.0}; }
  double inverse(double x) const override { return (x - shift_) / scale_; }
  bool affine() const override { return true; }

 private:
  double scale_, shift_;
};

class Moebius final : public ParameterMap {
 public:
  Moebius(Interval range, double A) : range_(range), A_(A) { assert(A > 0.0); }
  Jet jet(double t) const override {
    const double D = t + A_ * (1.0 - t), L = range_.length();
    const double d1 = L * A_ / (D * D), d2 = -2.0 * d1 * (1.0 - A_) / D;
    return {range_.lo + L * t / D, d1, d2, -3.0 * d2 * (1.0 - A_) / D};
  }
  double inverse(double x) const override {
    if (std::isinf(x)) return x;
    const double s = (x - range_.lo) / range_.length();
    return A_ * s / (1.0 + (A_ - 1.0) * s);
  }

 private:
  Interval range_;
  double A_;
};

class Cubic final : public ParameterMap {
 public:
  Cubic(Interval range, double k) : range_(range), k_(k) { assert(-1.0 < k && k < 2.0); }
  Jet jet(double t) const override {
    const double L = range_.length();
    return {range_.lo + L * (t + k_ * t * (1.0 - t) * (1.0 - 2.0 * t)), L * (1.0 + k_ * (1.0 - 6.0 * t + 6.0 * t * t)),
            L * k_ * (12.0 * t - 6.0), L * k_ * 12.0};
  }
  // Newton inside a bracket that it shrinks; the map ascends on [0, 1], and the domain's parameters stay there.
  double inverse(double x) const override {
    if (std::isinf(x)) return x;
    constexpr int kEnough = 100;
    double lo = 0.0, hi = 1.0, t = (x - range_.lo) / range_.length();
    if (t <= lo || t >= hi) return t;
    for (int i = 0; i < kEnough && lo < hi; ++i) {
      const Jet j = jet(t);
      if (j.x == x) break;
      (j.x < x ? lo : hi) = t;
      double next = t - (j.x - x) / j.d1;
      if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
      if (next == t) break;
      t = next;
    }
    return t;
  }

 private:
  Interval range_;
  double k_;
};

// The map takes an interval to an interval but may turn it round.
template <class Map>
Interval image(const Map& map, const Interval& x) {
  const double a = map(x.lo), b = map(x.hi);
  return a <= b ? Interval{a, b} : Interval{b, a};
}

double old_of(const ParameterMap& map, double t) {
  if (!std::isinf(t)) return map.jet(t).x;
  return map.descends() ? -t : t;
}

std::optional<double> scaled(const std::optional<double>& period, const ParameterMap& map) {
  if (!period || !map.affine()) return std::nullopt;
  return *period / std::abs(map.jet(0.0).d1);
}

}  // namespace

ParameterMapPtr affine_map(double scale, double shift) { return std::make_shared<Affine>(scale, shift); }
ParameterMapPtr moebius_map(Interval range, double A) { return std::make_shared<Moebius>(range, A); }
ParameterMapPtr cubic_map(Interval range, double k) { return std::make_shared<Cubic>(range, k); }

Reparameterized::Reparameterized(SurfacePtr base, ParameterMapPtr u_map, ParameterMapPtr v_map, bool swap_axes)
    : base_(std::move(base)),
      u_map_(u_map ? std::move(u_map) : affine_map(1.0, 0.0)),
      v_map_(v_map ? std::move(v_map) : affine_map(1.0, 0.0)),
      swap_(swap_axes) {}

Uv Reparameterized::to_base(Uv p) const {
  if (swap_) std::swap(p.u, p.v);
  return {u_map_->jet(p.u).x, v_map_->jet(p.v).x};
}

Uv Reparameterized::from_base(Uv p) const {
  Uv q{u_map_->inverse(p.u), v_map_->inverse(p.v)};
  if (swap_) std::swap(q.u, q.v);
  return q;
}

UvBox Reparameterized::box_from_base(const UvBox& box) const {
  UvBox image_box{image([this](double x) { return u_map_->inverse(x); }, box.u),
                  image([this](double x) { return v_map_->inverse(x); }, box.v)};
  if (swap_) std::swap(image_box.u, image_box.v);
  return image_box;
}

UvBox Reparameterized::domain() const { return box_from_base(base_->domain()); }

std::optional<double> Reparameterized::u_period() const {
  return swap_ ? scaled(base_->v_period(), *v_map_) : scaled(base_->u_period(), *u_map_);
}

std::optional<double> Reparameterized::v_period() const {
  return swap_ ? scaled(base_->u_period(), *u_map_) : scaled(base_->v_period(), *v_map_);
}

// With S'(a, b) = S(x(a), y(b)): S'_a = S_u x', S'_aa = S_uu x'^2 + S_u x'', S'_ab = S_uv x' y'.
SurfaceJet Reparameterized::chain(const SurfaceJet& b, const ParameterMap::Jet& u, const ParameterMap::Jet& v) const {
  SurfaceJet j;
  j.S = b.S;
  j.Su = u.d1 * b.Su;
  j.Sv = v.d1 * b.Sv;
  j.Suu = u.d1 * u.d1 * b.Suu + u.d2 * b.Su;
  j.Suv = u.d1 * v.d1 * b.Suv;
  j.Svv = v.d1 * v.d1 * b.Svv + v.d2 * b.Sv;
  if (swap_) {
    std::swap(j.Su, j.Sv);
    std::swap(j.Suu, j.Svv);
  }
  return j;
}

SurfaceJet Reparameterized::jet(Uv p) const {
  if (swap_) std::swap(p.u, p.v);
  const ParameterMap::Jet u = u_map_->jet(p.u), v = v_map_->jet(p.v);
  return chain(base_->jet({u.x, v.x}), u, v);
}

// S'_aaa = S_uuu x'^3 + 3 S_uu x' x'' + S_u x''', S'_aab = (S_uuv x'^2 + S_uv x'') y'.
SurfaceThirds Reparameterized::third(Uv p, const Span& span) const {
  if (swap_) std::swap(p.u, p.v);
  const ParameterMap::Jet u = u_map_->jet(p.u), v = v_map_->jet(p.v);
  const Span on_base{span.u, span.v, box_to_base(span.box)};
  const SurfaceJet j = base_->jet({u.x, v.x}, on_base);
  const SurfaceThirds b = base_->third({u.x, v.x}, on_base);
  SurfaceThirds t;
  t.uuu = u.d1 * u.d1 * u.d1 * b.uuu + 3.0 * u.d1 * u.d2 * j.Suu + u.d3 * j.Su;
  t.uuv = v.d1 * (u.d1 * u.d1 * b.uuv + u.d2 * j.Suv);
  t.uvv = u.d1 * (v.d1 * v.d1 * b.uvv + v.d2 * j.Suv);
  t.vvv = v.d1 * v.d1 * v.d1 * b.vvv + 3.0 * v.d1 * v.d2 * j.Svv + v.d3 * j.Sv;
  if (swap_) {
    std::swap(t.uuu, t.vvv);
    std::swap(t.uuv, t.uvv);
  }
  return t;
}

// The base finds its piece again by the piece's own numbers and box, so both are handed back to it.
Span Reparameterized::span(Uv p, UvVec towards) const {
  if (swap_) {
    std::swap(p.u, p.v);
    std::swap(towards.u, towards.v);
  }
  const ParameterMap::Jet u = u_map_->jet(p.u), v = v_map_->jet(p.v);
  const Span s = base_->span({u.x, v.x}, {u.d1 * towards.u, v.d1 * towards.v});
  return {s.u, s.v, box_from_base(s.box)};
}

UvBox Reparameterized::box_to_base(const UvBox& box) const {
  UvBox b = box;
  if (swap_) std::swap(b.u, b.v);
  return {image([this](double t) { return old_of(*u_map_, t); }, b.u),
          image([this](double t) { return old_of(*v_map_, t); }, b.v)};
}

SurfaceJet Reparameterized::jet(Uv p, const Span& span) const {
  if (swap_) std::swap(p.u, p.v);
  const ParameterMap::Jet u = u_map_->jet(p.u), v = v_map_->jet(p.v);
  return chain(base_->jet({u.x, v.x}, {span.u, span.v, box_to_base(span.box)}), u, v);
}

PoleCharts Reparameterized::make_poles() const { return reparameterized_poles(*this); }

}  // namespace geovor
