#include "voronoi/certificate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

#include "voronoi/border_cover.h"
#include "voronoi/cell_charts.h"
#include "voronoi/claim.h"
#include "voronoi/diagram_topology.h"
#include "voronoi/path_checks.h"
#include "voronoi/seam_check.h"
#include "voronoi/site_ray.h"
#include "voronoi/stored_places.h"

namespace geovor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// The stored place of a point and the ends of its rays, relative to the radius: what their angles leave open.
constexpr double kSamePlace = 1e-9;

// The ends predicted for the middle of two stored points lie this near to each other, relative to the radius. Two
// branches would be apart by their own width.
constexpr double kNoJump = 1e-3;

// Angles of the walk around a cell are sums of differences, each good to what kSamePlace says.
constexpr double kOneTurn = 1e-6;

// Steps clockwise, and jumps where one piece of a cell's border follows another, in space, relative to the radius. The
// ends of cut loci are known to the square root of a length's rounding.
constexpr double kNoStepBack = 1e-9;
constexpr double kCornersMeet = 1e-7;

// The Jacobi field along cells' borders, relative to the radius: more than rounding.
constexpr double kPositive = 1e-9;

using Offender = CertificateClaim::Offender;

class Examiner {
 public:
  Examiner(const FaceDomain& domain, const VoronoiDiagram& diagram, const Area& face_area)
      : domain_(domain), border_(domain), d_(diagram), face_area_(face_area) {}

  Certificate examine();

 private:
  CertificateClaim topology() const;
  CertificateClaim border() const;
  CertificateClaim radial_lengths() const;
  CertificateClaim places() const;
  CertificateClaim corners() const;
  CertificateClaim smoothness() const;
  CertificateClaim sectors() const;
  CertificateClaim stars() const;
  CertificateClaim turns() const;
  CertificateClaim regularity() const;
  CertificateClaim areas() const;
  CertificateClaim warnings() const;
  void find_hidden();
  bool measured() const;
  void trace_vertices();
  double missing_turn(int cell) const;
  double off_antipode(int cell) const;
  std::string summary(const Certificate& certificate) const;
  Uv site(int cell) const { return d_.sites[cell].uv; }

  const FaceDomain& domain_;
  FaceBorder border_;
  const VoronoiDiagram& d_;
  Area face_area_;
  DiagramCharts charts_;
  std::vector<std::vector<RayEnd>> at_vertices_;
  std::vector<int> hidden_;  ///< sites from which rays leave the face
};

void Examiner::trace_vertices() {
  const CurvatureMap curvature(domain_.surface());
  for (const DiagramVertex& v : d_.vertices) {
    at_vertices_.emplace_back();
    for (std::size_t i = 0; i < v.sites.size(); ++i)
      at_vertices_.back().push_back(trace_ray(domain_.surface(), site(v.sites[i]), {v.radius, v.angles[i]}, curvature));
  }
}

CertificateClaim with_fault(CertificateClaim claim, const std::optional<TopologyFault>& fault) {
  if (!fault) return claim;
  claim.holds = false, claim.measured = 1.0, claim.why = fault->text;
  claim.offender = fault->vertex >= 0 ? Offender::Vertex
                   : fault->edge >= 0 ? Offender::Edge
                   : fault->cell >= 0 ? Offender::Cell
                                      : Offender::Diagram;
  claim.id = std::max({fault->vertex, fault->edge, fault->cell});
  return claim;
}

CertificateClaim Examiner::topology() const {
  const Claim claim("topology", "every edge is walked once in each direction, loops close, vertices and edges agree",
                    0.0);
  return with_fault(claim.done(), first_topology_fault(d_));
}

CertificateClaim Examiner::border() const {
  const Claim claim("border", "the cells' stretches of border are the face's border, each part of it once", 0.0);
  return with_fault(claim.done(), first_border_fault(border_, d_));
}

