#include "pipeline/surface_path.h"

#include <algorithm>
#include <cmath>

#include "surface/forms.h"

namespace geovor {
namespace {

// Pieces that a path is cut into before it is looked at: no bump of a tenth of its length is stepped over.
constexpr int kFirstPieces = 16;

// Places that are kept of a path, so that any other is one or two steps of the integrator away.
constexpr int kMilestones = 64;

// Halvings of a first piece, at most: it ends at a place where the path has no tangent.
constexpr int kMostHalvings = 16;

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

SurfacePath::SurfacePath(const Surface& surface, Uv from, const Connection& connection)
    : surface_(surface), length_(connection.length), breaks_{0.0, connection.length} {
  TraceOptions options;
  options.stop_at_domain = false;
  milestones_ = sample_geodesic(surface, from, connection.start_direction, length_, kMilestones, options);
}

PathPoint SurfacePath::at(double s) const {
  const int last = static_cast<int>(milestones_.size()) - 1;
  const int k = length_ > 0.0 ? std::min(static_cast<int>(kMilestones * (s / length_)), last) : 0;
  TraceOptions options;
  options.stop_at_domain = false;
  const double rest = std::max(0.0, s - length_ * k / kMilestones);
  const GeodesicState end = trace_geodesic(surface_, milestones_[k].p, milestones_[k].d, rest, options).end;
  const SurfaceJet j = surface_.jet(end.p);
  return {s, end.p, j.S, push_forward(j, end.d).normalized()};
}

Xyz SurfacePath::tangent_before(int i) const { return at(breaks_[i]).tangent; }

std::vector<PathPiece> SurfacePath::pieces() const {
  std::vector<PathPiece> all;
  for (int i = 0; i + 1 < static_cast<int>(breaks_.size()); ++i) {
    const double length = breaks_[i + 1] - breaks_[i];
    const int count = std::max(1, static_cast<int>(std::ceil(kFirstPieces * length / length_)));
    for (int k = 0; k < count; ++k)
      all.push_back({breaks_[i] + length * k / count, breaks_[i] + length * (k + 1) / count});
    all.back().to = breaks_[i + 1];
    all.back().ends_at = i + 1;
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
