#include "diagram_laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "brep/face_area.h"
#include "geodesic/distance.h"
#include "numeric/worst_of.h"
#include "voronoi/cell_charts.h"
#include "voronoi/certificate.h"

namespace geovor::testing {
namespace {

std::string at(const char* what, size_t i) { return std::string(what) + ' ' + std::to_string(i); }

/// Lengths of the geodesics from all sites to m, shortest first, as (length, angle, site).
struct Reach {
  double length, angle;
  int site;
};
std::vector<Reach> reaches(const Surface& surface, const VoronoiDiagram& d, Uv m) {
  std::vector<Reach> out;
  for (size_t i = 0; i < d.sites.size(); ++i) {
    const Connection c = connect(surface, d.sites[i].uv, m);
    if (c.status == ConnectStatus::Converged) out.push_back({c.length, c.angle, static_cast<int>(i)});
  }
  std::sort(out.begin(), out.end(), [](const Reach& a, const Reach& b) { return a.length < b.length; });
  return out;
}

using Polygon = std::vector<std::pair<double, double>>;

bool crosses(const Polygon& polygon, double x, double y) {
  bool odd = false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const auto [ax, ay] = polygon[i];
    const auto [bx, by] = polygon[(i + 1) % polygon.size()];
    if ((ay > y) != (by > y) && x < ax + (bx - ax) * (y - ay) / (by - ay)) odd = !odd;
  }
  return odd;
}

template <class Point>
Polygon outline(const VoronoiDiagram& d, const std::vector<CellPiece>& loop, const Point& point) {
  Polygon polygon;
  for (const CellPiece& piece : loop) {
    for (Uv p : piece.border_uv) polygon.push_back({p.u, p.v});
    if (piece.edge < 0) continue;
    std::vector<EdgePoint> points = d.edges[piece.edge].points;
    if (piece.reversed) std::reverse(points.begin(), points.end());
    for (const EdgePoint& p : points) polygon.push_back(point(p, piece.reversed));
  }
  return polygon;
}

}  // namespace

std::string broken_topology(const VoronoiDiagram& d) {
  for (size_t i = 0; i < d.vertices.size(); ++i) {
    const DiagramVertex& v = d.vertices[i];
    const size_t wanted = v.on_boundary ? v.sites.size() - 1 : v.sites.size();
    if (v.spokes.size() != wanted) return at("vertex with a wrong number of spokes:", i);
    for (size_t k = 0; k < v.spokes.size(); ++k) {
      const Spoke s = v.spokes[k];
      if (s.edge < 0) return at("open spoke at vertex", i);
      const DiagramEdge& e = d.edges[s.edge];
      if ((s.at_end ? e.to : e.from) != static_cast<int>(i)) return at("edge does not end at its vertex:", s.edge);
      const int right = v.sites[k], left = v.sites[(k + 1) % v.sites.size()];
      if ((s.at_end ? e.left : e.right) != right || (s.at_end ? e.right : e.left) != left) {
        return at("edge with other sites than at its vertex:", s.edge);
      }
      if ((v.xyz - (s.at_end ? e.points.back() : e.points.front()).xyz).norm() > 1e-7) return at("gap at edge", s.edge);
    }
  }
  std::map<std::pair<int, bool>, int> walked;
  for (const DiagramCell& cell : d.cells) {
    for (const auto& loop : cell.loops) {
      for (const CellPiece& piece : loop) {
        if (piece.edge < 0) continue;
        ++walked[{piece.edge, piece.reversed}];
        const DiagramEdge& e = d.edges[piece.edge];
        if ((piece.reversed ? e.right : e.left) != cell.site)
          return at("edge in the loop of another cell:", piece.edge);
      }
    }
  }
  if (walked.size() != 2 * d.edges.size()) return "an edge is not walked in both directions";
  for (const auto& [dart, times] : walked) {
    if (times != 1) return at("edge walked more than once:", dart.first);
  }
  return "";
}

std::string unproved(const TestFace& face, const VoronoiDiagram& d) {
  const Certificate c = certify(face.domain(), d, face_area(face.model, face.model.faces[0]));
  return c.holds() ? "" : c.result;
}