/// The spread of the radial lengths at a vertex, relative to the radius.
double spread_at(const DiagramVertex& v, const std::vector<RayEnd>& rays) {
  double lo = v.radius, hi = v.radius;
  for (const RayEnd& ray : rays) {
    const double length = ray.found ? distance_beside(ray, v.xyz) : std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(length)) return std::numeric_limits<double>::infinity();
    lo = std::min(lo, length), hi = std::max(hi, length);
  }
  return larger_of(0.0, hi - lo - kCoordinateRounding * v.xyz.lpNorm<Eigen::Infinity>()) / v.radius;
}

CertificateClaim Examiner::radial_lengths() const {
  Claim claim("radial lengths",
              "the lengths of the rays from both sides agree at every point of the edges, at a place between two of "
              "them, and at the vertices (relative; rays traced anew)",
              kEquidistance);
  for (std::size_t i = 0; i < d_.vertices.size(); ++i) {
    const DiagramVertex& v = d_.vertices[i];
    claim.measure(spread_at(v, at_vertices_[i]), Offender::Vertex, static_cast<int>(i), v.uv,
                  "the lengths of the rays to the vertex differ");
  }
  for (std::size_t i = 0; i < charts_.edges.size(); ++i) {
    const EdgeWalk& walk = charts_.edges[i];
    claim.measure(walk.radial_gap, Offender::Edge, static_cast<int>(i), walk.worst,
                  "the lengths of the rays to a point of the edge differ");
    claim.measure(walk.gap_between, Offender::Edge, static_cast<int>(i), walk.worst,
                  "the lengths of the rays to a place between two points differ");
  }
  return claim.done();
}

CertificateClaim Examiner::places() const {
  Claim claim("places", "the rays from all sides end at the stored points and vertices (relative to the radius)",
              kSamePlace);
  for (std::size_t i = 0; i < d_.vertices.size(); ++i) {
    const DiagramVertex& v = d_.vertices[i];
    double off = 0.0;
    for (const RayEnd& ray : at_vertices_[i]) off = larger_of(off, (ray.x - v.xyz).norm());
    if (v.on_boundary) off = larger_of(off, (border_.xyz({v.border_cycle, v.border_parameter}) - v.xyz).norm());
    claim.measure(off / v.radius, Offender::Vertex, static_cast<int>(i), v.uv,
                  "a ray, or the border, misses the vertex");
  }
  for (std::size_t i = 0; i < charts_.edges.size(); ++i) {
    const EdgeWalk& walk = charts_.edges[i];
    const bool followed = walk.seen[0].found && walk.seen[1].found;
    claim.measure(followed ? walk.place_gap : std::numeric_limits<double>::infinity(), Offender::Edge,
                  static_cast<int>(i), walk.worst,
                  followed ? "a ray ends beside its point" : "a ray to the edge can't be followed");
  }
  return claim.done();
}

CertificateClaim Examiner::smoothness() const {
  Claim claim(
      "smooth edges",
      "along each edge the rays that the system (13) predicts for places between its points meet (relative to the "
      "radius), and the left site is to the left",
      kNoJump);
  for (std::size_t i = 0; i < charts_.edges.size(); ++i) {
    const EdgeWalk& walk = charts_.edges[i];
    claim.measure(walk.left_is_left ? walk.jump : std::numeric_limits<double>::infinity(), Offender::Edge,
                  static_cast<int>(i), d_.edges[i].points.front().uv,
                  walk.left_is_left ? "the edge jumps between two points" : "its left site is to the right");
  }
  return claim.done();
}

// The rays' tangents stand around a vertex counter-clockwise in the order of its generators, and the spokes halve the
// sectors between them. turn_between() is at least zero, so the sum is a whole number of turns.
CertificateClaim Examiner::sectors() const {
  Claim claim("sectors", "around each vertex the sectors between its rays add up to one turn (radians off)", kOneTurn);
  for (std::size_t i = 0; i < d_.vertices.size(); ++i) {
    const DiagramVertex& v = d_.vertices[i];
    const std::vector<RayEnd>& rays = at_vertices_[i];
    if (rays.size() < 2) continue;
    double sum = 0.0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const std::size_t next = (k + 1) % rays.size();
      const RayEnd &a = rays[k], &b = rays[next];
      // A cell that comes to a corner of the border from both its sides has one ray there.
      if (v.on_boundary && v.sites[k] == v.sites[next] && std::abs(wrap_angle(v.angles[k] - v.angles[next])) < kOneTurn)
        continue;
      if (a.found && b.found) sum += turn_between(a.T, b.T, a.T.cross(a.N));
    }
    claim.measure(std::abs(sum - kTwoPi), Offender::Vertex, static_cast<int>(i), d_.vertices[i].uv,
                  "the rays do not stand around the vertex in the order of its generators");
  }
  return claim.done();
}

