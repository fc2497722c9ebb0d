#include "voronoi/diagram_builder.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "voronoi/cell_areas.h"
#include "voronoi/cells.h"
#include "voronoi/chain_tracer.h"
#include "voronoi/label_changes.h"
#include "voronoi/path_checks.h"
#include "voronoi/rival_watch.h"
#include "voronoi/seam_check.h"
#include "voronoi/spoke_table.h"

namespace geovor {
namespace {

// The lattice has a node for every so many of a site's own spacing, and at least so many along the face's diagonal.
constexpr double kNodesPerSpacing = 2.0;
constexpr double kNodesPerDiagonal = 16.0;

// Vertices with a pair of generators in common nearer than this part of the face's size are one.
constexpr double kMerge = 1e-8;

// The border is labelled at places no further apart than this part of a lattice step.
constexpr double kBorderStep = 0.5;

// How often a stretch of the border is halved where a third site might own a piece between two equal labels.
constexpr int kDeepestSplit = 4;

/// Whether a generator that is nearest at neither place may be nearest in between, told from the distances there and
/// their slopes along the straight way.
bool may_be_hidden(const LabelledPlace& from, const LabelledPlace& to) {
  if (from.candidates.empty() || to.candidates.empty()) return false;
  const SiteRay &a = from.candidates.front(), &b = to.candidates.front();
  const Xyz way = b.x - a.x;
  const double h = way.norm();
  for (const SiteRay& c : from.candidates) {
    for (const SiteRay& d : to.candidates) {
      if (c.site != d.site || c.site == a.site || d.site == b.site) continue;
      const double falls = (c.T - a.T).dot(way) / h, rises = (d.T - b.T).dot(way) / h;
      if (cubic_minimum(c.polar.s - a.polar.s, falls, d.polar.s - b.polar.s, rises, h) < 0.0) return true;
    }
  }
  return false;
}

class DiagramBuilder {
 public:
  DiagramBuilder(const FaceDomain& domain, const std::vector<Uv>& sites, double tolerance, double spacing)
      : domain_(domain),
        sites_(sites),
        rays_(domain.surface(), sites_),
        lattice_(domain, spacing, sites_),
        labels_(lattice_, rays_),
        border_(domain),
        tracer_(domain, border_, labels_, tolerance),
        spokes_(domain, border_, kMerge * face_size(domain)),
        spacing_(spacing) {
    diagram_.tolerance = tolerance;
  }

  VoronoiDiagram build() {
    for (Uv p : sites_) diagram_.sites.push_back({domain_.to_principal(p), domain_.surface().position(p)});
    if (sites_.size() > 0) {
      scan_border();
      trace_open_spokes();
      scan_lattice();
      scan_around_sites();
    }
    for (int i = 0; i < spokes_.count(); ++i) diagram_.vertices.push_back(spokes_.vertex(i));
    const auto cycle_owner = [this](int cycle) {
      const auto around = labels_.around(border_.uv({cycle, 0.0}));
      return around.empty() ? -1 : around.front().site;
    };
    assemble_cells(border_, cycle_owner, diagram_);
    warn_of_seams();
    return std::move(diagram_);
  }

 private:
  void scan_border();
  void scan_cycle(int cycle);
  void scan_border_step(int cycle, const UvPath& path, const LabelledPlace& from, const LabelledPlace& to, int depth);
  void scan_lattice();
  void scan_around_sites();
  void trace_seed(const LabelChange& change);
  void trace_open_spokes();
  void trace_spoke(SpokeRef start, bool on_border);
  std::vector<SiteRay> generators_at(const BisectorPoint& m) const;
  bool crossed(int a, int b, Uv from, Uv to) const;
  bool covered(const SiteRay& a, const SiteRay& b) const;
  std::optional<SpokeRef> arrive(const Chain& chain);
  void add_edge(const std::vector<BisectorPoint>& points, SpokeRef start, SpokeRef end);
  DiagramEdge make_edge(const std::vector<BisectorPoint>& points) const;
  void warn(const std::string& kind, const BisectorPoint& m, const std::string& text);
  void warn_of_seams();

