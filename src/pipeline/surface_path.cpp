#include "pipeline/surface_path.h"

#include <algorithm>
#include <cmath>

#include "geodesic/closed_forms.h"
#include "surface/tangent_frame.h"

namespace geovor {
namespace {

// Pieces that a path is cut into before it is looked at.
constexpr int kFirstPieces = 16;

// Halvings of a first piece, at most: it ends at a place where the path has no tangent. 2^-16 of a sixteenth is a
// millionth of the path.
constexpr int kMostHalvings = 16;

PathOptions beyond_the_domain() {
  PathOptions options;
  options.trace.stop_at_domain = false;
  // Where neighbouring geodesics spread, errors grow on the way: the path is to end where it was sent.
  options.trace.tolerance = kAllDigits;
  return options;
}

bool is_break(PathEventKind kind) {
  return kind == PathEventKind::KnotLine || kind == PathEventKind::Crease || kind == PathEventKind::Seam;
}

void refine(const SurfacePath& path, const CloseEnough& close, const PathPoint& a, const PathPoint& b, int halvings,
            std::vector<PathPoint>& out) {
  const PathPoint middle = path.at(0.5 * (a.s + b.s));
  if (halvings > 0 && !close(a, middle, b)) {
    refine(path, close, a, middle, halvings - 1, out);
    refine(path, close, middle, b, halvings - 1, out);
    return;
  }
  out.push_back(b);
}

}  // namespace

// The angle is a direction at a pole too, where (u', v') is none.
SurfacePath::SurfacePath(const Surface& surface, Uv from, const Connection& connection)
    : path_(has_closed_form(surface)
                ? GeodesicPath(surface, from, connection.start_direction, connection.length, beyond_the_domain())
                : GeodesicPath(surface, from, tangent_frame(surface, from).at_angle(connection.angle),
                               connection.length, beyond_the_domain())) {}

PathPoint SurfacePath::at(double s) const {
  const SpaceState state = path_.at(s);
  return {s, state.p, state.S, state.tangent};
}

PathPoint SurfacePath::before(double s) const {
  PathPoint p = at(s);
  p.tangent = path_.at(std::nextafter(s, 0.0)).tangent;
  return p;
}

std::vector<PathPiece> SurfacePath::pieces() const {
  // Breaks nearer to each other than this part of the path are one: two knot lines that cross under it.
  constexpr double kSame = 1e-12;
  std::vector<double> breaks{0.0};
  const double apart = kSame * length();
  for (const PathEvent& event : path_.events()) {
    if (is_break(event.kind) && event.s > breaks.back() + apart && event.s < length() - apart)
      breaks.push_back(event.s);
  }
  breaks.push_back(length());
  std::vector<PathPiece> all;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double stretch = breaks[i + 1] - breaks[i];
    const int count = std::max(1, static_cast<int>(std::ceil(kFirstPieces * stretch / length())));
    for (int k = 0; k < count; ++k) {
      all.push_back({breaks[i] + stretch * k / count, breaks[i] + stretch * (k + 1) / count, false});
    }
    all.back().to = breaks[i + 1];
    all.back().ends_at_break = true;
  }
  return all;
}

std::vector<PathPoint> sample_path(const SurfacePath& path, const CloseEnough& close) {
  std::vector<PathPoint> points{path.at(0.0)};
  if (!(path.length() > 0.0)) return points;
  for (const PathPiece& piece : path.pieces()) {
    const PathPoint from = points.back();
    refine(path, close, from, path.at(piece.to), kMostHalvings, points);
  }
  return points;
}

}  // namespace geovor