CertificateClaim Examiner::stars() const {
  Claim claim("stars", "around each site the angle of the rays to its edges grows (largest step back, relative)",
              kNoStepBack);
  for (std::size_t i = 0; i < charts_.cells.size(); ++i) {
    const CellChart& chart = charts_.cells[i];
    claim.measure(chart.found ? chart.back : std::numeric_limits<double>::infinity(), Offender::Cell,
                  static_cast<int>(i), site(static_cast<int>(i)),
                  chart.found ? "the border turns back" : "a ray to the border can't be followed");
  }
  return claim.done();
}

/// What the loops' turn lacks of 2 pi. A site on the border of the face is passed by its own loop: there the turn is
/// what the face covers of the directions.
double Examiner::missing_turn(int cell) const {
  const double missing = kTwoPi - charts_.cells[cell].turn;
  if (std::abs(missing) <= kOneTurn) return std::abs(missing);
  const bool on_border = domain_.distance_to_border(site(cell)) <= domain_.deflection();
  if (on_border && missing > 0.0 && missing < kTwoPi + kOneTurn) return 0.0;
  return std::abs(missing);
}

CertificateClaim Examiner::turns() const {
  Claim claim("one turn", "the loops of each cell go around its site once and close (radians off)", kOneTurn);
  for (int i = 0; i < static_cast<int>(charts_.cells.size()); ++i) {
    claim.measure(missing_turn(i), Offender::Cell, i, site(i), "the loops do not go around the site once");
  }
  return claim.done();
}

/// How far an edge's end lies from its vertex, in space and as both sites see it, relative to the radius.
double gap_at_end(const DiagramVertex& v, const std::vector<RayEnd>& rays, std::size_t spoke, bool at_end,
                  const EdgePoint& end) {
  const std::size_t right = spoke, left = (spoke + 1) % v.sites.size();
  const std::array<std::size_t, 2> generator = {at_end ? right : left, at_end ? left : right};
  double off = larger_of((end.xyz - v.xyz).norm(), std::abs(end.radius - v.radius));
  for (int side = 0; side < 2; ++side) {
    const double t = side == 0 ? end.left_angle : end.right_angle;
    const std::size_t i = generator[side];
    off = larger_of(off, std::abs(wrap_angle(t - v.angles[i]) * rays[i].y));
  }
  return off / v.radius;
}

// A jump of the rays around a cell is seen in its chart; where a vertex is not what its edges end in, here.
CertificateClaim Examiner::corners() const {
  Claim claim("corners",
              "edges end in their vertices, by the same rays, and around each cell the ray goes on where one piece of "
              "the border follows another (relative to the radius)",
              kCornersMeet);
  for (std::size_t i = 0; i < d_.vertices.size(); ++i) {
    const DiagramVertex& v = d_.vertices[i];
    for (std::size_t k = 0; k < v.spokes.size(); ++k) {
      const auto& points = d_.edges[v.spokes[k].edge].points;
      const bool at_end = v.spokes[k].at_end;
      claim.measure(gap_at_end(v, at_vertices_[i], k, at_end, at_end ? points.back() : points.front()),
                    Offender::Vertex, static_cast<int>(i), v.uv, "an edge ends beside it");
    }
  }
  for (int i = 0; i < static_cast<int>(charts_.cells.size()); ++i) {
    claim.measure(charts_.cells[i].corner_gap, Offender::Cell, i, site(i),
                  "the ray jumps where one piece of the border follows another");
    claim.measure(off_antipode(i), Offender::Cell, i, site(i), "the point where all its rays meet is no vertex");
  }
  for (std::size_t i = 0; i < d_.vertices.size(); ++i) {
    if (d_.vertices[i].spokes.empty() && !charts_.cells[d_.vertices[i].sites.front()].antipode)
      claim.measure(1.0, Offender::Vertex, static_cast<int>(i), d_.vertices[i].uv, "a vertex without edges");
  }
  return claim.done();
}