  const FaceDomain& domain_;
  std::vector<Uv> sites_;
  SiteRays rays_;
  FaceLattice lattice_;
  CandidateLabels labels_;
  FaceBorder border_;
  ChainTracer tracer_;
  SpokeTable spokes_;
  double spacing_;
  VoronoiDiagram diagram_;
  std::set<std::pair<int, int>> given_up_;  ///< spokes whose edge could not be traced
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

void DiagramBuilder::scan_border() {
  for (int cycle = 0; cycle < border_.cycle_count(); ++cycle) scan_cycle(cycle);
}

void DiagramBuilder::scan_cycle(int cycle) {
  const UvPath path = [this, cycle](double k) { return border_.uv({cycle, k}); };
  const auto label = [&](double k) { return LabelledPlace{k, labels_.around(path(k), true)}; };
  const double end = border_.segment_count(cycle);
  const double longest = kBorderStep * spacing_;
  LabelledPlace last = label(0.0);
  const LabelledPlace first = last;
  double walked = 0.0;
  for (int k = 0; k < border_.segment_count(cycle); ++k) {
    const double length = border_.segment_length(cycle, k);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / longest)));
    walked += length;
    if (walked < longest && k + 1 < border_.segment_count(cycle)) continue;  // short segments: one label for several
    walked = 0.0;
    for (int i = 1; i <= parts; ++i) {
      const double at = parts == 1 || i == parts ? k + 1.0 : k + static_cast<double>(i) / parts;
      LabelledPlace here = at < end ? label(at) : LabelledPlace{end, first.candidates};
      scan_border_step(cycle, path, last, here, 0);
      last = std::move(here);
    }
  }
}

void DiagramBuilder::scan_border_step(int cycle, const UvPath& path, const LabelledPlace& from, const LabelledPlace& to,
                                      int depth) {
  if (depth < kDeepestSplit && may_be_hidden(from, to)) {
    const double k = 0.5 * (from.at + to.at);
    const LabelledPlace middle{k, labels_.around(path(k), true)};
    scan_border_step(cycle, path, from, middle, depth + 1);
    scan_border_step(cycle, path, middle, to, depth + 1);
    return;
  }
  for (const LabelChange& change : label_changes(labels_, path, from, to)) {
    const double n = border_.segment_count(cycle);
    const double at = change.at < n ? change.at : 0.0;
    const SpokeRef start = spokes_.start_on_border({cycle, at}, {change.before, change.after});
    if (!spokes_.taken(start)) trace_spoke(start, true);
  }
}

void DiagramBuilder::scan_lattice() {
  for (int node = 0; node < lattice_.count(); ++node) {
    if (!lattice_.inside(node) || labels_.at(node).empty()) continue;
    for (const auto& z : lattice_.neighbours(node)) {
      if (z.node < node || !lattice_.inside(z.node) || labels_.at(z.node).empty()) continue;
      const SiteRay &a = labels_.at(node).front(), &b = labels_.at(z.node).front();
      if (same_label(a, b, (b.x - a.x).norm())) continue;
      const Uv from = lattice_.uv(node), to = z.uv;
      if (crossed(a.site, b.site, from, to)) continue;
      const UvPath path = [from, to](double k) { return lerp(from, to, k); };
      for (const auto& change : label_changes(labels_, path, {0.0, labels_.at(node)}, {1.0, labels_.at(z.node)})) {
        trace_seed(change);
      }
    }
  }
}

