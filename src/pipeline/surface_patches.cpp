#include "pipeline/surface_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace geovor {
namespace {

/// Points a side at which a patch is looked at.
constexpr int kLooks = 5;
/// A patch is flat enough where the second differences of neighbouring looks are below this part of it: an arc that
/// turns by a radians has a / 16 there.
constexpr double kFlat = 0.02;
/// More pieces of a spline than this in one patch could hide between the looks.
constexpr int kMostSpans = 2;
constexpr int kMostHalvings = 26;
/// A border that passes a patch nearer than this part of it counts as passing through: the flattened border deviates
/// from the true one, and feet may lie a rounding outside of the rectangle.
constexpr double kMargin = 1e-3;

using Looks = std::array<std::array<Xyz, kLooks>, kLooks>;  // [along u][along v]

UvBox widened(const UvBox& b) {
  const double du = kMargin * b.u.length(), dv = kMargin * b.v.length();
  return {{b.u.lo - du, b.u.hi + du}, {b.v.lo - dv, b.v.hi + dv}};
}

class Cutter {
 public:
  Cutter(const FaceDomain& domain, double negligible) : domain_(domain), negligible_(negligible) {
    std::vector<Chord> all;
    for (const auto& loop : domain.chords()) {
      for (const BorderChord& c : loop) all.push_back({c.a, c.b});
    }
    cut(domain.box(), all, 0);
  }

  std::vector<SurfacePatch> patches;

 private:
  struct Chord {
    Uv a, b;
  };

  Looks look(const UvBox& box) const {
    Looks s;
    for (int i = 0; i < kLooks; ++i) {
      for (int k = 0; k < kLooks; ++k) {
        s[i][k] = domain_.surface().position(
            {box.u.lo + box.u.length() * i / (kLooks - 1), box.v.lo + box.v.length() * k / (kLooks - 1)});
      }
    }
    return s;
  }

  /// How many pieces of the surface the rectangle spans in each direction, less one.
  std::array<int, 2> spans(const UvBox& box) const {
    const Surface& s = domain_.surface();
    const Span lo = s.span({box.u.lo, box.v.lo}, {1.0, 1.0}), hi = s.span({box.u.hi, box.v.hi}, {-1.0, -1.0});
    return {std::abs(hi.u - lo.u), std::abs(hi.v - lo.v)};
  }

  void cut(const UvBox& box, const std::vector<Chord>& chords, int halvings);
  void keep(const UvBox& box, const Looks& s, double bulge, bool inside);

  const FaceDomain& domain_;
  double negligible_;
};

void Cutter::cut(const UvBox& box, const std::vector<Chord>& chords, int halvings) {
  std::vector<Chord> here;
  const ChordBox wide{widened(box)};
  for (const Chord& c : chords) {
    if (wide.may_meet(c.a, c.b)) here.push_back(c);
  }
  if (here.empty() && !domain_.contains({box.u.middle(), box.v.middle()})) return;
  const Looks s = look(box);
  double along_u = 0.0, along_v = 0.0;
  for (int i = 0; i < kLooks; ++i) {
    for (int k = 0; k + 2 < kLooks; ++k) {
      along_u = std::max(along_u, (s[k][i] - 2.0 * s[k + 1][i] + s[k + 2][i]).norm());
      along_v = std::max(along_v, (s[i][k] - 2.0 * s[i][k + 1] + s[i][k + 2]).norm());
    }
  }
  const double across =
      std::max((s[0][0] - s[kLooks - 1][kLooks - 1]).norm(), (s[0][kLooks - 1] - s[kLooks - 1][0]).norm());
  const auto [spans_u, spans_v] = spans(box);
  const bool many = std::max(spans_u, spans_v) > kMostSpans;
  const double bulge = std::max(along_u, along_v);
  if (halvings == kMostHalvings || !(many || bulge > std::max(kFlat * across, negligible_))) {
    keep(box, s, bulge, here.empty());
    return;
  }
  UvBox lower = box, upper = box;
  if (many ? spans_u >= spans_v : along_u >= along_v) {
    lower.u.hi = upper.u.lo = box.u.middle();
  } else {
    lower.v.hi = upper.v.lo = box.v.middle();
  }
  cut(lower, here, halvings + 1);
  cut(upper, here, halvings + 1);
}

// Between the looks the patch leaves their hull by an eighth of the second differences: boxes are larger by the whole.
void Cutter::keep(const UvBox& box, const Looks& s, double bulge, bool inside) {
  SurfacePatch p;
  p.box = box;
  p.inside = inside;
  p.middle = {box.u.middle(), box.v.middle()};
  const SurfaceJet j = domain_.surface().jet(p.middle);
  p.S = j.S;
  p.Su = j.Su;
  p.Sv = j.Sv;
  Xyz along = j.Su.norm() > 0.0 ? Xyz(j.Su.stableNormalized()) : Xyz(Xyz::UnitX());
  const Xyz across = j.Sv - j.Sv.dot(along) * along;
  const Xyz second = across.norm() > 0.0 ? Xyz(across.stableNormalized()) : Xyz(along.unitOrthogonal());
  p.axes.row(0) = along;
  p.axes.row(1) = second;
  p.axes.row(2) = along.cross(second);
  p.extent = {Xyz::Zero(), Xyz::Zero()};
  p.space = {j.S, j.S};
  for (const auto& row : s) {
    for (const Xyz& x : row) {
      p.extent.include(Xyz(p.axes * (x - p.S)));
      p.space.include(x);
    }
  }
  for (SpaceBox* b : {&p.extent, &p.space}) {
    b->lo.array() -= bulge;
    b->hi.array() += bulge;
  }
  patches.push_back(p);
}

}  // namespace

Uv SurfacePatch::guess(const Xyz& x) const {
  const Xyz r = x - S;
  const double E = Su.squaredNorm(), F = Su.dot(Sv), G = Sv.squaredNorm(), W2 = E * G - F * F;
  const double a = r.dot(Su), b = r.dot(Sv);
  if (!(W2 > 0.0)) return middle;
  const Uv p = middle + UvVec{(G * a - F * b) / W2, (E * b - F * a) / W2};
  return is_finite(p) ? box.clamp(p) : middle;
}

std::vector<SurfacePatch> surface_patches(const FaceDomain& domain, double negligible) {
  return Cutter(domain, negligible).patches;
}

}  // namespace geovor