/// Where all rays of the only site of a closed surface meet in one point of the face, how far that lies from its
/// vertex, relative to the radius.
double Examiner::off_antipode(int cell) const {
  const auto& antipode = charts_.cells[cell].antipode;
  if (!antipode || !domain_.contains(domain_.to_principal(antipode->uv))) return 0.0;
  double off = std::numeric_limits<double>::infinity();
  for (const DiagramVertex& v : d_.vertices)
    off = std::min(off, (domain_.surface().position(antipode->uv) - v.xyz).norm());
  return off / antipode->s;
}

CertificateClaim Examiner::regularity() const {
  Claim claim(
      "no conjugate points",
      "y / radius > 0 along the cells' borders (free ends of cut loci left out), and no sign change of y on one "
      "ray of each cell: by continuity on none (largest -y / radius)",
      -kPositive);
  for (int i = 0; i < static_cast<int>(charts_.cells.size()); ++i) {
    const CellChart& chart = charts_.cells[i];
    claim.measure(-chart.least_y, Offender::Cell, i, site(i), "y vanishes on the border");
    if (chart.conjugate_at > 0.0) claim.measure(0.0, Offender::Cell, i, site(i), "a ray has passed a conjugate point");
  }
  return claim.done();
}

/// Of the polyline in space.
double length_of(const DiagramEdge& e) {
  double length = 0.0;
  for (std::size_t i = 1; i < e.points.size(); ++i) length += (e.points[i].xyz - e.points[i - 1].xyz).norm();
  return length;
}

CertificateClaim Examiner::areas() const {
  const double value = face_area_.value, error = face_area_.error / value;
  Claim claim("areas",
              "the polar areas of the cells are positive and add up to the face's, which is known as well; what the "
              "diagram says of areas and lengths is so (relative difference)",
              kAreasAddUp + (error <= kAreasAddUp ? error : 0.0));
  const double inf = std::numeric_limits<double>::infinity();
  if (!(value > 0.0 && error >= 0.0 && error <= kAreasAddUp))
    claim.measure(inf, Offender::Diagram, -1, Uv{}, "the face's own area is not known well enough");
  double sum = 0.0;
  const bool stored = measured();
  for (int i = 0; i < static_cast<int>(charts_.cells.size()); ++i) {
    const double area = charts_.cells[i].area;
    sum += area;
    if (!(area > 0.0)) claim.measure(inf, Offender::Cell, i, site(i), "its area is not positive");
    if (stored)
      claim.measure(std::abs(d_.cells[i].area - area) / value, Offender::Cell, i, site(i), "its area is another one");
  }
  for (int i = 0; i < static_cast<int>(d_.edges.size()); ++i) {
    const double length = length_of(d_.edges[i]);
    claim.measure(std::abs(d_.edges[i].length - length) / length, Offender::Edge, i, d_.edges[i].points.front().uv,
                  "its length is another one");
  }
  claim.measure(std::abs(sum - value) / value, Offender::Diagram, -1, Uv{}, "the cells do not add up to the face");
  return claim.done();
}

/// Without areas a diagram was not measured, nor searched for paths that leave the face.
bool Examiner::measured() const {
  return std::any_of(d_.cells.begin(), d_.cells.end(), [](const DiagramCell& cell) { return cell.area != 0.0; });
}

// A cell is a star of the surface continued. A ray to one of its places that leaves the face comes back through a
// stretch of border that belongs to the cell too and turns its back on the site: along it the angle falls. Rays that
// leave by less than the border's deflection, to the side, are not told from rays along it.
void Examiner::find_hidden() {
  for (int i = 0; i < static_cast<int>(charts_.cells.size()); ++i)
    if (!(charts_.cells[i].hidden <= domain_.deflection())) hidden_.push_back(i);
}