// A site is a node of the graph as well, joined to the corners of its cell; the path starts just off the site, nearer
// to it than to any other.
void DiagramBuilder::scan_around_sites() {
  for (int site = 0; site < rays_.count(); ++site) {
    const Xyz x = domain_.surface().position(sites_[site]);
    double nearest = spacing_;
    for (int other = 0; other < rays_.count(); ++other) {
      if (other != site) nearest = std::min(nearest, (domain_.surface().position(sites_[other]) - x).norm());
    }
    for (int corner : lattice_.corners(sites_[site])) {
      if (!lattice_.inside(corner) || labels_.at(corner).empty()) continue;
      if (labels_.at(corner).front().site == site) continue;
      const auto here = rays_.to(site, lattice_.uv(corner));
      if (!here) continue;
      const UvPath path = [&](double k) {
        const auto ray = rays_.at(site, {k * here->polar.s, here->polar.t});
        return ray ? ray->uv : lattice_.uv(corner);
      };
      const double start = std::min(0.5, 0.25 * nearest / here->polar.s);
      for (const auto& change :
           label_changes(labels_, path, {start, labels_.around(path(start))}, {1.0, labels_.at(corner)})) {
        trace_seed(change);
      }
    }
  }
}

// Whether an edge between the two cells, found before, crosses the straight way: then the labels at its ends are
// explained.
bool DiagramBuilder::crossed(int a, int b, Uv from, Uv to) const {
  const UvVec way = to - from;
  for (const DiagramEdge& e : diagram_.edges) {
    const bool same = (e.left == a && e.right == b) || (e.left == b && e.right == a);
    for (size_t i = 0; same && i + 1 < e.points.size(); ++i) {
      const UvVec p = nearest_copy(domain_.surface(), from, e.points[i].uv);
      const UvVec q = p + nearest_copy(domain_.surface(), e.points[i].uv, e.points[i + 1].uv);
      const bool beside = (cross(way, p) > 0.0) != (cross(way, q) > 0.0);
      if (beside && (cross(q - p, -p) > 0.0) != (cross(q - p, way - p) > 0.0)) return true;
    }
  }
  return false;
}

bool DiagramBuilder::covered(const SiteRay& a, const SiteRay& b) const {
  const double near = 4.0 * diagram_.tolerance;
  for (const DiagramEdge& e : diagram_.edges) {
    const bool same = (e.left == a.site && e.right == b.site) || (e.left == b.site && e.right == a.site);
    for (size_t i = 0; same && i + 1 < e.points.size(); ++i) {
      const Xyz &p = e.points[i].xyz, way = e.points[i + 1].xyz - p;
      const double k = std::clamp(way.dot(a.x - p) / way.squaredNorm(), 0.0, 1.0);
      if ((p + k * way - a.x).norm() < near) return true;
    }
  }
  return false;
}

void DiagramBuilder::trace_seed(const LabelChange& change) {
  const Uv uv = domain_.to_principal(change.before.uv);
  if (!domain_.contains(uv) || covered(change.before, change.after)) return;
  if (domain_.distance_to_border(uv) < kMerge * change.before.polar.s) return;  // found by scan_border
  const BisectorPoint seed{change.before, change.after};
  if (const auto generators = generators_at(seed); generators.size() > 2) {
    spokes_.ensure_inside(generators);
    trace_open_spokes();
    return;
  }
  const Chain onward = tracer_.trace(seed, false);
  if (onward.end == ChainEnd::Closed) {
    diagram_.edges.push_back(make_edge(onward.points));
    return;
  }
  const Chain back = tracer_.trace({seed.right, seed.left}, false);
  if (onward.points.size() == 1 && back.points.size() == 1 && seed.left.site == seed.right.site) {
    warn("cut_locus", seed, "all geodesics from this site meet again near here; its cut locus is not traced");
    return;
  }
  const auto end = arrive(onward), start = arrive(back);
  if (!end || !start) {
    warn("unresolved", seed, "the edge through this point does not fit into the diagram");
    return;
  }
  if (spokes_.taken(*start) || spokes_.taken(*end)) return;  // the same edge, traced before
  std::vector<BisectorPoint> points;
  for (auto p = back.points.rbegin(); p != back.points.rend(); ++p) points.push_back({p->right, p->left});
  points.insert(points.end(), onward.points.begin() + 1, onward.points.end());
  add_edge(points, *start, *end);
  trace_open_spokes();
}

