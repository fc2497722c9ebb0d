#include "brep/face_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "brep/face_loops.h"
#include "brep/flatten.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

UvBox bounds(const std::vector<std::vector<Uv>>& loops) {
  UvBox box{{kInf, -kInf}, {kInf, -kInf}};
  for (const auto& loop : loops) {
    for (const Uv p : loop) {
      box.u = {std::min(box.u.lo, p.u), std::max(box.u.hi, p.u)};
      box.v = {std::min(box.v.lo, p.v), std::max(box.v.hi, p.v)};
    }
  }
  return box;
}

/// The whole numbers k for which x + k * period lies in `around`.
struct Shifts {
  int first, last;
  double period;
};

Shifts shifts(std::optional<double> period, double x, const Interval& around) {
  if (!period) return {0, 0, 0.0};
  // A copy further out than this is no parameter any more, and the cast below must hold.
  constexpr double kFarthest = 1e6;
  const double first = std::ceil((around.lo - x) / *period), last = std::floor((around.hi - x) / *period);
  if (!(std::abs(first) < kFarthest && std::abs(last) < kFarthest)) return {0, 0, 0.0};
  return {static_cast<int>(first), static_cast<int>(last), *period};
}

/// Calls visit(copy) for every copy of p in `around` until one call returns true; p itself comes first.
template <typename Visit>
bool any_copy(const Surface& surface, const UvBox& around, Uv p, Visit&& visit) {
  const Shifts in_u = shifts(surface.u_period(), p.u, around.u);
  const Shifts in_v = shifts(surface.v_period(), p.v, around.v);
  const auto has_zero = [](const Shifts& s) { return s.first <= 0 && 0 <= s.last; };
  if (has_zero(in_u) && has_zero(in_v) && visit(p)) return true;
  for (int j = in_v.first; j <= in_v.last; ++j) {
    for (int i = in_u.first; i <= in_u.last; ++i) {
      if ((i != 0 || j != 0) && visit(Uv{p.u + i * in_u.period, p.v + j * in_v.period})) return true;
    }
  }
  return false;
}

UvBox widened(const UvBox& box, double du, double dv) {
  return {{box.u.lo - du, box.u.hi + du}, {box.v.lo - dv, box.v.hi + dv}};
}

UvBox widened_by_rounding(const BorderIndex& index) {
  return widened(index.box(), index.rounding_u(), index.rounding_v());
}

}  // namespace

FaceDomain::FaceDomain(const CadModel& model, const CadFace& face, double deflection)
    : surface_(face.surface), deflection_(deflection) {
  if (!(deflection > 0.0)) {
    throw Error(ErrorCode::Usage, "the deflection of a border must be positive; give a length above 0");
  }
  const std::vector<TrimLoop> loops = loops_or_whole_domain(face);
  const std::vector<int> uses = edge_uses(loops);
  std::vector<BorderSegment> all;
  for (const TrimLoop& loop : loops) {
    std::vector<Uv> points;
    std::vector<bool> real;  // whether the segment that starts at the point is border
    for (const Coedge& coedge : loop.coedges) {
      const std::vector<Uv> chain = flatten(*surface_, coedge, deflection);
      points.insert(points.end(), chain.begin(), chain.end());
      real.insert(real.end(), chain.size(), is_border(model, *surface_, coedge, uses));
    }
    std::vector<Uv> clean;
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Uv next = points[(i + 1) % n];
      if (points[i] == next) continue;
      clean.push_back(points[i]);
      all.push_back({points[i], next});
      if (real[i]) border_.push_back(all.back());
    }
    if (clean.size() >= 3) loops_.push_back(std::move(clean));
  }
  if (loops_.empty()) throw Error(ErrorCode::FaceRejected, "the loops of the face enclose nothing; repair the face");
  index_ = BorderIndex(all, bounds(loops_));
}

bool FaceDomain::contains(Uv p) const {
  if (!surface_->u_period() && !surface_->v_period()) return index_.side(p) != Side::Outside;
  return any_copy(*surface_, widened_by_rounding(index_), p, [&](Uv q) { return index_.side(q) != Side::Outside; });
}

Uv FaceDomain::to_principal(Uv p) const {
  Uv found = p;
  any_copy(*surface_, widened_by_rounding(index_), p, [&](Uv q) {
    if (index_.side(q) == Side::Outside) return false;
    found = q;
    return true;
  });
  return found;
}

double FaceDomain::distance_to_border(Uv p) const {
  const SurfaceJet j = surface_->jet(p);
  const double E = j.Su.dot(j.Su), F = j.Su.dot(j.Sv), G = j.Sv.dot(j.Sv);
  const auto product = [&](UvVec a, UvVec b) { return E * a.u * b.u + F * (a.u * b.v + a.v * b.u) + G * a.v * b.v; };
  double nearest2 = kInf;
  // One period more on each side: the border next to p may belong to the copy beyond the seam.
  const UvBox around = widened(box(), surface_->u_period().value_or(0.0), surface_->v_period().value_or(0.0));
  any_copy(*surface_, around, p, [&](Uv q) {
    for (const BorderSegment& s : border_) {
      const UvVec d = s.b - s.a, w = q - s.a;
      const double length2 = product(d, d);
      const double k = length2 > 0.0 ? std::clamp(product(w, d) / length2, 0.0, 1.0) : 0.0;
      const UvVec off = w - k * d;
      nearest2 = std::min(nearest2, product(off, off));
    }
    return false;
  });
  return std::sqrt(std::max(nearest2, 0.0));
}

std::optional<FaceDomain::Exit> FaceDomain::first_exit(const std::vector<Uv>& path, double slack) const {
  if (path.empty()) return std::nullopt;
  const auto deep_outside = [&](Uv p) { return !contains(p) && distance_to_border(p) > slack; };
  if (deep_outside(path[0])) return Exit{0, path[0]};
  std::optional<Exit> excursion;  // since where the path has been outside, though not deep
  const UvBox around = widened_by_rounding(index_);
  for (int n = 0; n + 1 < static_cast<int>(path.size()); ++n) {
    const Uv a = path[n], b = path[n + 1];
    // The border meets the segment where it meets one of the copies that reach into the box.
    const UvBox reach{{around.u.lo - std::max(0.0, b.u - a.u), around.u.hi + std::max(0.0, a.u - b.u)},
                      {around.v.lo - std::max(0.0, b.v - a.v), around.v.hi + std::max(0.0, a.v - b.v)}};
    std::vector<double> k{0.0, 1.0};
    any_copy(*surface_, reach, a, [&](Uv copy) {
      index_.meet(copy, copy + (b - a), k);
      return false;
    });
    std::sort(k.begin(), k.end());
    for (std::size_t i = 0; i + 1 < k.size(); ++i) {
      if (k[i] == k[i + 1]) continue;
      const Uv middle = lerp(a, b, 0.5 * (k[i] + k[i + 1]));
      if (contains(middle)) {
        excursion.reset();
        continue;
      }
      if (!excursion) excursion = Exit{n, lerp(a, b, k[i])};
      if (distance_to_border(middle) > slack) return excursion;
    }
    if (excursion && deep_outside(b)) return excursion;
  }
  return std::nullopt;
}

std::vector<Interval> FaceDomain::inside_at(double v) const {
  const std::vector<double> u = index_.crossings(v);
  std::vector<Interval> stretches;
  for (std::size_t i = 0; i + 1 < u.size(); i += 2) stretches.push_back({u[i], u[i + 1]});
  return stretches;
}

}  // namespace geovor