int euler_number(const FaceDomain& domain, const VoronoiDiagram& d) {
  int count = static_cast<int>(d.vertices.size());
  for (const DiagramEdge& e : d.edges) count -= e.closed() ? 0 : 1;
  // A cell with one loop is a disk; of several, the charts tell which go around holes.
  const bool disks = d.sites.size() > 1 &&
                     std::all_of(d.cells.begin(), d.cells.end(), [](const auto& c) { return c.loops.size() == 1; });
  const DiagramCharts charts = disks ? DiagramCharts{} : chart_cells(domain, d);
  const bool antipode =
      std::any_of(d.vertices.begin(), d.vertices.end(), [](const auto& v) { return v.spokes.empty(); });
  for (const DiagramCell& cell : d.cells) {
    if (cell.loops.empty() && !antipode) count += 2;  // a closed surface
    if (d.sites.size() == 1 && antipode) ++count;     // the same without a point
    if (disks) ++count;
    if (!disks) {
      for (const double area : charts.cells[cell.site].loop_areas) count += area > 0.0 ? 1 : -1;
    }
    for (const auto& loop : cell.loops) {
      for (const CellPiece& piece : loop) count -= piece.edge < 0 && piece.from_vertex >= 0 ? 1 : 0;
    }
  }
  return count;
}

double worst_mismatch(const Surface& surface, const VoronoiDiagram& d) {
  double worst = 0.0;
  const auto check = [&](Uv m, int site, double radius, double angle) {
    Connection c = connect(surface, d.sites[site].uv, m);
    if (c.status != ConnectStatus::Converged || std::abs(c.length - radius) > 1e-3 * radius) {
      c = connect(surface, d.sites[site].uv, m, Polar{radius, angle});  // another geodesic of the same site
    }
    const bool found = c.status == ConnectStatus::Converged && std::isfinite(c.length);
    worst = larger_of(worst, found ? std::abs(c.length - radius) / radius : std::numeric_limits<double>::infinity());
  };
  // The free end of a cut locus is conjugate to its site: there is no Newton's method for a geodesic to it.
  for (const DiagramVertex& v : d.vertices) {
    for (size_t i = 0; i < v.sites.size() && v.sites.size() > 1; ++i) check(v.uv, v.sites[i], v.radius, v.angles[i]);
  }
  for (const DiagramEdge& e : d.edges) {
    for (const EdgePoint& p : e.points) {
      if (e.left == e.right && p.left_angle == p.right_angle) continue;
      check(p.uv, e.left, p.radius, p.left_angle);
      check(p.uv, e.right, p.radius, p.right_angle);
    }
  }
  return worst;
}

int wrong_labels(const FaceDomain& domain, const VoronoiDiagram& d, int count, unsigned seed) {
  Uniform random(seed);
  int wrong = 0;
  for (int i = 0; i < count; ++i) {
    const Uv m = random.in(domain.box());
    const auto near = reaches(domain.surface(), d, m);
    if (!domain.contains(m) || (near.size() > 1 && near[1].length - near[0].length < 4.0 * d.tolerance)) continue;
    bool odd = false;
    for (const auto& loop : d.cells[near[0].site].loops) {
      odd ^= crosses(outline(d, loop, [](const EdgePoint& p, bool) { return std::pair(p.uv.u, p.uv.v); }), m.u, m.v);
    }
    wrong += odd ? 0 : 1;
  }
  return wrong;
}

int wrong_labels_in_polar_charts(const FaceDomain& domain, const VoronoiDiagram& d, int count, unsigned seed) {
  Uniform random(seed);
  int wrong = 0;
  for (int i = 0; i < count; ++i) {
    const Uv m = random.in(domain.box());
    const auto near = reaches(domain.surface(), d, m);
    if (near.size() > 1 && near[1].length - near[0].length < 4.0 * d.tolerance) continue;
    const auto chart = [](const EdgePoint& p, bool reversed) {
      const double t = reversed ? p.right_angle : p.left_angle;
      return std::pair(p.radius * std::cos(t), p.radius * std::sin(t));
    };
    for (const Reach& r : near) {
      bool odd = false;
      for (const auto& loop : d.cells[r.site].loops) {
        odd ^= crosses(outline(d, loop, chart), r.length * std::cos(r.angle), r.length * std::sin(r.angle));
      }
      if (odd != (r.site == near[0].site)) {
        ++wrong;
        break;
      }
    }
  }
  return wrong;
}

}  // namespace geovor::testing
