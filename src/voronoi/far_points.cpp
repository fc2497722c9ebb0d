#include "voronoi/far_points.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "geodesic/trace.h"
#include "surface/forms.h"
#include "voronoi/bisector.h"

namespace geovor {
namespace {

// Of the radius: what its values along an edge that is equally far everywhere agree to.
constexpr double kLevel = 1e-9;

// Of the distance along the border: what a rough ray does not tell from none.
constexpr double kNoSlope = 1e-5;

// Of the radius: a cut locus no longer than this is a point.
constexpr double kPoint = 1e-3;

// Halvings of a stretch of an edge or a ray until the place is as exact as its distance.
constexpr int kHalvings = 48;

// A ray back from the border is asked in steps of this part of its length whether it has met a hole; a face narrower
// than the other part of it behind the border has no place there.
constexpr double kLongestStep = 0.125;
constexpr double kNarrowest = 1e-3;

// Steps along a geodesic to the point opposite its start, on a sphere of the start's curvature; how many spheres far.
constexpr int kOppositeSteps = 64;
constexpr int kSpheres = 4;

/// Where a function that is positive at lo and negative at hi changes sign; Illinois: false position whose stale end
/// loses weight. Nothing where it has no value.
template <class Function>
std::optional<double> sign_change(const Function& f, double lo, double hi, double at_lo, double at_hi) {
  constexpr double kEnough = 1e-13;
  const double whole = std::abs(hi - lo);
  for (int i = 0; i < kHalvings && std::abs(hi - lo) > kEnough * whole; ++i) {
    const double middle = lo + (hi - lo) * at_lo / (at_lo - at_hi);
    const auto value = f(middle);
    if (!value) return std::nullopt;
    if (*value == 0.0) return middle;
    if (*value > 0.0) {
      lo = middle, at_lo = *value, at_hi *= 0.5;
    } else {
      hi = middle, at_hi = *value, at_lo *= 0.5;
    }
  }
  return lo + (hi - lo) * at_lo / (at_lo - at_hi);
}

/// The piece of an edge between two stored points.
class EdgeStep {
 public:
  EdgeStep(const SiteRays& rays, const DiagramEdge& e, int k)
      : rays_(rays), e_(e), a_(e.points[k]), b_(e.points[k + 1]), way_(b_.xyz - a_.xyz) {}

  /// The point of the edge above the fraction k of the chord.
  std::optional<BisectorPoint> at(double k) const { return in_plane(k, way_.normalized(), a_.xyz + k * way_); }

  /// The point of the edge in a plane, near the fraction k of the chord.
  std::optional<BisectorPoint> in_plane(double k, const Xyz& normal, const Xyz& through) const {
    const double h = way_.norm();
    // Hermite's cubic through the values and slopes at both ends.
    const auto between = [&](double p, double dp, double q, double dq) {
      const double rest = q - p;
      return p + k * (dp * h + k * (3 * rest - (2 * dp + dq) * h + k * ((dp + dq) * h - 2 * rest)));
    };
    const BisectorCoordinates guess = {
        between(a_.radius, a_.radius_slope, b_.radius, b_.radius_slope),
        between(a_.left_angle, a_.left_slope, near(a_.left_angle, b_.left_angle), b_.left_slope),
        between(a_.right_angle, a_.right_slope, near(a_.right_angle, b_.right_angle), b_.right_slope)};
    return correct_bisector(rays_, e_.left, e_.right, guess, {normal, normal.dot(through)});
  }

 private:
  static double near(double t, double other) { return t + wrap_angle(other - t); }

