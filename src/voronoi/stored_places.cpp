#include "voronoi/stored_places.h"

#include <algorithm>
#include <cmath>

#include "voronoi/claim.h"
#include "voronoi/site_ray.h"

namespace geovor {
namespace {

using Offender = CertificateClaim::Offender;

// Of a radius: what lies between the place of the parameters and the one that a geodesic leads to.
constexpr double kOnePlace = 1e-9;

// Parts of the size of parameters and coordinates that rounding takes: brought into the face by whole periods.
constexpr double kRounding = 64.0 * 2.220446049250313e-16;

// The flattened border that decides what lies in the face is off by one deflection, and so is what cut the edges.
constexpr double kDeflections = 2.0;

bool finite(Uv p) { return std::isfinite(p.u) && std::isfinite(p.v); }

class Count {
 public:
  Count() : claim_("numbers", "all numbers are finite (how many are not)", 0.0) {}

  void of(Offender kind, std::size_t id, Uv uv, std::initializer_list<bool> fine) {
    const auto broken = static_cast<double>(std::count(fine.begin(), fine.end(), false));
    if (broken == 0.0) return;
    total_ += broken;
    claim_.measure(total_, kind, static_cast<int>(id), uv, "a number is not finite");
  }
  CertificateClaim done() const { return claim_.done(); }

 private:
  Claim claim_;
  double total_ = 0.0;
};

void count_edge(const DiagramEdge& e, std::size_t id, Count& count) {
  for (const EdgePoint& p : e.points) {
    count.of(Offender::Edge, id, p.uv,
             {finite(p.uv), p.xyz.allFinite(), std::isfinite(p.radius), std::isfinite(p.left_angle),
              std::isfinite(p.right_angle), std::isfinite(p.radius_slope), std::isfinite(p.left_slope),
              std::isfinite(p.right_slope)});
  }
  const Uv at = e.points.empty() ? Uv{} : e.points.front().uv;
  count.of(Offender::Edge, id, at, {std::isfinite(e.length), !std::isnan(e.residual)});
}

void count_cell(const DiagramCell& cell, std::size_t id, Uv site, Count& count) {
  count.of(Offender::Cell, id, site, {std::isfinite(cell.area)});
  for (const auto& loop : cell.loops) {
    for (const CellPiece& piece : loop) {
      for (const Uv p : piece.border_uv) count.of(Offender::Cell, id, site, {finite(p)});
      for (const Xyz& x : piece.border_xyz) count.of(Offender::Cell, id, site, {x.allFinite()});
    }
  }
}

/// Distance in space between a stored place and that of its parameters, less what rounding explains.
double off_place(const Surface& surface, Uv uv, const Xyz& xyz) {
  const double off = (surface.position(uv) - xyz).norm();
  const double coordinates = kRounding * xyz.lpNorm<Eigen::Infinity>();
  if (off <= coordinates) return 0.0;
  const SurfaceJet j = surface.jet(uv);
  const double parameters = kRounding * (std::abs(uv.u) * j.Su.norm() + std::abs(uv.v) * j.Sv.norm());
  return larger_of(0.0, off - coordinates - (std::isfinite(parameters) ? parameters : 0.0));
}

double size_of(const VoronoiDiagram& d) {
  Xyz lower = d.sites.front().xyz, upper = lower;
  const auto include = [&](const Xyz& x) { lower = lower.cwiseMin(x), upper = upper.cwiseMax(x); };
  for (const DiagramSite& s : d.sites) include(s.xyz);
  for (const DiagramVertex& v : d.vertices) include(v.xyz);
  for (const DiagramCell& cell : d.cells)
    for (const auto& loop : cell.loops)
      for (const CellPiece& piece : loop)
        for (const Xyz& x : piece.border_xyz) include(x);
  return (upper - lower).norm();
}

class InFace {
 public:
  explicit InFace(const FaceDomain& domain)
      : domain_(domain),
        claim_("in the face", "sites, vertices and edges lie in the face, to its border's deflection (how many do not)",
               0.0) {}

  void place(Uv p, Offender kind, std::size_t id, const char* why) {
    if (!holds(p)) note(kind, id, p, why);
  }

  void edge(const DiagramEdge& e, std::size_t id, double tolerance) {
    for (const EdgePoint& p : e.points) place(p.uv, Offender::Edge, id, "a point of the edge lies outside the face");
    for (std::size_t i = 0; i + 1 < e.points.size(); ++i)
      if (leaves(e.points[i], e.points[i + 1], tolerance))
        note(Offender::Edge, id, e.points[i].uv, "the edge leaves the face between two points");
  }
  CertificateClaim done() const { return claim_.done(); }

