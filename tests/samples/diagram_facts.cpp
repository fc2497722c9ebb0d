#include "samples/diagram_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geodesic/distance.h"

namespace geovor::testing {

namespace {

/// The number whose digits in `base` are those of `index` behind the point in reverse (van der Corput).
double radical_inverse(int index, int base) {
  double value = 0.0, digit = 1.0;
  for (; index > 0; index /= base) {
    digit /= base;
    value += digit * (index % base);
  }
  return value;
}

/// The loop as one polygon of the parameter plane.
std::vector<Uv> polygon(const VoronoiDiagram& diagram, const std::vector<CellPiece>& loop) {
  std::vector<Uv> points;
  for (const CellPiece& piece : loop) {
    std::vector<Uv> run = piece.border_uv;
    if (piece.edge >= 0) {
      for (const EdgePoint& p : diagram.edges[piece.edge].points) run.push_back(p.uv);
      if (piece.reversed) std::reverse(run.begin(), run.end());
    }
    points.insert(points.end(), run.begin(), run.end());
  }
  return points;
}

/// How often the polygon crosses the ray from p towards greater u.
int crossings(const std::vector<Uv>& points, Uv p) {
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Uv a = points[i], b = points[(i + 1) % points.size()];
    if ((a.v > p.v) == (b.v > p.v)) continue;
    count += a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u) > p.u;
  }
  return count;
}

}  // namespace

std::vector<Uv> spread_sites(const FaceDomain& face, int count) {
  constexpr double kOffTheBorder = 0.03;  // of the face's extent in space
  const UvBox& box = face.box();
  const auto at = [&](double a, double b) { return Uv{box.u.lo + a * box.u.length(), box.v.lo + b * box.v.length()}; };
  const Surface& surface = face.surface();
  const double extent = (surface.position(at(0.1, 0.1)) - surface.position(at(0.6, 0.7))).norm();
  std::vector<Uv> sites;
  for (int i = 1; static_cast<int>(sites.size()) < count && i < 10000; ++i) {
    const Uv p = at(radical_inverse(i, 2), radical_inverse(i, 3));
    if (face.contains(p) && face.distance_to_border(p) > kOffTheBorder * extent) sites.push_back(p);
  }
  return sites;
}

const CadFace& largest_face(const CadModel& model) {
  const auto area = [&](const CadFace& face) { return face_area(model, face).value; };
  return *std::max_element(model.faces.begin(), model.faces.end(),
                           [&](const CadFace& a, const CadFace& b) { return area(a) < area(b); });
}

bool cell_holds(const VoronoiDiagram& diagram, const DiagramCell& cell, Uv p) {
  int count = 0;
  for (const auto& loop : cell.loops) count += crossings(polygon(diagram, loop), p);
  return count % 2 == 1;
}

double measured_distance(const Surface& surface, Uv from, Uv to) {
  // From both ends, because behind a tall bump a search may miss the shortest path.
  double shortest = std::numeric_limits<double>::infinity();
  for (const Connection& path : {distance(surface, from, to).shortest, distance(surface, to, from).shortest}) {
    if (path.status == ConnectStatus::Converged) shortest = std::min(shortest, path.length);
  }
  return shortest;
}

}  // namespace geovor::testing