// What a warning takes no notice of (path_checks.h) need not be warned of, though it is not covered.
CertificateClaim Examiner::warnings() const {
  Claim claim("warnings",
              "the diagram, if it was measured, warns of sites whose paths leave the face, and of seams taken for its "
              "border (how many of them it does not name)",
              0.0);
  const auto warned = [&](const char* kind, const auto& of_it) {
    return std::any_of(d_.warnings.begin(), d_.warnings.end(),
                       [&](const DiagramWarning& w) { return w.kind == kind && of_it(w); });
  };
  double missing = 0.0;
  for (const Uv seam : seams_taken_for_border(domain_, border_)) {
    const Uv uv = domain_.to_principal(seam);
    if (!warned("seam_is_border", [&](const DiagramWarning& w) { return w.uv == uv; }))
      claim.measure(++missing, Offender::Diagram, -1, uv, "a seam is taken for a border, and no warning says so");
  }
  for (const int i : hidden_) {
    const auto names_it = [&](const DiagramWarning& w) {
      return std::find(w.sites.begin(), w.sites.end(), i) != w.sites.end();
    };
    if (!measured() || warned("path_leaves_face", names_it)) continue;
    if (!paths_that_leave(domain_, d_, i).empty())
      claim.measure(++missing, Offender::Cell, i, site(i), "its paths leave the face, and no warning says so");
  }
  return claim.done();
}

std::string digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", x);
  return text;
}

std::string Examiner::summary(const Certificate& certificate) const {
  for (const CertificateClaim& c : certificate.claims) {
    if (c.holds) continue;
    const char* kinds[] = {"", "vertex ", "edge ", "cell ", ""};
    const std::string who = c.id >= 0 ? kinds[static_cast<int>(c.offender)] + std::to_string(c.id) + ": " : "";
    return "not proved: " + c.name + ": " + who + c.why + " (" + digits(c.measured) + ", allowed " + digits(c.bound) +
           ")";
  }
  double error = 0.0;
  for (const CertificateClaim& c : certificate.claims)
    if (c.name == "radial lengths") error = c.measured;
  std::string text = std::string("proved: every point of a cell is nearest to the cell's site, up to ") +
                     digits(error) + " of the distance for each edge crossed";
  if (certificate.not_covered.empty())
    return text + "; all shortest paths to it stay in the face, up to " + digits(domain_.deflection()) +
           " beside its border";
  return text + ", distances being those of the surface; paths within the face may differ for " +
         std::to_string(certificate.not_covered.size()) + " of " + std::to_string(d_.sites.size()) +
         " sites, whose rays leave the face";
}

Certificate Examiner::examine() {
  Certificate certificate;
  const auto claim = [&](CertificateClaim c) {
    certificate.claims.push_back(std::move(c));
    return certificate.claims.back().holds;
  };
  std::set<int> leaving;
  for (const DiagramWarning& w : d_.warnings)
    if (w.kind == "path_leaves_face") leaving.insert(w.sites.begin(), w.sites.end());
  // Where one of these fails there is nothing that could be walked along.
  if (claim(all_numbers_finite(d_)) && claim(topology()) && claim(border())) {
    charts_ = chart_cells(domain_, d_);
    trace_vertices();
    find_hidden();
    leaving.insert(hidden_.begin(), hidden_.end());
    for (const CertificateClaim& c :
         {radial_lengths(), places(), places_are_of_parameters(domain_.surface(), d_), all_in_the_face(domain_, d_),
          smoothness(), sectors(), stars(), turns(), corners(), regularity(), warnings(), areas()})
      claim(c);
  }
  certificate.not_covered.assign(leaving.begin(), leaving.end());
  certificate.result = summary(certificate);
  return certificate;
}

}  // namespace

bool Certificate::holds() const {
  return std::all_of(claims.begin(), claims.end(), [](const CertificateClaim& c) { return c.holds; });
}

Certificate certify(const FaceDomain& domain, const VoronoiDiagram& diagram, const Area& face_area) {
  return Examiner(domain, diagram, face_area).examine();
}

}  // namespace geovor