 private:
  void note(Offender kind, std::size_t id, Uv uv, const char* why) {
    claim_.measure(++total_, kind, static_cast<int>(id), uv, why);
  }

  bool holds(Uv p) const {
    return domain_.contains(p) || domain_.distance_to_border(p) <= kDeflections * domain_.deflection() ||
           domain_.contains(within_box(p));
  }

  // At a pole the parameters may end up beyond it by their rounding, which is nothing in space.
  Uv within_box(Uv p) const {
    const Uv q = domain_.box().clamp(p);
    const Surface& surface = domain_.surface();
    return (surface.position(q) - surface.position(p)).norm() <= kDeflections * domain_.deflection() ? q : p;
  }

  // The middles of both segments tell how far they may lie apart, and the edge from that in space.
  bool leaves(const EdgePoint& a, const EdgePoint& b, double tolerance) const {
    const Uv from = within_box(a.uv), to = from + nearest_copy(domain_.surface(), from, within_box(b.uv));
    const double apart = (domain_.surface().position(lerp(from, to, 0.5)) - 0.5 * (a.xyz + b.xyz)).norm();
    const double slack = kDeflections * domain_.deflection() + tolerance + apart;
    const auto exit = domain_.first_exit({from, to}, slack);
    return exit.has_value();
  }

  const FaceDomain& domain_;
  Claim claim_;
  double total_ = 0.0;
};

}  // namespace

CertificateClaim all_numbers_finite(const VoronoiDiagram& d) {
  Count count;
  for (std::size_t i = 0; i < d.sites.size(); ++i)
    count.of(Offender::Cell, i, d.sites[i].uv, {finite(d.sites[i].uv), d.sites[i].xyz.allFinite()});
  for (std::size_t i = 0; i < d.vertices.size(); ++i) {
    const DiagramVertex& v = d.vertices[i];
    count.of(Offender::Vertex, i, v.uv,
             {finite(v.uv), v.xyz.allFinite(), std::isfinite(v.radius), std::isfinite(v.border_parameter),
              !std::isnan(v.residual)});
    for (const double t : v.angles) count.of(Offender::Vertex, i, v.uv, {std::isfinite(t)});
  }
  for (std::size_t i = 0; i < d.edges.size(); ++i) count_edge(d.edges[i], i, count);
  for (std::size_t i = 0; i < d.cells.size(); ++i)
    count_cell(d.cells[i], i, i < d.sites.size() ? d.sites[i].uv : Uv{}, count);
  count.of(Offender::Diagram, 0, Uv{}, {std::isfinite(d.tolerance)});
  return count.done();
}

CertificateClaim places_are_of_parameters(const Surface& surface, const VoronoiDiagram& d) {
  Claim claim("parameters", "stored places in space are those of the stored parameters (relative to the radius)",
              kOnePlace);
  const char* why = "its place in space is not that of its parameters";
  const double size = d.sites.empty() ? 0.0 : size_of(d);
  for (std::size_t i = 0; i < d.sites.size(); ++i)
    claim.measure(off_place(surface, d.sites[i].uv, d.sites[i].xyz) / size, Offender::Cell, static_cast<int>(i),
                  d.sites[i].uv, why);
  for (std::size_t i = 0; i < d.vertices.size(); ++i)
    claim.measure(off_place(surface, d.vertices[i].uv, d.vertices[i].xyz) / d.vertices[i].radius, Offender::Vertex,
                  static_cast<int>(i), d.vertices[i].uv, why);
  for (std::size_t i = 0; i < d.edges.size(); ++i) {
    for (const EdgePoint& p : d.edges[i].points)
      claim.measure(off_place(surface, p.uv, p.xyz) / p.radius, Offender::Edge, static_cast<int>(i), p.uv, why);
  }
  return claim.done();
}

CertificateClaim all_in_the_face(const FaceDomain& domain, const VoronoiDiagram& d) {
  InFace in_face(domain);
  for (std::size_t i = 0; i < d.sites.size(); ++i)
    in_face.place(d.sites[i].uv, Offender::Cell, i, "the site lies outside the face");
  for (std::size_t i = 0; i < d.vertices.size(); ++i)
    in_face.place(d.vertices[i].uv, Offender::Vertex, i, "the vertex lies outside the face");
  for (std::size_t i = 0; i < d.edges.size(); ++i) in_face.edge(d.edges[i], i, d.tolerance);
  return in_face.done();
}

}  // namespace geovor
