#include "pipeline/face_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// A p-curve between two knots is halved at least so often, so that no bend hides between samples, and at most so often.
constexpr int kFewestHalvings = 2;
constexpr int kMostHalvings = 12;

// Newton's steps from a polyline to its curve; each doubles the digits.
constexpr int kNewtonSteps = 8;

UvBox grown(UvBox box, Uv p) {
  return {{std::min(box.u.lo, p.u), std::max(box.u.hi, p.u)}, {std::min(box.v.lo, p.v), std::max(box.v.hi, p.v)}};
}

double distance_to(const UvBox& box, Uv p, double su, double sv) {
  const double du = std::max({box.u.lo - p.u, p.u - box.u.hi, 0.0}) * su;
  const double dv = std::max({box.v.lo - p.v, p.v - box.v.hi, 0.0}) * sv;
  return std::hypot(du, dv);
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
      side.box = {{kInf, -kInf}, {kInf, -kInf}};
      for (Uv p : side.uv) side.box = grown(side.box, p), box_ = grown(box_, p);
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
}

bool FaceOutline::has(SideKind wanted) const {
  return std::any_of(sides_.begin(), sides_.end(), [&](const OutlineSide& s) { return kind(s) == wanted; });
}

SideKind FaceOutline::kind(const OutlineSide& side) {
  return side.pole ? SideKind::Pole : side.partner >= 0 ? SideKind::Seam : SideKind::Border;
}

// Along a pole u means nothing in space: there the nearest place is the one with the nearest parameters.
OutlinePlace FaceOutline::nearest(Uv p, SideKind wanted, double reach) const {
  if (!has(wanted)) return {};
  const SurfaceJet j = surface_->jet(p);
  const bool pole = wanted == SideKind::Pole;
  const double su = pole ? 1.0 / box_.u.length() : j.Su.norm(), sv = pole ? 1.0 / box_.v.length() : j.Sv.norm();
  OutlinePlace best;
  double least = pole ? kInf : reach;
  for (int i = 0; i < static_cast<int>(sides_.size()); ++i) {
    const OutlineSide& s = sides_[i];
    if (kind(s) != wanted || distance_to(s.box, p, su, sv) > least) continue;
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
  const UvVec gap = p - s.at(best.t);
  best.off = pole ? (j.S - surface_->position(s.uv.front())).norm() : std::hypot(gap.u * su, gap.v * sv);
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