  const SiteRays& rays_;
  const DiagramEdge& e_;
  const EdgePoint &a_, &b_;
  Xyz way_;
};

/// Direction in which the edge runs through its k-th point.
Xyz direction(const DiagramEdge& e, int k) {
  const int n = static_cast<int>(e.points.size());
  return (e.points[std::min(k + 1, n - 1)].xyz - e.points[std::max(k - 1, 0)].xyz).normalized();
}

/// Sorts by falling `key`, calls keys equal that agree to `tolerance` with their neighbours, and sorts each such run by
/// the next key.
template <class Keys>
void sort_by(std::vector<FarPoint>::iterator begin, std::vector<FarPoint>::iterator end, const Keys& keys, size_t k,
             double scale) {
  if (k == keys.size()) return;
  std::sort(begin, end, [&](const FarPoint& a, const FarPoint& b) { return keys[k](a) > keys[k](b); });
  for (auto run = begin; run != end;) {
    auto next = run + 1;
    while (next != end && keys[k](*(next - 1)) - keys[k](*next) <= FarPoints::kSameReach * scale) ++next;
    sort_by(run, next, keys, k + 1, scale);
    run = next;
  }
}

/// Whether the cut locus of one site alone is a point, as on a sphere, or so small that it makes no difference.
bool meets_in_a_point(const VoronoiDiagram& diagram) {
  const auto small = [](const DiagramEdge& e) { return e.length <= kPoint * e.points.front().radius; };
  return diagram.sites.size() == 1 && std::all_of(diagram.edges.begin(), diagram.edges.end(), small);
}

}  // namespace

FarPoints::FarPoints(const SiteRays& rays, const VoronoiDiagram& diagram, const BorderDistance& border, const Xyz& tie)
    : rays_(rays), diagram_(diagram), border_(border), tie_(tie) {
  if (border.empty() && meets_in_a_point(diagram)) {
    add_opposite_point();
    return;
  }
  add_vertices();
  for (const DiagramEdge& e : diagram.edges) {
    add_edge_tops(e);
    if (e.closed()) continue;
    if (diagram.vertices[e.from].on_boundary) add_edge_near_border(e, false);
    if (diagram.vertices[e.to].on_boundary) add_edge_near_border(e, true);
  }
  for (const DiagramCell& cell : diagram.cells) {
    for (const auto& loop : cell.loops) {
      for (const CellPiece& piece : loop) {
        if (piece.edge < 0) add_stretch(cell, piece);
      }
    }
  }
  put_in_order();
}

void FarPoints::add(Uv uv, const Xyz& x, double distance) {
  points_.push_back({uv, x, std::min(distance, 2.0 * border_.to(x, 0.5 * distance))});
}

void FarPoints::add_vertices() {
  for (const DiagramVertex& v : diagram_.vertices) {
    if (!v.on_boundary) add(v.uv, v.xyz, v.radius);
  }
}

// The largest radius inside an edge, which bisectors of a plane don't have; where the radius is the same all along the
// edge (the equator between two poles) its extreme point in the direction of the tie.
void FarPoints::add_edge_tops(const DiagramEdge& e) {
  const auto by_radius = [](const EdgePoint& a, const EdgePoint& b) { return a.radius < b.radius; };
  const auto [low, high] = std::minmax_element(e.points.begin(), e.points.end(), by_radius);
  const bool level = high->radius - low->radius <= kLevel * high->radius;
  if (level && !e.closed()) return;  // its ends are as far
  const int n = static_cast<int>(e.points.size());
  const auto slope = [&](int k) { return level ? direction(e, k).dot(tie_) : e.points[k].radius_slope; };
  for (int k = 0; k + 1 < n; ++k) {
    if (!(slope(k) > 0.0 && slope(k + 1) <= 0.0)) continue;
    const EdgeStep step(rays_, e, k);
    const Xyz way = e.points[k + 1].xyz - e.points[k].xyz;
    const auto rises = [&](double at) -> std::optional<double> {
      const auto m = step.at(at);
      if (!m) return std::nullopt;
      const double forward = m->tangent().dot(way) > 0.0 ? 1.0 : -1.0;
      return forward * (level ? m->tangent().dot(tie_) : bisector_slope(*m).radius);
    };
    const auto at = sign_change(rises, 0.0, 1.0, slope(k), std::min(slope(k + 1), -slope(k) * kLevel));
    const auto top = at ? step.at(*at) : std::nullopt;
    if (top) add(top->left.uv, top->position(), top->radius());
  }
}

// On the border the reach is zero; inwards along the edge it grows until the sites are half as near as the border.
void FarPoints::add_edge_near_border(const DiagramEdge& e, bool from_end) {
  const int n = static_cast<int>(e.points.size());
  const auto excess = [&](double radius, const Xyz& x) { return radius - 2.0 * border_.to(x, radius); };
  double last = 0.0;
  for (int i = 0; i < n; ++i) {
    const int k = from_end ? n - 1 - i : i;
    const double here = i == 0 ? e.points[k].radius : excess(e.points[k].radius, e.points[k].xyz);
    if (here <= 0.0) {
      const EdgeStep step(rays_, e, from_end ? k : k - 1);
      const auto f = [&](double at) -> std::optional<double> {
        const auto m = step.at(at);
        return m ? std::optional(excess(m->radius(), m->position())) : std::nullopt;
      };
      const auto at = from_end ? sign_change(f, 1.0, 0.0, last, here) : sign_change(f, 0.0, 1.0, last, here);
      const auto m = at ? step.at(*at) : std::nullopt;
      if (m) points_.push_back({m->left.uv, m->position(), m->radius()});
      return;
    }
    last = here;
  }
  if (!from_end && diagram_.vertices[e.to].on_boundary) add_middle(e);
}

// The edge crosses a narrow part of the face, all of it nearer to the border than the rule wants: half way across.
void FarPoints::add_middle(const DiagramEdge& e) {
  const Xyz way = e.points.back().xyz - e.points.front().xyz;
  const double half = 0.5 * way.dot(way);
  for (int k = 0; k + 1 < static_cast<int>(e.points.size()); ++k) {
    const double before = way.dot(e.points[k].xyz - e.points.front().xyz);
    const double after = way.dot(e.points[k + 1].xyz - e.points.front().xyz);
    if (!(before <= half && half < after)) continue;
    const auto m =
        EdgeStep(rays_, e, k)
            .in_plane((half - before) / (after - before), way.normalized(), e.points.front().xyz + 0.5 * way);
    if (m) points_.push_back({m->left.uv, m->position(), m->radius()});
    return;
  }
}

// Along the border the distance to the cell's site is largest at the ends of the stretch (the edges there see to
// that), at corners, and where the border turns away from the circle about the site: where its slope turns from
// positive to negative. What it is at the next places does not count: beside a corner it may fall and rise again.
void FarPoints::add_stretch(const DiagramCell& cell, const CellPiece& piece) {
  const std::vector<BorderPlace> places = stretch_places(piece);
  const std::vector<std::optional<SiteRay>> rays = stretch_rays(cell.site, piece, places);
  const size_t n = places.size();
  std::optional<size_t> rises;  // from this place on, last
  // Whether the slope is any.
  const auto take = [&](size_t i, const Xyz& tangent) {
    const double slope = rays[i] ? rays[i]->T.dot(tangent) : 0.0;
    if (rays[i] && !(std::abs(slope) > kNoSlope)) return false;
    if (slope < 0.0 && rises) add_top(places[*rises], places[i], *rays[*rises < i ? (*rises + i) / 2 : i], *rays[i]);
    rises = slope > 0.0 ? std::optional(i) : std::nullopt;
    return true;
  };
  for (size_t i = 0; i < n; ++i) {
    const auto [arrives, leaves] = border_.tangents(places[i]);
    if (i > 0) take(i, arrives);
    if (i + 1 < n) take(i, leaves);
  }
  // Once around, the way goes on where it began.
  bool told = piece.from_vertex >= 0;
  for (size_t i = 0; i + 1 < n && !told; ++i) {
    const auto [arrives, leaves] = border_.tangents(places[i]);
    told = (i > 0 && take(i, arrives)) || take(i, leaves);
  }
}

// Where the distance to the site of the ray `between` is largest. Where the rays are different geodesics of the site
// there is no such place.
void FarPoints::add_top(BorderPlace from, BorderPlace to, const SiteRay& between, const SiteRay& at_to) {
  const FaceBorder& border = border_.border();
  const auto ray_at = [&](BorderPlace place) {
    return rays_.to(between.site, border.uv(place), carry(between, border.xyz(place)));
  };
  const auto rising = [&](BorderPlace place) {
    const auto ray = ray_at(place);
    return ray ? ray->T.dot(border_.tangent(place)) : 0.0;
  };
  const auto end = ray_at(to);
  if (!end || !same_generator(*end, at_to)) return;
  const bool corner = from.parameter == to.parameter;
  const auto top = corner ? end : ray_at(border_.turning_point(from, to, rising));
  if (top) add_behind_border(*top);
}

std::vector<BorderPlace> FarPoints::stretch_places(const CellPiece& piece) const {
  const auto place_of = [&](int v) {
    return BorderPlace{piece.border_cycle, v < 0 ? 0.0 : diagram_.vertices[v].border_parameter};
  };
  std::vector<BorderPlace> places = {place_of(piece.from_vertex)};
  for (const BorderPlace& p : border_.between(places[0], place_of(piece.to_vertex))) places.push_back(p);
  places.push_back(place_of(piece.to_vertex));
  return places;
}

// Each from the one before; a site on the border has no ray to itself, and beyond it they start anew.
std::vector<std::optional<SiteRay>> FarPoints::stretch_rays(int site, const CellPiece& piece,
                                                            const std::vector<BorderPlace>& places) const {
  std::vector<std::optional<SiteRay>> rays;
  if (piece.from_vertex >= 0) {
    const DiagramVertex& v = diagram_.vertices[piece.from_vertex];
    rays.push_back(rays_.at(site, {v.radius, v.angles.front()}));
  }
  for (size_t i = rays.size(); i < places.size(); ++i) {
    const Uv uv = border_.border().uv(places[i]);
    std::optional<SiteRay> ray;
    if (i > 0 && rays[i - 1]) ray = rays_.roughly_to(site, uv, carry(*rays[i - 1], border_.border().xyz(places[i])));
    rays.push_back(ray ? ray : rays_.to(site, uv));
  }
  return rays;
}

// From a far point of the border back towards its site, until the site is half as near as the border; where the face is
// too narrow for that, to where the product of both distances is largest.
void FarPoints::add_behind_border(const SiteRay& ray) {
  const auto at = [&](double s) { return rays_.at(ray.site, {s, ray.polar.t}); };
  const auto excess = [&](double s) -> std::optional<double> {
    const auto m = at(s);
    return m ? std::optional(s - 2.0 * border_.to(m->x, s)) : std::nullopt;
  };
  const auto inner = behind_hole(ray);
  if (!inner) return;
  constexpr int kSteps = 8;
  double outer = ray.polar.s, at_outer = ray.polar.s;
  std::optional<double> place;
  double largest = 0.0;
  for (int i = 1; i < kSteps; ++i) {
    const double s = ray.polar.s - (ray.polar.s - *inner) * i / kSteps;
    const auto here = excess(s);
    if (!here) return;
    if (*here <= 0.0) {
      place = sign_change(excess, outer, s, at_outer, *here);
      break;
    }
    if (s * (s - *here) > largest * (1.0 + kSameReach)) place = s, largest = s * (s - *here);
    outer = s, at_outer = *here;
  }
  const auto m = place ? at(*place) : std::nullopt;
  if (m && is_shortest(*m)) points_.push_back({m->uv, m->x, m->polar.s});
}

// Where the face is a narrow ring around a hole, most of the way back from its outer border leads through the hole.
std::optional<double> FarPoints::behind_hole(const SiteRay& ray) const {
  const FaceDomain& domain = border_.border().domain();
  const auto inside = [&](double s) {
    const auto m = rays_.at(ray.site, {s, ray.polar.t});
    return m && domain.contains(domain.to_principal(m->uv));
  };
  double step = kLongestStep * ray.polar.s;
  while (!inside(ray.polar.s - step)) {
    step *= 0.5;
    if (step < kNarrowest * ray.polar.s) return std::nullopt;
  }
  double in = ray.polar.s - step, out = in - step;
  while (out > 0.0 && inside(out)) in = out, out -= step;
  if (!(out > 0.0)) return 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (in + out);
    (inside(middle) ? in : out) = middle;
  }
  return in;
}

