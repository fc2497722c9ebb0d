// From wires to loops: order of travel, closing in the parameter plane, turning direction, periods.
#include <BRepAdaptor_Surface.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

#include "occ_adapter/occ_private.h"

namespace geovor::occ {
namespace {

// Two neighbours of a wire need not meet exactly in the parameter plane; what OpenCASCADE itself writes stays below
// this part of the face's extent even for p-curves that were fitted.
constexpr double kUvSlack = 1e-6;
// However loose a vertex is, a jump of this part of the face's extent is a missing piece of border (a pole, a seam).
constexpr double kUvJump = 0.05;
// Chords a coedge for turning direction and nesting: both need the shape only roughly.
constexpr int kChords = 24;

/// What extract_trims knows of the face's parameter plane.
struct Plane2 {
  Handle(Geom_Surface) surface;
  double u_period = 0.0, v_period = 0.0;  ///< 0: not periodic
  double u_extent = 0.0, v_extent = 0.0;  ///< of the p-curves
};

using Polygon = std::vector<gp_Pnt2d>;

Polygon polygon_of(const OccLoop& loop) {
  Polygon polygon;
  for (const OccCoedge& coedge : loop.coedges) {
    const double from = coedge.reversed ? coedge.last : coedge.first;
    const double to = coedge.reversed ? coedge.first : coedge.last;
    for (int i = 0; i < kChords; ++i) polygon.push_back(coedge.pcurve->Value(from + (to - from) * i / kChords));
  }
  return polygon;
}

double signed_area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0, n = polygon.size(); i < n; ++i) {
    const gp_Pnt2d& a = polygon[i];
    const gp_Pnt2d& b = polygon[(i + 1) % n];
    twice += (a.X() - polygon[0].X()) * (b.Y() - polygon[0].Y()) - (b.X() - polygon[0].X()) * (a.Y() - polygon[0].Y());
  }
  return 0.5 * twice;
}

bool contains(const Polygon& polygon, const gp_Pnt2d& p) {
  bool inside = false;
  for (std::size_t i = 0, n = polygon.size(); i < n; ++i) {
    const gp_Pnt2d& a = polygon[i];
    const gp_Pnt2d& b = polygon[(i + 1) % n];
    if ((a.Y() > p.Y()) == (b.Y() > p.Y())) continue;
    if (p.X() < a.X() + (p.Y() - a.Y()) / (b.Y() - a.Y()) * (b.X() - a.X())) inside = !inside;
  }
  return inside;
}

/// More than half of the points: two loops may touch.
bool contains_most(const Polygon& outer, const Polygon& inner) {
  const auto inside = std::count_if(inner.begin(), inner.end(), [&](const gp_Pnt2d& p) { return contains(outer, p); });
  return 2 * static_cast<std::size_t>(inside) > inner.size();
}

// ---- coedges -------------------------------------------------------------------------------------------------------

std::optional<OccCoedge> coedge_of(const TopoDS_Edge& edge, const TopoDS_Face& forward_face) {
  OccCoedge coedge;
  coedge.edge = edge;
  coedge.reversed = edge.Orientation() == TopAbs_REVERSED;
  coedge.pcurve = BRep_Tool::CurveOnSurface(edge, forward_face, coedge.first, coedge.last);
  if (coedge.pcurve.IsNull() || !(coedge.last > coedge.first)) return std::nullopt;
  return coedge;
}

bool bounds_material(const TopoDS_Shape& part) {
  return part.Orientation() == TopAbs_FORWARD || part.Orientation() == TopAbs_REVERSED;
}

/// The wire's edges in the order of its own connections where OpenCASCADE finds one through all of them, else as
/// stored.
std::vector<TopoDS_Edge> edges_of(const TopoDS_Wire& wire, const TopoDS_Face& forward_face) {
  std::vector<TopoDS_Edge> stored, ordered;
  for (TopoDS_Iterator part(wire); part.More(); part.Next()) {
    if (part.Value().ShapeType() == TopAbs_EDGE && bounds_material(part.Value())) {
      stored.push_back(TopoDS::Edge(part.Value()));
    }
  }
  for (BRepTools_WireExplorer walk(wire, forward_face); walk.More() && ordered.size() <= stored.size(); walk.Next()) {
    ordered.push_back(walk.Current());
  }
  return ordered.size() == stored.size() ? ordered : stored;
}

// ---- joints --------------------------------------------------------------------------------------------------------

