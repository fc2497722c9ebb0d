#include "pipeline/face_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// A p-curve between two knots is halved at least so often, so that no bend hides between samples, and at most so often:
// deep enough for parameters that run a thousand times as fast at one end as at the other.
constexpr int kFewestHalvings = 2;
constexpr int kMostHalvings = 20;

// Newton's steps from a polyline to its curve; each doubles the digits.
constexpr int kNewtonSteps = 8;

// Halvings of a segment of the polyline: what is left of it is rounding.
constexpr int kRootHalvings = 53;

// Chords by which the way to a place is measured: a full turn has four quarters of some length.
constexpr int kWayChords = 4;
// How much longer than the straight way in space the straight way in the parameters may be: under any stretching of u
// and v each for itself it is no longer than the two legs of a right angle.
constexpr double kMostDetour = 2.0;

UvBox grown(UvBox box, Uv p) {
  return {{std::min(box.u.lo, p.u), std::max(box.u.hi, p.u)}, {std::min(box.v.lo, p.v), std::max(box.v.hi, p.v)}};
}

/// The distance from x to the segment from a to b.
double distance_to_segment(const Xyz& x, const Xyz& a, const Xyz& b) {
  const Xyz way = b - a;
  const double square = way.squaredNorm();
  const double f = square > 0.0 ? std::clamp((x - a).dot(way) / square, 0.0, 1.0) : 0.0;
  return (a + f * way - x).norm();
}

/// The length in space of the straight way in the parameters: tells two sides of a seam apart, which are one in space.
double length_of_way(const Surface& surface, Uv a, Uv b) {
  double length = 0.0;
  Xyz before = surface.position(a);
  for (int i = 1; i <= kWayChords; ++i) {
    const Xyz x = surface.position(lerp(a, b, static_cast<double>(i) / kWayChords));
    length += (x - before).norm();
    before = x;
  }
  return length;
}

}  // namespace

Uv OutlineSide::at(double parameter) const {
  const Eigen::Vector2d p = pcurve->position(parameter);
  return {p.x(), p.y()};
}

FaceOutline::FaceOutline(const CadModel& model, const CadFace& face, double deflection)
    : surface_(face.surface), box_{{kInf, -kInf}, {kInf, -kInf}} {
  for (int l = 0; l < static_cast<int>(face.loops.size()); ++l) {
    const auto& coedges = face.loops[l].coedges;
    const int first = static_cast<int>(sides_.size()), n = static_cast<int>(coedges.size());
    for (int k = 0; k < n; ++k) {
      const Coedge& c = coedges[k];
      if (!c.pcurve)
        throw Error(ErrorCode::FaceRejected, "an edge has no curve in the parameter plane; repair the face");
      OutlineSide side;
      side.loop = l, side.index = k, side.edge = c.edge, side.reversed = c.reversed, side.pcurve = c.pcurve;
      side.next = first + (k + 1) % n;
      side.t = {c.range.lo};
      side.uv = {side.at(c.range.lo)};
      std::vector<double> stops = c.pcurve->breaks(c.range);
      stops.push_back(c.range.hi);
      for (double stop : stops) sample(side, side.t.back(), stop, deflection, 0);
      for (Uv p : side.uv) {
        box_ = grown(box_, p);
        const Xyz x = surface_->position(p);
        side.arc.push_back(side.xyz.empty() ? 0.0 : side.arc.back() + (x - side.xyz.back()).norm());
        side.xyz.push_back(x);
      }
      side.pole = model.edges[c.edge].degenerate();
      sides_.push_back(std::move(side));
    }
  }
  for (int i = 0; i < static_cast<int>(sides_.size()); ++i) {
    for (int k = 0; k < i; ++k) {
      if (sides_[k].edge == sides_[i].edge && !sides_[i].pole) sides_[k].partner = i, sides_[i].partner = k;
    }
  }
}

void FaceOutline::sample(OutlineSide& side, double t0, double t1, double deflection, int depth) const {
  const double middle = 0.5 * (t0 + t1);
  const Uv a = side.at(t0), b = side.at(t1), m = side.at(middle);
  const Xyz A = surface_->position(a), B = surface_->position(b), M = surface_->position(m);
  const bool straight =
      (M - 0.5 * (A + B)).norm() <= deflection && (M - surface_->position(lerp(a, b, 0.5))).norm() <= deflection;
  if (depth < kFewestHalvings || (!straight && depth < kMostHalvings)) {
    sample(side, t0, middle, deflection, depth + 1);
    sample(side, middle, t1, deflection, depth + 1);
    return;
  }
  side.t.push_back(t1);
  side.uv.push_back(b);
  side.deviation = std::max(side.deviation, (M - 0.5 * (A + B)).norm());
}

bool FaceOutline::has(SideKind wanted) const {
  return std::any_of(sides_.begin(), sides_.end(), [&](const OutlineSide& s) { return kind(s) == wanted; });
}

SideKind FaceOutline::kind(const OutlineSide& side) {
  return side.pole ? SideKind::Pole : side.partner >= 0 ? SideKind::Seam : SideKind::Border;
}

