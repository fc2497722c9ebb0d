#include "pipeline/distance_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "pipeline/cell_outlines.h"
#include "pipeline/path_spline.h"

namespace geovor {
namespace {

// Of the tolerance of the border: how far its polyline may lie from it, and the path's from the path. Together with the
// border's own error they stay below the tolerance that decides whether a path has left.
constexpr double kPolylineShare = 0.25;

// Of the face's tolerance: a curve so near to its surface lies on it for every CAD program, also where it is measured
// beside others.
constexpr double kOfTolerance = 1e-2;
// Of the path's length: the curve's own length then equals the distance to 1e-9 for paths that turn by a few hundred
// radians.
constexpr double kOfLength = 1e-11;
// Of the coordinates, the rounding of a surface's evaluation: below it nothing is measured.
constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();

// Patches of a picture: some 4 units high on a usual page; its border lies within this part of the model's size.
constexpr int kRasterRows = 160;
constexpr int kRasterColumns = 48;
constexpr double kPictureDeflection = 1e-4;

const CadFace& usable(const CadFace& face) {
  if (face.surface) return face;
  throw Error(ErrorCode::FaceRejected,
              (face.problems.empty() ? "the face has no surface" : face.problems.front()) + "; repair the face");
}

/// How far the straight line between two points' parameters runs, half way, from the path.
double sag_in_parameters(const Surface& surface, const PathPoint& a, const PathPoint& middle, const PathPoint& b) {
  return (surface.position(lerp(a.uv, b.uv, 0.5)) - middle.xyz).norm();
}

double sag_in_space(const PathPoint& a, const PathPoint& middle, const PathPoint& b) {
  return (0.5 * (a.xyz + b.xyz) - middle.xyz).norm();
}

double rounding_at(const Xyz& x) { return kRounding * x.cwiseAbs().maxCoeff(); }

DistanceOptions all_digits() {
  DistanceOptions options;
  options.connect.tolerance = kAllDigits;
  return options;
}

void warn(FaceDistance& d) {
  if (d.leaves_face()) {
    d.warnings.push_back(
        {"path_leaves_face",
         std::string("the shortest path leaves the face: the length is that of the surface without its trims, ") +
             "and the distance in the face is larger"});
  }
  if (d.paths.size() < d.result.shortest_paths.size()) {
    d.warnings.push_back(
        {"path_not_followed",
         "a shortest path could not be followed from its start to its end; its length alone is known"});
  }
  if (d.result.family) {
    d.warnings.push_back({"many_paths", "every direction gives a shortest path; one of them is given"});
  }
}

}  // namespace

bool FaceDistance::leaves_face() const {
  return !paths.empty() &&
         std::all_of(paths.begin(), paths.end(), [](const FacePath& p) { return p.exit.has_value(); });
}

FaceDistances::FaceDistances(const CadModel& model, const CadFace& face)
    : model_(model),
      face_(usable(face)),
      tolerance_(face_tolerance(face)),
      domain_(model, face, kPolylineShare * tolerance_),
      printed_tolerance_(printed_tolerance(domain_, face)),
      finder_(face.surface, all_digits()) {}

FacePlace FaceDistances::place(const FacePoint& point, bool snap) const {
  return place_on_face(domain_, point, printed_tolerance_, snap);
}

/// How far a place lies outside the border; it was accepted as a place on it.
double FaceDistances::outside(const FacePlace& place) const {
  return domain_.contains(place.uv) ? 0.0 : domain_.distance_to_border(place.uv);
}

std::optional<FaceExit> FaceDistances::find_exit(const SurfacePath& path, const FacePlace& from,
                                                 const FacePlace& to) const {
  const std::vector<PathPoint> points = sample_path(path, [&](const auto& a, const auto& middle, const auto& b) {
    return sag_in_parameters(surface(), a, middle, b) <= std::max(kPolylineShare * tolerance_, rounding_at(middle.xyz));
  });
  std::vector<Uv> line;
  for (const PathPoint& p : points) line.push_back(p.uv);
  const auto exit = domain_.first_exit(line, std::max({tolerance_, outside(from), outside(to)}));
  if (!exit) return std::nullopt;
  const auto point = [&](const FaceDomain::PathPlace& place) {
    const int next = std::min(place.segment + 1, static_cast<int>(points.size()) - 1);
    PathPoint p = path.at(points[place.segment].s + place.k * (points[next].s - points[place.segment].s));
    p.uv = domain_.to_principal(p.uv);
    return p;
  };
  FaceExit found{point(exit->out), std::nullopt};
  if (exit->back) found.back = point(*exit->back);
  return found;
}

// The parameters of `from` from which the connection's geodesic arrives. At a tip, where (u, v) of many u is one point,
// it leaves along its own parameter line, that of `to`.
std::optional<Uv> FaceDistances::start_of(const FacePlace& from, const FacePlace& to, const Connection& c) const {
  constexpr double kArrives = 1e-9;  // of the length
  const auto near = [&](const Xyz& a, const Xyz& b, double more) {
    return (a - b).norm() <= more + 2.0 * std::max(rounding_at(a), rounding_at(b));
  };
  for (const Uv start : {from.uv, Uv{to.uv.u, from.uv.v}, Uv{from.uv.u, to.uv.v}}) {
    if (!near(surface().position(start), surface().position(from.uv), 0.0)) continue;
    const SurfacePath path(surface(), start, c);
    if (near(path.at(path.length()).xyz, surface().position(to.uv), kArrives * c.length)) return start;
  }
  return std::nullopt;
}

FacePath FaceDistances::follow(Uv start, const FacePlace& from, const FacePlace& to, const Connection& c) const {
  const SurfacePath path(surface(), start, c);
  FacePath found;
  found.connection = c;
  found.start = start;
  const double deviation = std::max(kPolylineDeviation * path.length(), rounding_at(from.xyz));
  found.points = sample_path(path, [&](const auto& a, const auto& middle, const auto& b) {
    return sag_in_space(a, middle, b) <= deviation && sag_in_parameters(surface(), a, middle, b) <= deviation;
  });
  found.connection.residual = (found.points.back().xyz - surface().position(to.uv)).norm();
  found.end_tangent = path.before(path.length()).tangent;
  found.exit = find_exit(path, from, to);
  return found;
}

FaceDistance FaceDistances::between(const FacePlace& from, const FacePlace& to) const {
  FaceDistance d;
  d.from = from;
  d.to = to;
  d.result = finder_.distance(from.uv, to.uv);
  if (d.result.status != ConnectStatus::Converged) return d;
  for (const Connection& c : d.result.shortest_paths) {
    if (const auto start = start_of(from, to, c)) d.paths.push_back(follow(*start, from, to, c));
  }
  if (d.leaves_face()) {
    for (const Connection& c : d.result.candidates) {
      const auto start = start_of(from, to, c);
      if (!start || find_exit(SurfacePath(surface(), *start, c), from, to)) continue;
      d.stays_on_face = c.length;
      break;
    }
  }
  warn(d);
  return d;
}

double FaceDistances::spline_deviation(const FacePath& path) const {
  double rounding = 0.0;
  for (const PathPoint& p : path.points) rounding = std::max(rounding, rounding_at(p.xyz));
  return std::max(rounding, std::min(kOfTolerance * tolerance_, kOfLength * path.connection.length));
}

CadCurve FaceDistances::spline(const FacePath& path, const std::string& name) const {
  CadCurve curve = spline_of_path(SurfacePath(surface(), path.start, path.connection), spline_deviation(path));
  curve.name = name;
  return curve;
}

CellRaster FaceDistances::patches() const {
  const double deflection = std::max(kPictureDeflection * model_.diagonal(), tolerance_);
  CellRaster raster =
      raster_of_cells(FaceDomain(model_, face_, deflection), VoronoiDiagram{}, kRasterRows, kRasterColumns);
  raster.outlines = {outline_of_face(model_, face_, deflection)};
  return raster;
}

}  // namespace geovor