// The rays along the border were carried from one sample to the next: where the site has several geodesics to a place,
// not always the shortest.
bool FarPoints::is_shortest(const SiteRay& ray) {
  if (!nearby_) nearby_.emplace(rays_);
  const std::vector<SiteRay> nearest = nearby_->nearest(ray.uv);
  return !nearest.empty() && nearest.front().polar.s >= ray.polar.s * (1.0 - kLevel);
}

// Of a closed surface that has neither vertex nor edge the geodesics from the site all meet again in one point, their
// first conjugate point: y = 0.
void FarPoints::add_opposite_point() {
  const Surface& surface = rays_.surface();
  const SurfaceJet j = surface.jet(rays_.site(0));
  const auto end_at = [&](double s) {
    return trace_geodesic(surface, rays_.site(0), direction_at_angle(j, 0.0), s).end;
  };
  const auto y_at = [&](double s) { return std::optional(end_at(s).y); };
  const Curvatures bent = curvatures(j);
  const double step = std::numbers::pi / (kOppositeSteps * bent.largest());
  double last = step;
  for (int i = 1; i < kSpheres * kOppositeSteps && std::isfinite(step); ++i) {
    const double s = step * (i + 0.5), here = *y_at(s);
    if (!(here > 0.0)) {
      const auto root = sign_change(y_at, s - step, s, last, here);
      const Uv uv = end_at(*root).p;
      add(uv, surface.position(uv), *root);
      return;
    }
    last = here;
  }
}

void FarPoints::put_in_order() {
  const auto bad = [](const FarPoint& p) { return !(p.reach > 0.0); };
  points_.erase(std::remove_if(points_.begin(), points_.end(), bad), points_.end());
  double scale = 0.0;
  for (const FarPoint& p : points_) scale = std::max(scale, p.reach);
  const std::vector<std::function<double(const FarPoint&)>> keys = {
      [](const FarPoint& p) { return p.reach; }, [](const FarPoint& p) { return p.x.x(); },
      [](const FarPoint& p) { return p.x.y(); }, [](const FarPoint& p) { return p.x.z(); }};
  sort_by(points_.begin(), points_.end(), keys, 0, scale);
}

}  // namespace geovor
