#include "cell_labels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "test_faces.h"

namespace geovor::testing {
namespace {

constexpr double kNextToPolyline = 8.0;  // of its tolerance

/// A point of an edge as its site sees it.
struct ChartPoint {
  double t, s;
  int point;  ///< index into the edge's points
};

/// An edge in the polar chart of one of its sites, counter-clockwise, t running on.
struct ChartEdge {
  int edge;
  bool reversed;
  std::vector<ChartPoint> points;
};

double around(double t) {
  const double r = std::fmod(t, 2.0 * kPi);
  return r < 0.0 ? r + 2.0 * kPi : r;
}

ChartEdge chart_edge(const VoronoiDiagram& d, const CellPiece& piece) {
  ChartEdge out{piece.edge, piece.reversed, {}};
  const auto& points = d.edges[piece.edge].points;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i) {
    const int k = piece.reversed ? n - 1 - i : i;
    const double t = piece.reversed ? points[k].right_angle : points[k].left_angle;
    const double on = out.points.empty() ? t : out.points.back().t + std::remainder(t - out.points.back().t, 2.0 * kPi);
    out.points.push_back({on, points[k].radius, k});
  }
  return out;
}

/// A corner of a loop in the polar chart. Chords of the face's border do not tell what lies as near to them as they are
/// long.
struct Corner {
  double x, y;
  bool border_follows;
};
using Loop = std::vector<Corner>;

double distance_to_segment(const Corner& a, const Corner& b, double x, double y) {
  const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  const double k = length2 > 0.0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x - a.x - k * dx, y - a.y - k * dy);
}

/// By how many turns the loop goes around the place.
int winding(const Loop& loop, double x, double y) {
  int turns = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Corner &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const double side = (b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y);
    if (a.y <= y && b.y > y && side > 0.0) ++turns;
    if (a.y > y && b.y <= y && side < 0.0) --turns;
  }
  return turns;
}

class Charts {
 public:
  Charts(const Surface& surface, const VoronoiDiagram& d, const DistanceRule& rule)
      : surface_(surface), d_(d), cells_(d.cells.size()), loops_(d.cells.size()), known_(d.cells.size(), true) {
    for (const DiagramCell& cell : d.cells) {
      for (const auto& loop : cell.loops) {
        for (const CellPiece& piece : loop)
          if (piece.edge >= 0) cells_[cell.site].push_back(chart_edge(d, piece));
        loops_[cell.site].push_back(chart_loop(cell.site, loop, rule));
      }
    }
  }

  /// How often the loops of the cell together go around the end of the ray: once if the cell holds it. Nothing next to
  /// them.
  std::optional<int> turns_around(int site, const Connection& ray) const {
    if (!known_[site]) return std::nullopt;
    const double x = ray.length * std::cos(ray.angle), y = ray.length * std::sin(ray.angle);
    const double stretch = std::max(1.0, ray.length / std::abs(ray.y));
    int turns = loops_[site].empty() && d_.sites.size() == 1 ? 1 : 0;
    for (const Loop& loop : loops_[site]) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Corner &a = loop[i], &b = loop[(i + 1) % loop.size()];
        const double near = a.border_follows ? std::hypot(b.x - a.x, b.y - a.y) : 0.0;
        if (!(distance_to_segment(a, b, x, y) > near + kNextToPolyline * d_.tolerance * stretch)) return std::nullopt;
      }
      turns += winding(loop, x, y);
    }
    return turns;
  }

  /// Whether the cell of the site holds the end m of the geodesic from there. Directions without an edge end in the
  /// border of the face.
  bool holds(int site, const Connection& ray, Uv m) const {
    for (const ChartEdge& e : cells_[site]) {
      const double t = e.points.front().t + around(ray.angle - e.points.front().t);
      if (t > e.points.back().t) continue;
      const auto next = std::upper_bound(e.points.begin() + 1, e.points.end() - 1, t,
                                         [](double value, const ChartPoint& p) { return value < p.t; });
      if (!within(e, *(next - 1), *next, ray, t, m)) return false;
    }
    return true;
  }

 private:
  bool within(const ChartEdge& e, const ChartPoint& a, const ChartPoint& b, const Connection& ray, double t,
              Uv m) const {
    const double ax = a.s * std::cos(a.t), ay = a.s * std::sin(a.t), bx = b.s * std::cos(b.t), by = b.s * std::sin(b.t);
    const double x = ray.length * std::cos(t), y = ray.length * std::sin(t);
    const double inside = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / std::hypot(bx - ax, by - ay);
    const double stretch = std::max(1.0, ray.length / std::abs(ray.y));
    if (std::abs(inside) > kNextToPolyline * d_.tolerance * stretch) return inside > 0.0;
    // The other site's ray, next to the one by which the edge knows it.
    const EdgePoint& p = d_.edges[e.edge].points[std::abs(t - a.t) < std::abs(t - b.t) ? a.point : b.point];
    const int other = e.reversed ? d_.edges[e.edge].left : d_.edges[e.edge].right;
    const Polar guess = {p.radius, e.reversed ? p.left_angle : p.right_angle};
    const Connection across = connect(surface_, d_.sites[other].uv, m, guess);
    return across.status != ConnectStatus::Converged || ray.length < across.length + kOnEdge;
  }

  Loop chart_loop(int site, const std::vector<CellPiece>& loop, const DistanceRule& rule) {
    Loop out;
    for (const CellPiece& piece : loop) {
      if (piece.edge >= 0) {
        for (const ChartPoint& p : chart_edge(d_, piece).points)
          out.push_back({p.s * std::cos(p.t), p.s * std::sin(p.t), false});
        out.back().border_follows = true;  // if it does not, the next corner is the same place
        continue;
      }
      // The ends are those of the edges beside it; a whole cycle has its first place twice.
      const std::size_t first = piece.from_vertex >= 0 ? 1 : 0;
      for (std::size_t i = first; i + 1 < piece.border_uv.size(); ++i) {
        const bool own = (piece.border_xyz[i] - d_.sites[site].xyz).norm() < kOnEdge;
        const Connection c = own ? Connection{} : rule(d_.sites[site].uv, piece.border_uv[i]);
        if (!own && c.status != ConnectStatus::Converged) known_[site] = false;
        const double s = own ? 0.0 : c.length;
        out.push_back({s * std::cos(c.angle), s * std::sin(c.angle), true});
      }
    }
    return out;
  }

  const Surface& surface_;
  const VoronoiDiagram& d_;
  std::vector<std::vector<ChartEdge>> cells_;
  std::vector<std::vector<Loop>> loops_;
  std::vector<char> known_;  ///< whether all places of the border have their distances
};