struct Joint {
  gp_Vec2d shift;     ///< whole periods to add to the second coedge
  double gap = 0.0;   ///< in space
  double jump = 0.0;  ///< in the parameter plane, relative to the face's extent
  bool fits = false;
};

double whole_periods(double distance, double period) {
  return period > 0.0 ? period * std::round(distance / period) : 0.0;
}

/// Whether a jump along one parameter is explained: by rounding, or by the tolerance where the surface is regular. At a
/// pole any jump measures nothing in space, so the part of the extent has the last word.
bool explained(double jump, double speed, double extent, double tolerance) {
  const double by_tolerance = speed > 0.0 ? tolerance / speed : std::numeric_limits<double>::infinity();
  return std::abs(jump) <= std::max(kUvSlack * extent, std::min(by_tolerance, kUvJump * extent));
}

Joint joint(const Plane2& plane, const gp_Pnt2d& end, const gp_Pnt2d& start, double tolerance) {
  Joint result;
  gp_Vec2d jump(end, start);
  result.shift = gp_Vec2d(-whole_periods(jump.X(), plane.u_period), -whole_periods(jump.Y(), plane.v_period));
  jump += result.shift;
  gp_Pnt position;
  gp_Vec su, sv;
  plane.surface->D1(end.X(), end.Y(), position, su, sv);
  result.gap = (su * jump.X() + sv * jump.Y()).Magnitude();
  result.jump = std::hypot(jump.X() / plane.u_extent, jump.Y() / plane.v_extent);
  result.fits = explained(jump.X(), su.Magnitude(), plane.u_extent, tolerance) &&
                explained(jump.Y(), sv.Magnitude(), plane.v_extent, tolerance);
  return result;
}

/// How far apart two ends may lie: the tolerance of the vertices there, and of the edges.
double tolerance_at(const OccCoedge& a, const OccCoedge& b) {
  double tolerance = BRep_Tool::Tolerance(a.edge) + BRep_Tool::Tolerance(b.edge);
  const TopoDS_Vertex end = TopExp::LastVertex(a.edge, true);
  const TopoDS_Vertex start = TopExp::FirstVertex(b.edge, true);
  if (!end.IsNull()) tolerance = std::max(tolerance, 2 * BRep_Tool::Tolerance(end));
  if (!start.IsNull()) tolerance = std::max(tolerance, 2 * BRep_Tool::Tolerance(start));
  return tolerance;
}

Joint joint(const Plane2& plane, const OccCoedge& a, const OccCoedge& b) {
  return joint(plane, a.end(), b.start(), tolerance_at(a, b));
}

void move(OccCoedge& coedge, const gp_Vec2d& shift) {
  if (shift.Magnitude() > 0.0) coedge.pcurve = Handle(Geom2d_Curve)::DownCast(coedge.pcurve->Translated(shift));
}

// ---- chains --------------------------------------------------------------------------------------------------------

/// Closes the book on a chain: the jump from its end to its start.
void finish(const Plane2& plane, OccLoop& loop) {
  const Joint last = joint(plane, loop.coedges.back(), loop.coedges.front());
  loop.gap = std::max(loop.gap, last.gap);
  loop.winds = last.shift.Magnitude() > 0.0;
  loop.closed = loop.closed && last.fits && !loop.winds;
}

/// Links coedges into loops. The next coedge is the following one where that fits (so that a good order is kept), else
/// the nearest; a chain ends when it is back at its start and nothing else begins there.
std::vector<OccLoop> chain(const Plane2& plane, std::vector<OccCoedge> rest) {
  std::vector<OccLoop> loops;
  while (!rest.empty()) {
    OccLoop loop;
    loop.coedges.push_back(rest.front());
    rest.erase(rest.begin());
    while (!rest.empty()) {
      const OccCoedge& back = loop.coedges.back();
      std::size_t best = 0;
      Joint best_joint = joint(plane, back, rest[0]);
      for (std::size_t i = 1; i < rest.size() && !best_joint.fits; ++i) {
        const Joint other = joint(plane, back, rest[i]);
        if (other.jump < best_joint.jump || other.fits) best = i, best_joint = other;
      }
      if (!best_joint.fits) {
        const Joint home = joint(plane, back, loop.coedges.front());
        if (home.fits && home.jump < best_joint.jump) break;
      }
      loop.gap = std::max(loop.gap, best_joint.gap);
      loop.closed = loop.closed && best_joint.fits;
      move(rest[best], best_joint.shift);
      loop.coedges.push_back(rest[best]);
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
    }
    finish(plane, loop);
    loops.push_back(std::move(loop));
  }
  return loops;
}

