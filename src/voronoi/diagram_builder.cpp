#include "voronoi/diagram_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "voronoi/border_scan.h"
#include "voronoi/cell_areas.h"
#include "voronoi/cell_start.h"
#include "voronoi/cells.h"
#include "voronoi/dense_edge.h"
#include "voronoi/edge_tracer.h"
#include "voronoi/lost_geodesics.h"
#include "voronoi/near_ties.h"
#include "voronoi/path_checks.h"
#include "voronoi/seam_check.h"
#include "voronoi/vertex_table.h"

namespace geovor {
namespace {

// Vertices nearer than this part of the face's size are one if they agree in what meets there.
constexpr double kMerge = 1e-8;

// How often an open spoke is tried: an edge that fitted nowhere may fit when its neighbours are there.
constexpr int kMostTrials = 3;

// A point lies on an edge known before where it is this near to the chord of two of its points, as a part of that
// chord: edges bend less, and another edge of the same two sites is farther away.
constexpr double kOnEdge = 0.3;

class DiagramBuilder {
 public:
  DiagramBuilder(const FaceDomain& domain, const std::vector<Uv>& sites, double tolerance,
                 std::function<bool(int, int)> progress)
      : domain_(domain),
        places_(sites),
        rays_(domain.surface(), places_),
        sites_(rays_),
        border_(domain),
        tracer_(border_, rays_, sites_, tolerance),
        table_(domain, kMerge * face_size(domain)),
        of_site_(sites.size()),
        progress_(std::move(progress)) {
    diagram_.tolerance = tolerance;
  }

  /// What of a part's diagram is one of all sites too.
  void keep(const PartDiagram& part);

  bool stopped() const { return stopped_; }

  VoronoiDiagram build() {
    for (Uv p : places_) diagram_.sites.push_back({domain_.to_principal(p), domain_.surface().position(p)});
    if (!places_.empty()) {
      for (int cycle = 0; cycle < border_.cycle_count(); ++cycle) start_on_border(cycle);
      trace_open_spokes();
      for (int site = 0; site < rays_.count() && !stopped_; ++site) start_at_site(site);
      warn_of_open_spokes();
      if (stopped_) diagram_.warnings.push_back({"unresolved", {}, diagram_.sites[0].uv, "the work was stopped"});
    }
    write_vertices_and_edges();
    assemble_cells(
        border_, [this](int cycle) { return owner_of(cycle); }, diagram_);
    warn_of_lost_geodesics(sites_, diagram_);
    warn_of_seams();
    return std::move(diagram_);
  }

 private:
  struct Edge {
    std::vector<BisectorPoint> points;
    SpokeRef start, end;  ///< of no vertex where the edge is closed
    double length = 0.0;
    bool alive = true;
  };
  std::optional<std::vector<SiteRay>> kept_rays(const DiagramVertex& vertex, const std::vector<int>& which) const;
  std::optional<std::vector<BisectorPoint>> kept_points(const DiagramEdge& edge, const std::vector<int>& which) const;
  void start_on_border(int cycle);
  void start_at_site(int site);
  void trace_both_ways(const BisectorPoint& seed);
  void trace_open_spokes();
  void trace_spoke(SpokeRef start);
  void open_spokes_of(int vertex);
  std::optional<SpokeRef> arrive(const TracedEdge& edge);
  std::optional<SpokeRef> arrive_at_knot(const TracedEdge& edge);
  bool put_knot(const std::vector<SiteRay>& generators);
  void add(std::vector<BisectorPoint> points, SpokeRef start, SpokeRef end);
  void reach(int site, int edge);
  void remove(int edge);
  bool covered(const BisectorPoint& m) const;
  bool lies_on(const Edge& edge, const BisectorPoint& m) const;
  void write_vertices_and_edges();
  DiagramEdge written(const Edge& edge) const;
  void warn(const std::string& kind, const BisectorPoint& m, const std::string& text);
  void warn_of_open_spokes();
  void warn_of_seams();
  void warn_of_unseen(const UnseenStretch& stretch);
  int owner_of(int cycle) const;