struct Nearest {
  int site = -1;
  Connection ray;
  double second = 1e300;
  bool known = true;
};

Nearest nearest_site(const Surface& surface, const VoronoiDiagram& d, const DistanceRule& rule, Uv m) {
  const Xyz x = surface.position(m);
  std::vector<std::pair<double, int>> order;
  for (int i = 0; i < static_cast<int>(d.sites.size()); ++i) order.push_back({(d.sites[i].xyz - x).norm(), i});
  std::sort(order.begin(), order.end());
  Nearest found;
  for (const auto& [chord, i] : order) {
    if (found.site >= 0 && chord > found.ray.length + kOnEdge * std::max(1.0, chord)) break;
    const Connection c = rule(d.sites[i].uv, m);
    if (c.status != ConnectStatus::Converged) {
      found.known = false;
    } else if (found.site < 0 || c.length < found.ray.length) {
      if (found.site >= 0) found.second = found.ray.length;
      found.site = i, found.ray = c;
    } else {
      found.second = std::min(found.second, c.length);
    }
  }
  return found;
}

std::string words(const Nearest& found, Uv m) {
  std::ostringstream text;
  text.precision(17);
  text << "(" << m.u << ", " << m.v << ") nearest to site " << found.site << " at " << found.ray.length << ", next "
       << found.second;
  return text.str();
}

}  // namespace

DistanceRule shortest_by(const DistanceFinder& finder) {
  return [&finder](Uv site, Uv place) { return finder.distance(site, place).shortest; };
}

LabelCheck compare_with_brute_force(const FaceDomain& domain, const VoronoiDiagram& diagram, const DistanceRule& rule,
                                    int count, unsigned seed) {
  const Charts charts(domain.surface(), diagram, rule);
  Uniform random(seed);
  LabelCheck check;
  for (int tries = 0; check.looked_at < count && tries < 20 * count; ++tries) {
    const Uv m = random.in(domain.box());
    const bool in_face = domain.contains(m);
    ++(in_face ? check.looked_at : check.looked_at_outside);
    const Nearest found = nearest_site(domain.surface(), diagram, rule, m);
    const double slack = kOnEdge * std::max(1.0, found.ray.length);
    if (!found.known || found.site < 0 || !(found.ray.length > slack) || found.second - found.ray.length < slack) {
      if (in_face) ++check.undecided;
      continue;
    }
    const auto turns = charts.turns_around(found.site, found.ray);
    if (turns) ++check.gone_around;
    const bool held = in_face && charts.holds(found.site, found.ray, m);
    if (in_face ? !held || turns.value_or(1) != 1 : turns.value_or(0) != 0) {
      if (check.wrong++ == 0) check.first_wrong = (in_face ? "" : "outside the face: ") + words(found, m);
    }
  }
  return check;
}

}  // namespace geovor::testing