Plane2 plane_of(const TopoDS_Face& forward_face, const std::vector<std::vector<OccCoedge>>& wires) {
  Plane2 plane;
  plane.surface = unwrapped(BRep_Tool::Surface(forward_face));
  if (plane.surface->IsUPeriodic()) plane.u_period = plane.surface->UPeriod();
  if (plane.surface->IsVPeriodic()) plane.v_period = plane.surface->VPeriod();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  double u0 = kInf, u1 = -kInf, v0 = kInf, v1 = -kInf;
  for (const auto& wire : wires) {
    for (const OccCoedge& coedge : wire) {
      for (int i = 0; i <= kChords; ++i) {
        const gp_Pnt2d p = coedge.pcurve->Value(coedge.first + (coedge.last - coedge.first) * i / kChords);
        u0 = std::min(u0, p.X()), u1 = std::max(u1, p.X());
        v0 = std::min(v0, p.Y()), v1 = std::max(v1, p.Y());
      }
    }
  }
  plane.u_extent = u1 > u0 ? u1 - u0 : 1.0;
  plane.v_extent = v1 > v0 ? v1 - v0 : 1.0;
  return plane;
}

// ---- turning and nesting -------------------------------------------------------------------------------------------

void turn(OccLoop& loop) {
  std::reverse(loop.coedges.begin(), loop.coedges.end());
  for (OccCoedge& coedge : loop.coedges) coedge.reversed = !coedge.reversed, coedge.edge.Reverse();
}

/// Moves `inner` by whole periods so that it lies inside `outer`, if any copy does.
bool bring_inside(const Plane2& plane, const Polygon& outer, OccLoop& inner, Polygon& inner_polygon) {
  for (const int i : {0, -1, 1}) {
    for (const int j : {0, -1, 1}) {
      if ((i != 0 && plane.u_period <= 0.0) || (j != 0 && plane.v_period <= 0.0)) continue;
      const gp_Vec2d shift(i * plane.u_period, j * plane.v_period);
      Polygon moved = inner_polygon;
      for (gp_Pnt2d& p : moved) p.Translate(shift);
      if (!contains_most(outer, moved)) continue;
      for (OccCoedge& coedge : inner.coedges) move(coedge, shift);
      inner_polygon = std::move(moved);
      return true;
    }
  }
  return false;
}

/// A loop inside an odd number of others is a hole and runs clockwise, the rest counter-clockwise.
bool orient(const Plane2& plane, std::vector<OccLoop>& loops) {
  std::vector<Polygon> polygons;
  for (const OccLoop& loop : loops) polygons.push_back(polygon_of(loop));
  bool turned = false;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const double area = signed_area(polygons[i]);
    int depth = 0;
    for (std::size_t j = 0; j < loops.size(); ++j) {
      if (j == i || std::abs(signed_area(polygons[j])) <= std::abs(area)) continue;
      if (bring_inside(plane, polygons[j], loops[i], polygons[i])) ++depth;
    }
    const bool clockwise = area < 0.0;
    if (clockwise == (depth % 2 == 1) || area == 0.0) continue;
    turn(loops[i]);
    std::reverse(polygons[i].begin(), polygons[i].end());
    turned = true;
  }
  return turned;
}

}  // namespace

bool OccTrims::sound() const {
  return !loops.empty() && missing_pcurves == 0 &&
         std::all_of(loops.begin(), loops.end(), [](const OccLoop& loop) { return loop.closed; });
}

OccTrims extract_trims(const TopoDS_Face& face) {
  OccTrims trims;
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  std::vector<std::vector<OccCoedge>> wires;
  for (TopoDS_Iterator part(forward); part.More(); part.Next()) {
    if (part.Value().ShapeType() != TopAbs_WIRE || !bounds_material(part.Value())) continue;
    wires.emplace_back();
    for (const TopoDS_Edge& edge : edges_of(TopoDS::Wire(part.Value()), forward)) {
      if (const auto coedge = coedge_of(edge, forward)) {
        wires.back().push_back(*coedge);
      } else {
        ++trims.missing_pcurves;
      }
    }
  }
  const Plane2 plane = plane_of(forward, wires);
  for (auto& wire : wires) {
    for (OccLoop& loop : chain(plane, std::move(wire))) trims.loops.push_back(std::move(loop));
  }
  if (trims.sound()) trims.turned = orient(plane, trims.loops);
  return trims;
}

}  // namespace geovor::occ
