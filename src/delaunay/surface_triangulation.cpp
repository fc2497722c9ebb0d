#include "delaunay/surface_triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "geodesic/connect.h"
#include "surface/forms.h"
#include "surface/project.h"

namespace geovor {
namespace {

// Where the estimated cotangents leave the sign of their sum open: lengths that are wrong by the fifth order of a 15
// degree turn move it by less than this.
constexpr double kDoubt = 0.02;
// Two diagonals whose cotangents differ by less are equally good: points on one circle, to the noise of their places.
constexpr double kTie = 1e-7;
// A smoothed point lies nearer to the surface than this part of the size.
constexpr double kLargestDrop = 0.5;
// A point this near to an edge, in parts of the triangle, is put on the edge.
constexpr double kOnEdge = 0.02;
// The area of a triangle that is flat to rounding, in parts of its sides' squares.
constexpr double kFlat = 1e-12;
// The geodesic must agree with the estimate this well, or it is another geodesic.
constexpr double kAgreement = 0.1;
constexpr double kLengthTolerance = 1e-10;
// An edge is a fraction of a curvature radius long: where that does not settle at once, the parameterization is at
// fault, and the estimate is the better answer.
constexpr int kIterations = 10;
constexpr int kSteps = 60;

Xyz normal_of(const Xyz& a, const Xyz& b, const Xyz& c) { return (b - a).cross(c - a); }

// cot of the angle between the sides p and q of a triangle with third side r; Heron's formula in Kahan's stable order.
double cotangent(double p, double q, double r) {
  std::array<double, 3> s = {p, q, r};
  std::sort(s.begin(), s.end(), std::greater<>());
  const double product =
      (s[0] + (s[1] + s[2])) * (s[2] - (s[0] - s[1])) * (s[2] + (s[0] - s[1])) * (s[0] + (s[1] - s[2]));
  const double area4 = std::sqrt(std::max(product, 0.0));
  const double numerator = p * p + q * q - r * r;
  return numerator / std::max(area4, kFlat * (p * p + q * q));
}

}  // namespace

SurfaceTriangulation::SurfaceTriangulation(HalfEdges triangles, std::vector<MeshVertex> vertices,
                                           const SurfaceProbe& probe, const SizeRule& rule)
    : mesh_(std::move(triangles)), vertices_(std::move(vertices)), probe_(probe), rule_(rule), order_(rule.size) {}

double SurfaceTriangulation::geodesic_length(int a, int b) const {
  const double estimate = geodesic_estimate(vertices_[a], vertices_[b]);
  if (!vertices_[a].regular()) std::swap(a, b);
  const MeshVertex &from = vertices_[a], &to = vertices_[b];
  if (from.regular() && estimate > 0.0) {
    const SurfaceJet j = probe_.surface().jet(from.uv[0]);
    const UvVec d = tangent_components(j, to.x - from.x);
    const Polar guess{estimate, angle_of_direction(j, d)};
    ConnectOptions options;
    options.tolerance = kLengthTolerance;
    options.max_iterations = kIterations;
    options.max_steps = kSteps;
    options.persist = false;
    const Uv target = parameters_near(to, probe_.surface(), from.uv[0], weight());
    const Connection c = connect(probe_.surface(), from.uv[0], target, guess, options);
    if (c.status == ConnectStatus::Converged && std::abs(c.length - estimate) < kAgreement * estimate) return c.length;
  }
  ++estimates_used_;
  return estimate;
}

double SurfaceTriangulation::circumradius(int t) const {
  const auto [a, b, c] = mesh_.corners(t);
  const Xyz &p = vertices_[a].x, &q = vertices_[b].x, &r = vertices_[c].x;
  return (q - p).norm() * (r - q).norm() * (p - r).norm() / (2.0 * normal_of(p, q, r).norm());
}

Xyz SurfaceTriangulation::circumcentre(int t) const {
  const auto [a, b, c] = mesh_.corners(t);
  const Xyz p = vertices_[b].x - vertices_[a].x, q = vertices_[c].x - vertices_[a].x;
  const Xyz n = p.cross(q);
  return vertices_[a].x + (p.squaredNorm() * q.cross(n) + q.squaredNorm() * n.cross(p)) / (2.0 * n.squaredNorm());
}

// The cotangents of the two angles that face the diagonal ab of the quadrilateral a, d, b, c.
template <typename Length>
double SurfaceTriangulation::facing_cotangents(int a, int b, int c, int d, const Length& length) {
  const double ab = length(a, b);
  return cotangent(length(b, c), length(c, a), ab) + cotangent(length(a, d), length(d, b), ab);
}

bool SurfaceTriangulation::is_delaunay(int e) const {
  if (mesh_.fixed(e)) return true;
  const int a = mesh_.origin(e), b = mesh_.target(e), c = mesh_.apex(e), d = mesh_.apex(mesh_.twin(e));
  const auto estimated = [this](int p, int q) { return geodesic_estimate(vertices_[p], vertices_[q]); };
  const auto geodesic = [this](int p, int q) {
    return decide_by_geodesics_ ? geodesic_length(p, q) : geodesic_estimate(vertices_[p], vertices_[q]);
  };
  const double estimate = facing_cotangents(a, b, c, d, estimated);
  if (estimate > kDoubt) return true;
  // On a crease both diagonals can look wrong: the better one stays, or flipping would not end.
  if (estimate < -kDoubt) return facing_cotangents(c, d, a, b, estimated) <= estimate;
  const double exact = facing_cotangents(a, b, c, d, geodesic), other = facing_cotangents(c, d, a, b, geodesic);
  if (std::abs(exact) < kTie || std::abs(other - exact) < kTie) {
    const int first = std::min(
        {a, b, c, d}, [this](int p, int q) { return order_.key(vertices_[p].x) < order_.key(vertices_[q].x); });
    return first == a || first == b;
  }
  return exact >= 0.0 || other <= exact;
}

bool SurfaceTriangulation::flip_allowed(int e) const {
  if (mesh_.fixed(e)) return false;
  const int a = mesh_.origin(e), b = mesh_.target(e), c = mesh_.apex(e), d = mesh_.apex(mesh_.twin(e));
  if (c == d || mesh_.find(c, d) != HalfEdges::kNone || mesh_.find(d, c) != HalfEdges::kNone) return false;
  return upright(vertices_[d], vertices_[c], vertices_[a]) && upright(vertices_[c], vertices_[d], vertices_[b]);
}

void SurfaceTriangulation::flip_to_delaunay(std::vector<int> edges) {
  // Every flip lowers the Dirichlet energy, so this ends; the bound is for the rounding of nearly equal diagonals.
  long budget = 20L * static_cast<long>(edges.size()) + 1000;
  while (!edges.empty() && budget-- > 0) {
    const int e = edges.back();
    edges.pop_back();
    if (!mesh_.alive(e / 3) || is_delaunay(e) || !flip_allowed(e)) continue;
    const int f = mesh_.twin(e);
    mesh_.flip(e);
    for (int x : {HalfEdges::next(e), HalfEdges::prev(e), HalfEdges::next(f), HalfEdges::prev(f)}) edges.push_back(x);
  }
}

void SurfaceTriangulation::flip_all() {
  std::vector<int> edges;
  for (int e = 3 * mesh_.triangle_count() - 1; e >= 0; --e) {
    if (mesh_.alive(e / 3) && e < mesh_.twin(e)) edges.push_back(e);
  }
  flip_to_delaunay(std::move(edges));
}

int SurfaceTriangulation::locate(const Xyz& point, int t) const {
  constexpr int kMostSteps = 200;
  for (int step = 0; step < kMostSteps; ++step) {
    const auto [a, b, c] = mesh_.corners(t);
    const Xyz n = normal_of(vertices_[a].x, vertices_[b].x, vertices_[c].x);
    int go = HalfEdges::kNone;
    double worst = 0.0;
    for (int e = 3 * t; e < 3 * t + 3; ++e) {
      const double side = normal_of(vertices_[mesh_.origin(e)].x, vertices_[mesh_.target(e)].x, point).dot(n);
      if (side < worst) {
        worst = side;
        go = e;
      }
    }
    if (go == HalfEdges::kNone) return t;
    if (mesh_.fixed(go)) return HalfEdges::kNone;
    t = mesh_.twin(go) / 3;
  }
  return HalfEdges::kNone;
}

// The mean of the corners' parameters. Where no corner has its parameters to itself every copy of the first is tried.
Uv SurfaceTriangulation::reference_parameters(int t, const Xyz& point) const {
  const auto corners = mesh_.corners(t);
  const auto mean_about = [&](Uv reference) {
    UvVec sum;
    for (int v : corners)
      sum = sum + (parameters_near(vertices_[v], probe_.surface(), reference, weight()) - reference);
    return reference + (1.0 / 3.0) * sum;
  };
  for (int v : corners) {
    if (vertices_[v].regular()) return mean_about(vertices_[v].uv[0]);
  }
  Uv best = vertices_[corners[0]].uv[0];
  double best_distance = std::numeric_limits<double>::infinity();
  for (int v : corners) {
    for (Uv copy : vertices_[v].uv) {
      const Uv mean = mean_about(copy);
      const double d = (probe_.position(mean) - point).norm();
      if (d < best_distance) {
        best_distance = d;
        best = mean;
      }
    }
  }
  return best;
}

std::optional<MeshVertex> SurfaceTriangulation::drop(const Xyz& point, int t) const {
  const Uv guess = reference_parameters(t, point);
  const Projection foot = project_near(probe_.surface(), point, guess, probe_.box());
  const double reach = 0.5 * circumradius(t);
  Uv uv = foot.uv;
  if (!foot.converged || !(foot.distance < reach)) {
    uv = guess;
    if (!((probe_.position(guess) - point).norm() < reach)) return std::nullopt;
  }
  const SurfaceSample s = probe_.at(uv);
  if (!s.x.allFinite()) return std::nullopt;
  MeshVertex v{s.x, s.n, rule_.at(s.curvature), -1, {uv}, false, false};
  double bound = std::numeric_limits<double>::infinity();
  for (int c : mesh_.corners(t))
    bound = std::min(bound, vertices_[c].h + rule_.gradation * (vertices_[c].x - s.x).norm());
  v.h = std::min(v.h, bound);
  return v;
}

std::optional<SurfaceSample> SurfaceTriangulation::foot(const Xyz& point, int t) const {
  const Projection p = project_near(probe_.surface(), point, reference_parameters(t, point), probe_.box());
  if (!p.foot.allFinite()) return std::nullopt;
  return probe_.at(p.uv);
}

std::optional<MeshVertex> SurfaceTriangulation::drop_from(int v, const Xyz& point) const {
  const MeshVertex& from = vertices_[v];
  const Projection foot = project_near(probe_.surface(), point, from.uv[0], probe_.box());
  if (!foot.converged || !(foot.distance < kLargestDrop * from.h)) return std::nullopt;
  const SurfaceSample s = probe_.at(foot.uv);
  if (!s.x.allFinite() || !(s.n.squaredNorm() > 0.0)) return std::nullopt;
  return MeshVertex{s.x, s.n, from.h, -1, {foot.uv}, false, false};
}

// At the mean of the corners' parameters, where that is near.
std::optional<SurfaceSample> SurfaceTriangulation::middle(int t) const {
  const auto [a, b, c] = mesh_.corners(t);
  const Xyz centroid = (vertices_[a].x + vertices_[b].x + vertices_[c].x) / 3.0;
  const SurfaceSample s = probe_.at(reference_parameters(t, centroid));
  if ((s.x - centroid).norm() < 0.5 * circumradius(t)) return s;
  return foot(centroid, t);
}

bool SurfaceTriangulation::insert(const MeshVertex& vertex, int t) {
  const auto corners = mesh_.corners(t);
  const Xyz n = normal_of(vertices_[corners[0]].x, vertices_[corners[1]].x, vertices_[corners[2]].x);
  int on_edge = HalfEdges::kNone;
  double least = kOnEdge;
  for (int e = 3 * t; e < 3 * t + 3; ++e) {
    const double part =
        normal_of(vertices_[mesh_.origin(e)].x, vertices_[mesh_.target(e)].x, vertex.x).dot(n) / n.squaredNorm();
    if (part < least) {
      least = part;
      on_edge = e;
    }
  }
  const auto makes_upright = [&](int e) {
    return upright(vertices_[mesh_.origin(e)], vertices_[mesh_.target(e)], vertex);
  };
  std::vector<int> outer;
  if (on_edge == HalfEdges::kNone) {
    outer = {3 * t, 3 * t + 1, 3 * t + 2};
  } else {
    if (mesh_.fixed(on_edge)) return false;
    const int f = mesh_.twin(on_edge);
    outer = {HalfEdges::next(on_edge), HalfEdges::prev(on_edge), HalfEdges::next(f), HalfEdges::prev(f)};
  }
  if (!std::all_of(outer.begin(), outer.end(), makes_upright)) return false;
  const int v = mesh_.add_vertex();
  vertices_.push_back(vertex);
  if (on_edge == HalfEdges::kNone) {
    mesh_.split_triangle(t, v);
  } else {
    mesh_.split_edge(on_edge, v);
  }
  std::vector<int> edges;
  for (int e : mesh_.star(v)) {
    edges.push_back(HalfEdges::next(e));
    edges.push_back(e);
  }
  flip_to_delaunay(std::move(edges));
  return true;
}

bool SurfaceTriangulation::collapse(int e) {
  if (!mesh_.can_collapse(e)) return false;
  const int u = mesh_.origin(e), w = mesh_.target(e);
  for (int f : mesh_.star(u)) {
    if (mesh_.target(f) != w && mesh_.apex(f) != w &&
        !upright(vertices_[mesh_.target(f)], vertices_[mesh_.apex(f)], vertices_[w])) {
      return false;
    }
  }
  mesh_.collapse(e);
  std::vector<int> edges;
  for (int f : mesh_.star(w)) {
    edges.push_back(f);
    edges.push_back(HalfEdges::next(f));
  }
  flip_to_delaunay(std::move(edges));
  return true;
}

bool SurfaceTriangulation::move(int v, const MeshVertex& to) {
  for (int e : mesh_.star(v)) {
    if (!upright(vertices_[mesh_.target(e)], vertices_[mesh_.apex(e)], to)) return false;
  }
  vertices_[v] = to;
  return true;
}

}  // namespace geovor