  const FaceDomain& domain_;
  std::vector<Uv> places_;
  SiteRays rays_;
  NearbySites sites_;
  FaceBorder border_;
  EdgeTracer tracer_;
  VertexTable table_;
  std::vector<Edge> edges_;
  std::vector<std::vector<int>> of_site_;  ///< edges of each cell
  std::function<bool(int, int)> progress_;
  int reached_ = 0;  ///< cells with an edge
  bool stopped_ = false;
  std::deque<SpokeRef> open_;
  std::map<SpokeRef, int> trials_;
  VoronoiDiagram diagram_;
};

void DiagramBuilder::warn(const std::string& kind, const BisectorPoint& m, const std::string& text) {
  diagram_.warnings.push_back({kind, {m.left.site, m.right.site}, domain_.to_principal(m.left.uv), text});
}

void DiagramBuilder::warn_of_seams() {
  for (Uv seam : seams_taken_for_border(domain_, border_)) {
    diagram_.warnings.push_back({"seam_is_border",
                                 {},
                                 domain_.to_principal(seam),
                                 "the surface closes on itself here but declares no period: the seam is taken for a "
                                 "border, at which cells end, and distances know no path across it"});
  }
}

/// The rays of a vertex inside the face if no other site is as near.
std::optional<std::vector<SiteRay>> DiagramBuilder::kept_rays(const DiagramVertex& v,
                                                              const std::vector<int>& which) const {
  if (v.on_boundary || v.sites.size() < 3) return std::nullopt;
  std::vector<SiteRay> generators;
  for (size_t i = 0; i < v.sites.size(); ++i) {
    const auto ray = rays_.at(which[v.sites[i]], {v.radius, v.angles[i]});
    if (!ray) return std::nullopt;
    generators.push_back(*ray);
  }
  if (!sites_.nearer_than(v.radius * (1.0 + kTieWindow), generators.front().uv, generators).empty()) {
    return std::nullopt;
  }
  return generators;
}

std::optional<std::vector<BisectorPoint>> DiagramBuilder::kept_points(const DiagramEdge& e,
                                                                      const std::vector<int>& which) const {
  std::vector<BisectorPoint> points;
  for (const EdgePoint& p : e.points) {
    const auto left = rays_.at(which[e.left], {p.radius, p.left_angle});
    const auto right = rays_.at(which[e.right], {p.radius, p.right_angle});
    if (!left || !right) return std::nullopt;
    points.push_back({*left, *right});
    if (!sites_.nearer_than(p.radius * (1.0 - kOneVertex), left->uv, {*left, *right}).empty()) return std::nullopt;
  }
  return points;
}

void DiagramBuilder::keep(const PartDiagram& part) {
  const VoronoiDiagram& d = part.diagram;
  std::vector<int> number(d.vertices.size(), -1);
  for (size_t v = 0; v < d.vertices.size(); ++v) {
    const auto generators = kept_rays(d.vertices[v], part.which);
    if (!generators) continue;
    number[v] = table_.put_inside(*generators);
  }
  const auto spoke_of = [&](int vertex, int edge, bool at_end) {
    const auto& spokes = d.vertices[vertex].spokes;
    const auto same = [&](const Spoke& s) { return s.edge == edge && s.at_end == at_end; };
    return SpokeRef{number[vertex],
                    static_cast<int>(std::find_if(spokes.begin(), spokes.end(), same) - spokes.begin())};
  };
  for (int e = 0; e < static_cast<int>(d.edges.size()); ++e) {
    const DiagramEdge& edge = d.edges[e];
    if (edge.closed() || number[edge.from] < 0 || number[edge.to] < 0) continue;
    if (auto points = kept_points(edge, part.which)) {
      add(std::move(*points), spoke_of(edge.from, e, false), spoke_of(edge.to, e, true));
    }
  }
  for (int v : number) {
    if (v >= 0) open_spokes_of(v);
  }
}

void DiagramBuilder::start_on_border(int cycle) {
  const BorderScan scan = scan_border(border_, cycle, rays_, sites_);
  for (const UnseenStretch& stretch : scan.unseen) warn_of_unseen(stretch);
  for (const LabelChange& change : scan.changes) {
    const SiteRay &before = change.before, &after = change.after;
    const auto tied = sites_.nearer_than(before.polar.s * (1.0 + kTieWindow), before.uv, {before, after});
    std::vector<SiteRay> around = {after};
    around.insert(around.end(), tied.begin(), tied.end());
    around.push_back(before);
    sort_around(around);
    if (tied.empty() || !put_knot(around)) open_spokes_of(table_.put_on_border(change.place, {after, before}));
  }
}

void DiagramBuilder::warn_of_unseen(const UnseenStretch& stretch) {
  std::vector<int> beside;
  if (stretch.before >= 0) beside.push_back(stretch.before);
  if (stretch.after >= 0 && stretch.after != stretch.before) beside.push_back(stretch.after);
  char to[64];
  const Uv end = domain_.to_principal(border_.uv(stretch.to));
  std::snprintf(to, sizeof to, "(%.6g, %.6g)", end.u, end.v);
  diagram_.warnings.push_back({"unresolved", beside, domain_.to_principal(border_.uv(stretch.from)),
                               std::string("to the border from here to (u, v) = ") + to +
                                   " no geodesic was found: the shortest paths of the sites beside it leave the face "
                                   "and the surface, which is not known there"});
}

/// The site in whose cell all of a cycle lies; -1 where no ray reaches it.
int DiagramBuilder::owner_of(int cycle) const {
  constexpr int kPlaces = 8;  // one will do; a corner may be out of reach
  for (int i = 0; i < kPlaces; ++i) {
    const auto nearest =
        sites_.nearest(border_.uv({cycle, i * static_cast<double>(border_.segment_count(cycle)) / kPlaces}));
    if (!nearest.empty()) return nearest.front().site;
  }
  return -1;
}

// The border of the cell is one curve in its polar chart. Either all of it is inside the face, with the start, or every
// piece of it that is ends on the face's border, where it was found before.
void DiagramBuilder::start_at_site(int site) {
  const CellStart start = start_of_cell(domain_, rays_, sites_, site);
  switch (start.kind) {
    case CellStart::OnBisector:
      if (!covered(start.point)) trace_both_ways(start.point);
      break;
    case CellStart::AtPoint:
      table_.add_point(start.point.left);
      break;
    case CellStart::OffFace:
      break;
    case CellStart::NotFound:
      diagram_.warnings.push_back(
          {"unresolved", {site}, diagram_.sites[site].uv, "no point of the border of this cell was found"});
      break;
  }
  trace_open_spokes();
}

void DiagramBuilder::trace_both_ways(const BisectorPoint& seed) {
  if (domain_.distance_to_border(domain_.to_principal(seed.left.uv)) < kMerge * seed.radius()) return;  // found there
  const double radius = seed.radius();
  const auto tied = sites_.nearer_than(radius * (1.0 + kTieWindow), seed.left.uv, {seed.left, seed.right});
  if (!tied.empty()) {
    std::vector<SiteRay> generators = {seed.left, seed.right};
    generators.insert(generators.end(), tied.begin(), tied.end());
    sort_around(generators);
    if (put_knot(generators) && (table_.arriving(seed) || table_.arriving({seed.right, seed.left}))) return;
  }
  const TracedEdge onward = tracer_.trace(seed, false);
  if (onward.end == TraceEnd::Closed) {
    add(onward.points, {}, {});
    return;
  }
  const TracedEdge back = tracer_.trace({seed.right, seed.left}, false);
  const auto end = arrive(onward), start = arrive(back);
  if (!end || !start) {
    warn("unresolved", seed, "the edge through this point does not fit into the diagram");
    return;
  }
  std::vector<BisectorPoint> points;
  for (auto p = back.points.rbegin(); p != back.points.rend(); ++p) points.push_back({p->right, p->left});
  points.insert(points.end(), onward.points.begin() + 1, onward.points.end());
  if (!table_.taken(*start)) add(std::move(points), *start, *end);
}

void DiagramBuilder::open_spokes_of(int vertex) {
  for (int s = 0; s < static_cast<int>(table_.vertex(vertex).spokes.size()); ++s) {
    if (!table_.taken({vertex, s})) open_.push_back({vertex, s});
  }
}

void DiagramBuilder::trace_open_spokes() {
  while (!open_.empty() && !stopped_) {
    const SpokeRef spoke = open_.front();
    open_.pop_front();
    if (!table_.taken(spoke) && trials_[spoke]++ < kMostTrials) trace_spoke(spoke);
  }
}

void DiagramBuilder::trace_spoke(SpokeRef start) {
  const TracedEdge edge = tracer_.trace(table_.departure(start), table_.vertex(start.vertex).on_boundary);
  const auto end = arrive(edge);
  // The edge may be one of a knot of vertices at its end.
  if (end && !table_.taken(start)) add(edge.points, start, *end);
}

std::optional<SpokeRef> DiagramBuilder::arrive(const TracedEdge& edge) {
  const BisectorPoint& last = edge.points.back();
  std::optional<SpokeRef> spoke;
  switch (edge.end) {
    case TraceEnd::Vertex:
    case TraceEnd::Border:
      spoke = arrive_at_knot(edge);
      break;
    case TraceEnd::FreeEnd:
      spoke = table_.arrive_at_free_end(last);
      break;
    case TraceEnd::Stuck:
      // What there is of a cut locus beside its end, where its rays are one to rounding, is kept.
      if (last.left.site == last.right.site) {
        warn("cut_locus", last, "the cut locus of this site ends near here; its last piece is not traced");
        spoke = table_.arrive_at_free_end(last);
      }
      break;
    case TraceEnd::Closed:
      break;
  }
  if (spoke) open_spokes_of(spoke->vertex);
  return spoke;
}

std::optional<SpokeRef> DiagramBuilder::arrive_at_knot(const TracedEdge& edge) {
  const BisectorPoint& last = edge.points.back();
  if (const auto known = table_.arriving(last)) return known;
  const bool plain = edge.end == TraceEnd::Border && edge.generators.size() == 2;
  if (!plain) put_knot(edge.generators);
  if (edge.end == TraceEnd::Border && !table_.arriving(last)) {
    table_.put_on_border(edge.place, {last.left, last.right});
  }
  return table_.arriving(last);
}

// No step leads along an edge within the disk: it is straight, from one vertex to the other.
bool DiagramBuilder::put_knot(const std::vector<SiteRay>& generators) {
  const Knot knot = resolve_ties(border_, rays_, generators);
  std::vector<int> number;
  for (const Knot::Vertex& v : knot.vertices) {
    number.push_back(v.place ? table_.put_on_border(*v.place, v.generators) : table_.put_inside(v.generators));
  }
  for (const Knot::Edge& e : knot.edges) {
    const SiteRay &left = generators[e.left], &right = generators[e.right];
    const auto from = table_.spoke_between(number[e.from], right, left);
    const auto to = table_.spoke_between(number[e.to], left, right);
    if (!from || !to || table_.taken(*from) || table_.taken(*to)) continue;
    const BisectorPoint end = table_.departure(*to);
    add({table_.departure(*from), {end.right, end.left}}, *from, *to);
  }
  for (int vertex : number) open_spokes_of(vertex);
  return !number.empty();
}

// Two edges that claim one spoke: the longer has passed by a vertex that the shorter one comes from. It goes, and what
// it leaves open is traced again.
void DiagramBuilder::add(std::vector<BisectorPoint> points, SpokeRef start, SpokeRef end) {
  Edge edge{std::move(points), start, end};
  for (size_t i = 1; i < edge.points.size(); ++i) {
    edge.length += (edge.points[i].position() - edge.points[i - 1].position()).norm();
  }
  const int id = static_cast<int>(edges_.size());
  const bool closed = start.vertex < 0;
  if (!closed && table_.taken(end)) {
    const int other = table_.holder(end).edge;
    if (!(edge.length < edges_[other].length)) return;
    remove(other);
  }
  if (!closed) {
    table_.take(start, {id, false});
    table_.take(end, {id, true});
  }
  reach(edge.points.front().left.site, id);
  reach(edge.points.front().right.site, id);
  edges_.push_back(std::move(edge));
}

void DiagramBuilder::reach(int site, int edge) {
  if (of_site_[site].empty()) {
    ++reached_;
    stopped_ = stopped_ || (progress_ && !progress_(reached_, rays_.count()));
  }
  of_site_[site].push_back(edge);
}

void DiagramBuilder::remove(int id) {
  Edge& edge = edges_[id];
  edge.alive = false;
  for (SpokeRef spoke : {edge.start, edge.end}) {
    table_.release(spoke);
    open_.push_back(spoke);
  }
}

bool DiagramBuilder::lies_on(const Edge& edge, const BisectorPoint& m) const {
  for (size_t i = 0; edge.alive && i + 1 < edge.points.size(); ++i) {
    const BisectorPoint& a = edge.points[i];
    const Xyz way = edge.points[i + 1].position() - a.position(), to = m.position() - a.position();
    const double k = std::clamp(way.dot(to) / way.squaredNorm(), 0.0, 1.0);
    if ((to - k * way).norm() < kOnEdge * way.norm()) return true;
  }
  return false;
}

bool DiagramBuilder::covered(const BisectorPoint& m) const {
  for (int e : of_site_[m.left.site]) {
    const BisectorPoint& a = edges_[e].points.front();
    const bool same = (a.left.site == m.left.site && a.right.site == m.right.site) ||
                      (a.left.site == m.right.site && a.right.site == m.left.site);
    if (same && lies_on(edges_[e], m)) return true;
  }
  return false;
}

void DiagramBuilder::warn_of_open_spokes() {
  for (int v = 0; v < table_.count(); ++v) {
    for (int s = 0; s < static_cast<int>(table_.vertex(v).spokes.size()); ++s) {
      if (!table_.taken({v, s})) {
        warn("unresolved", table_.departure({v, s}), "the edge that starts here could not be followed to its end");
      }
    }
  }
}

DiagramEdge DiagramBuilder::written(const Edge& e) const {
  DiagramEdge edge;
  edge.left = e.points.front().left.site;
  edge.right = e.points.front().right.site;
  edge.from = e.start.vertex;
  edge.to = e.end.vertex;
  edge.kind = edge.left == edge.right ? EdgeKind::CutLocus : EdgeKind::Bisector;
  edge.points = dense_edge(rays_, e.points, diagram_.tolerance);
  for (size_t i = 0; i < edge.points.size(); ++i) {
    edge.points[i].uv = domain_.to_principal(edge.points[i].uv);
    if (i > 0) edge.length += (edge.points[i].xyz - edge.points[i - 1].xyz).norm();
  }
  return edge;
}

void DiagramBuilder::write_vertices_and_edges() {
  std::vector<int> number(edges_.size(), -1);
  for (size_t i = 0; i < edges_.size(); ++i) {
    if (!edges_[i].alive) continue;
    number[i] = static_cast<int>(diagram_.edges.size());
    diagram_.edges.push_back(written(edges_[i]));
  }
  for (int v = 0; v < table_.count(); ++v) {
    diagram_.vertices.push_back(table_.vertex(v));
    for (Spoke& spoke : diagram_.vertices.back().spokes) {
      if (spoke.edge >= 0) spoke.edge = number[spoke.edge];
    }
  }
}

}  // namespace

double face_size(const FaceDomain& domain) {
  constexpr int kSamples = 8;
  const UvBox& box = domain.box();
  Xyz lower = Xyz::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (int j = 0; j <= kSamples; ++j) {
    for (int i = 0; i <= kSamples; ++i) {
      const Xyz x = domain.surface().position(
          {box.u.lo + box.u.length() * i / kSamples, box.v.lo + box.v.length() * j / kSamples});
      lower = lower.cwiseMin(x), upper = upper.cwiseMax(x);
    }
  }
  return (upper - lower).norm();
}

VoronoiDiagram build_diagram(const FaceDomain& domain, const std::vector<Uv>& sites, const VoronoiOptions& options) {
  return merge_diagrams(domain, sites, {}, options);
}

VoronoiDiagram merge_diagrams(const FaceDomain& domain, const std::vector<Uv>& sites,
                              const std::vector<PartDiagram>& parts, const VoronoiOptions& options) {
  const double tolerance = options.tolerance > 0.0 ? options.tolerance : kDefaultTolerance * face_size(domain);
  DiagramBuilder builder(domain, sites, tolerance, options.progress);
  for (const PartDiagram& part : parts) builder.keep(part);
  VoronoiDiagram diagram = builder.build();
  if (!options.measure || builder.stopped()) return diagram;
  measure_cells(domain, diagram);
  recompute_residuals(domain.surface(), diagram);
  warn_of_what_has_no_measure(diagram);
  warn_of_paths_that_leave(domain, diagram);
  return diagram;
}

}  // namespace geovor