// The path may run through a vertex just where the label changes.
std::vector<SiteRay> DiagramBuilder::generators_at(const BisectorPoint& m) const {
  std::vector<SiteRay> generators = {m.left, m.right};
  for (const SiteRay& ray : labels_.around(m.left.uv)) {
    const auto same = [&](const SiteRay& g) { return same_generator(g, ray); };
    if (std::any_of(generators.begin(), generators.end(), same)) continue;
    if (std::abs(ray.polar.s - m.radius()) <= kOneVertex * m.radius()) generators.push_back(ray);
  }
  sort_around(generators);
  return generators;
}

void DiagramBuilder::trace_open_spokes() {
  for (int v = 0; v < spokes_.count(); ++v) {
    if (spokes_.vertex(v).on_boundary) continue;
    for (int s = 0; s < static_cast<int>(spokes_.vertex(v).spokes.size()); ++s) {
      if (!spokes_.taken({v, s}) && given_up_.count({v, s}) == 0) trace_spoke({v, s}, false);
    }
  }
}

void DiagramBuilder::trace_spoke(SpokeRef start, bool on_border) {
  const Chain chain = tracer_.trace(spokes_.departure(start), on_border);
  const auto end = arrive(chain);
  if (!end || spokes_.taken(*end)) {
    given_up_.insert({start.vertex, start.spoke});
    warn("unresolved", chain.points.front(), "an edge that starts here does not fit into the diagram");
    return;
  }
  add_edge(chain.points, start, *end);
}

std::optional<SpokeRef> DiagramBuilder::arrive(const Chain& chain) {
  const BisectorPoint& last = chain.points.back();
  switch (chain.end) {
    case ChainEnd::Vertex:
      return spokes_.arrive_inside(chain.generators, last);
    case ChainEnd::Border:
      return spokes_.arrive_on_border(chain.place, last);
    case ChainEnd::Closed:
      return std::nullopt;
    case ChainEnd::Stuck:
      break;
  }
  if (last.left.site == last.right.site) {
    warn("cut_locus", last, "the cut locus of this site ends near here; its last piece is not traced");
  } else {
    warn("unresolved", last, "the border between these cells can't be followed any further");
  }
  return spokes_.arrive_at_free_end(last);
}

DiagramEdge DiagramBuilder::make_edge(const std::vector<BisectorPoint>& points) const {
  DiagramEdge edge;
  edge.left = points.front().left.site;
  edge.right = points.front().right.site;
  edge.kind = edge.left == edge.right ? EdgeKind::CutLocus : EdgeKind::Bisector;
  for (const BisectorPoint& m : points) {
    if (!edge.points.empty()) edge.length += (m.position() - edge.points.back().xyz).norm();
    const BisectorSlope d = bisector_slope(m);
    edge.points.push_back({domain_.to_principal(m.left.uv), m.position(), m.radius(), m.left.polar.t, m.right.polar.t,
                           d.radius, d.left_angle, d.right_angle});
  }
  return edge;
}

void DiagramBuilder::add_edge(const std::vector<BisectorPoint>& points, SpokeRef start, SpokeRef end) {
  DiagramEdge edge = make_edge(points);
  edge.from = start.vertex;
  edge.to = end.vertex;
  const int id = static_cast<int>(diagram_.edges.size());
  spokes_.take(start, {id, false});
  spokes_.take(end, {id, true});
  diagram_.edges.push_back(std::move(edge));
}

double default_spacing(const FaceDomain& domain, size_t sites) {
  const double per_site = std::sqrt(rough_area(domain) / static_cast<double>(std::max<size_t>(sites, 1)));
  return std::min(per_site / kNodesPerSpacing, face_size(domain) / kNodesPerDiagonal);
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
  const double tolerance = options.tolerance > 0.0 ? options.tolerance : kDefaultTolerance * face_size(domain);
  const double spacing = options.spacing > 0.0 ? options.spacing : default_spacing(domain, sites.size());
  DiagramBuilder builder(domain, sites, tolerance, spacing);
  VoronoiDiagram diagram = builder.build();
  measure_cells(domain.surface(), diagram);
  recompute_residuals(domain.surface(), diagram);
  warn_of_paths_that_leave(domain, diagram);
  return diagram;
}

}  // namespace geovor