// Places are compared in space: where the parameters are stretched (Su = 0 on a side, say) the metric at p says nothing
// of places beside it. From a point of the polyline that is far, no segment within that distance along it can be near.
OutlinePlace FaceOutline::nearest(Uv p, SideKind wanted, double reach) const {
  if (!has(wanted)) return {};
  if (wanted == SideKind::Pole) return nearest_pole(p, reach);
  const Xyz x = surface_->position(p);
  OutlinePlace best;
  double least = kMostDetour * reach;
  for (int i = 0; i < static_cast<int>(sides_.size()); ++i) {
    const OutlineSide& s = sides_[i];
    if (kind(s) != wanted) continue;
    const double margin = reach + 2.0 * s.deviation;  // measured at one point of each segment, it may be more beside it
    for (size_t k = 0; k + 1 < s.t.size();) {
      const double clear = (s.xyz[k] - x).norm() - margin;
      if (clear > s.arc[k + 1] - s.arc[k]) {
        k = static_cast<size_t>(std::upper_bound(s.arc.begin(), s.arc.end(), s.arc[k] + clear) - s.arc.begin()) - 1;
        continue;
      }
      if (distance_to_segment(x, s.xyz[k], s.xyz[k + 1]) <= margin) {
        const double t = foot(s, k, x), off = (surface_->position(s.at(t)) - x).norm();
        const double way = length_of_way(*surface_, p, s.at(t));
        if (off <= reach && way <= least) least = way, best = {i, t, off};
      }
      ++k;
    }
  }
  return best;
}

// Along the chord the curve between two points of the polyline ascends, whatever its speed.
double FaceOutline::foot(const OutlineSide& side, size_t segment, const Xyz& x) const {
  double lo = side.t[segment], hi = side.t[segment + 1];
  const Xyz chord = side.xyz[segment + 1] - side.xyz[segment];
  if (!((x - side.xyz[segment]).dot(chord) > 0.0)) return lo;
  if (!((side.xyz[segment + 1] - x).dot(chord) > 0.0)) return hi;
  for (int i = 0; i < kRootHalvings; ++i) {
    const double middle = 0.5 * (lo + hi);
    ((surface_->position(side.at(middle)) - x).dot(chord) < 0.0 ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

// Along a pole u means nothing in space: the nearest place is the one with the nearest parameters.
OutlinePlace FaceOutline::nearest_pole(Uv p, double reach) const {
  const double su = 1.0 / box_.u.length(), sv = 1.0 / box_.v.length();
  OutlinePlace best;
  double least = kInf;
  for (int i = 0; i < static_cast<int>(sides_.size()); ++i) {
    const OutlineSide& s = sides_[i];
    if (!s.pole) continue;
    for (size_t k = 0; k + 1 < s.t.size(); ++k) {
      const UvVec way = s.uv[k + 1] - s.uv[k], to = p - s.uv[k];
      const double square = way.u * way.u * su * su + way.v * way.v * sv * sv;
      const double dot = way.u * to.u * su * su + way.v * to.v * sv * sv;
      const double f = square > 0.0 ? std::clamp(dot / square, 0.0, 1.0) : 0.0;
      const UvVec gap = p - lerp(s.uv[k], s.uv[k + 1], f);
      const double off = std::hypot(gap.u * su, gap.v * sv);
      if (off <= least) least = off, best = {i, s.t[k] + f * (s.t[k + 1] - s.t[k]), off};
    }
  }
  if (best.side < 0) return best;
  const OutlineSide& s = sides_[best.side];
  for (int step = 0; step < kNewtonSteps; ++step) {
    const CurveJet<2> c = s.pcurve->jet(best.t);
    const double dot = (p.u - c.C.x()) * c.d1.x() * su * su + (p.v - c.C.y()) * c.d1.y() * sv * sv;
    const double square = c.d1.x() * c.d1.x() * su * su + c.d1.y() * c.d1.y() * sv * sv;
    if (!(square > 0.0)) break;
    best.t = std::clamp(best.t + dot / square, s.t.front(), s.t.back());
  }
  best.off = (surface_->position(p) - s.xyz.front()).norm();
  if (!(best.off <= reach)) best.side = -1;
  return best;
}

OutlinePlace FaceOutline::crossing(Uv a, Uv b, UvVec shift) const {
  OutlinePlace best;
  double least = kInf;
  // A crossing counts where it misses the ends of segments by rounding.
  constexpr double kSlack = 1e-9;
  for (int i = 0; i < static_cast<int>(sides_.size()); ++i) {
    const OutlineSide& s = sides_[i];
    if (kind(s) != SideKind::Seam) continue;
    const UvVec gap = (sides_[s.partner].uv.front() - s.uv.front()) + shift;
    const double far = std::abs(gap.u) / box_.u.length() + std::abs(gap.v) / box_.v.length();
    constexpr double kSameShift = 1e-3;  // p-curves of a seam are a period apart to the CAD's accuracy
    if (far > kSameShift) continue;
    for (size_t k = 0; k + 1 < s.t.size(); ++k) {
      const UvVec way = s.uv[k + 1] - s.uv[k];
      const double det = cross(b - a, way);
      const double along = cross(s.uv[k] - a, way) / det, across = cross(s.uv[k] - a, b - a) / det;
      if (!(along >= -kSlack && along <= 1.0 + kSlack && across >= -kSlack && across <= 1.0 + kSlack)) continue;
      if (along < least) least = along, best = {i, s.t[k] + std::clamp(across, 0.0, 1.0) * (s.t[k + 1] - s.t[k]), 0.0};
    }
  }
  return best;
}

std::vector<Uv> FaceOutline::between(int side, double t0, double t1) const {
  const OutlineSide& s = sides_[side];
  std::vector<Uv> points;
  for (size_t k = 0; k < s.t.size(); ++k) {
    if (s.t[k] > std::min(t0, t1) && s.t[k] < std::max(t0, t1)) points.push_back(s.uv[k]);
  }
  if (t1 < t0) std::reverse(points.begin(), points.end());
  return points;
}

}  // namespace geovor
