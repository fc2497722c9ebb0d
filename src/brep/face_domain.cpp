#include "brep/face_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "brep/face_loops.h"
#include "brep/flatten.h"
#include "surface/forms.h"

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
  for (const TrimLoop& loop : loops) {
    std::vector<BorderChord> chords;
    for (const Coedge& coedge : loop.coedges) {
      curves_.push_back(coedge.pcurve);
      for (BorderChord chord : flatten(*surface_, coedge, deflection)) {
        chord.ends_face = is_border(model, *surface_, coedge, uses);
        chords.push_back(chord);
      }
    }
    add_loop(std::move(chords));
  }
  if (loops_.empty()) throw Error(ErrorCode::FaceRejected, "the loops of the face enclose nothing; repair the face");
  std::vector<BorderSegment> all;
  std::vector<ChordBox> boxes;
  for (const auto& chords : chords_) {
    for (const BorderChord& c : chords) {
      all.push_back({c.a, c.b});
      if (!c.ends_face) continue;
      border_.push_back({c.a, c.b});
      boxes.push_back(ChordBox::around(c.a, c.b));
    }
  }
  border_tree_ = NestedBoxes<ChordBox>(boxes);
  index_ = BorderIndex(all, bounds(loops_));
}

// Gaps between the coedges, which the CAD's tolerance allows, are closed by straight chords; chords without length go.
void FaceDomain::add_loop(std::vector<BorderChord> chords) {
  std::vector<BorderChord> closed;
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const BorderChord &c = chords[i], &next = chords[(i + 1) % chords.size()];
    if (!(c.a == c.b)) closed.push_back(c);
    if (!(c.b == next.a)) closed.push_back({c.b, next.a, nullptr, 0.0, 0.0, c.ends_face});
  }
  if (closed.size() < 3) return;
  loops_.emplace_back();
  for (const BorderChord& c : closed) loops_.back().push_back(c.a);
  chords_.push_back(std::move(closed));
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
  const FirstForm I = first_form(surface_->jet(p));
  double nearest2 = kInf;
  // One period more on each side: the border next to p may belong to the copy beyond the seam.
  const UvBox around = widened(box(), surface_->u_period().value_or(0.0), surface_->v_period().value_or(0.0));
  any_copy(*surface_, around, p, [&](Uv q) {
    const auto enter = [&](const ChordBox& box) { return !(box.least_distance2(I, q) >= nearest2); };
    border_tree_.walk(enter, [&](int i) {
      const UvVec d = border_[i].b - border_[i].a, w = q - border_[i].a;
      const double length2 = dot(I, d, d);
      const double k = length2 > 0.0 ? std::clamp(dot(I, w, d) / length2, 0.0, 1.0) : 0.0;
      const UvVec off = w - k * d;
      nearest2 = std::min(nearest2, dot(I, off, off));
    });
    return false;
  });
  return std::sqrt(std::max(nearest2, 0.0));
}

// Ascending places k of lerp(a, b, k), 0 and 1 among them, between which the segment does not meet the border. The
// border meets the segment where it meets one of the copies that reach into the box.
std::vector<double> FaceDomain::border_crossings(Uv a, Uv b) const {
  const UvBox around = widened_by_rounding(index_);
  const UvBox reach{{around.u.lo - std::max(0.0, b.u - a.u), around.u.hi + std::max(0.0, a.u - b.u)},
                    {around.v.lo - std::max(0.0, b.v - a.v), around.v.hi + std::max(0.0, a.v - b.v)}};
  std::vector<double> k{0.0, 1.0};
  any_copy(*surface_, reach, a, [&](Uv copy) {
    index_.meet(copy, copy + (b - a), k);
    return false;
  });
  std::sort(k.begin(), k.end());
  k.erase(std::unique(k.begin(), k.end()), k.end());
  return k;
}

std::optional<FaceDomain::Exit> FaceDomain::first_exit(const std::vector<Uv>& path, double slack) const {
  if (path.empty()) return std::nullopt;
  std::optional<Exit> excursion;  // since where the path has been outside
  bool deep = false;              // and whether it went beyond the slack
  const auto look_outside = [&](const PathPlace& since, Uv p) {
    if (!excursion) excursion = Exit{since, std::nullopt};
    deep = deep || distance_to_border(p) > slack;
  };
  if (!contains(path[0])) look_outside({0, 0.0, path[0]}, path[0]);
  for (int n = 0; n + 1 < static_cast<int>(path.size()); ++n) {
    const Uv a = path[n], b = path[n + 1];
    const std::vector<double> k = border_crossings(a, b);
    for (std::size_t i = 0; i + 1 < k.size(); ++i) {
      const PathPlace begin{n, k[i], lerp(a, b, k[i])};
      const Uv middle = lerp(a, b, 0.5 * (k[i] + k[i + 1]));
      if (!contains(middle)) {
        look_outside(begin, middle);
      } else if (deep) {
        excursion->back = begin;
        return excursion;
      } else {
        excursion.reset();
      }
    }
    if (!contains(b)) look_outside({n, 1.0, b}, b);
  }
  return deep ? excursion : std::nullopt;
}

std::vector<Interval> FaceDomain::inside_at(double v) const {
  const std::vector<double> u = index_.crossings(v);
  std::vector<Interval> stretches;
  for (std::size_t i = 0; i + 1 < u.size(); i += 2) stretches.push_back({u[i], u[i + 1]});
  return stretches;
}

}  // namespace geovor
