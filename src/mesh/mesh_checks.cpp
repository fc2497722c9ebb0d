#include "mesh/mesh_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>
#include <vector>

namespace geovor {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// One side of a triangle. Sorted by (lo, hi, forward): the uses of an edge stand together, those of one direction too.
struct Use {
  int lo, hi;
  bool forward;  ///< the triangle runs from lo to hi
  int triangle;
  bool same_edge(const Use& o) const { return lo == o.lo && hi == o.hi; }
};

std::vector<Use> sorted_uses(const TriangleMesh& mesh) {
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), a < b, t});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::tie(a.lo, a.hi, a.forward, a.triangle) < std::tie(b.lo, b.hi, b.forward, b.triangle);
  });
  return uses;
}

/// Calls visit(first, last) for the uses of every edge.
template <typename Visit>
void for_each_edge(const std::vector<Use>& uses, Visit&& visit) {
  for (auto first = uses.begin(); first != uses.end();) {
    auto last = first + 1;
    while (last != uses.end() && last->same_edge(*first)) ++last;
    visit(first, last);
    first = last;
  }
}

/// The number of sets of points that triangles connect; points that no triangle uses don't count.
int count_components(const TriangleMesh& mesh, const std::vector<char>& used) {
  std::vector<int> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  int components = static_cast<int>(std::count(used.begin(), used.end(), 1));
  for (const auto& t : mesh.triangles) {
    for (int k = 1; k < 3; ++k) {
      const int a = root(t[0]), b = root(t[k]);
      if (a == b) continue;
      parent[std::max(a, b)] = std::min(a, b);
      --components;
    }
  }
  return components;
}

/// The angle between two vectors by atan2: acos would lose half the digits near 0 and 180 degrees.
double angle(const Xyz& a, const Xyz& b) { return kDegrees * std::atan2(a.cross(b).norm(), a.dot(b)); }

struct TriangleShape {
  double smallest, largest;  ///< angles, degrees
  double area, area_rounding;
};

TriangleShape shape(const Xyz& a, const Xyz& b, const Xyz& c) {
  const double angles[] = {angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)};
  const auto [smallest, largest] = std::minmax_element(std::begin(angles), std::end(angles));
  // Each corner carries an error of half an ulp of its coordinates, which the longest side turns into area.
  const double ulp = std::numeric_limits<double>::epsilon() *
                     std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return {*smallest, *largest, 0.5 * (b - a).cross(c - a).norm(), ulp * longest};
}

void measure_edges(const TriangleMesh& mesh, MeshQuality& q) {
  std::vector<double> lengths;
  for_each_edge(sorted_uses(mesh),
                [&](auto first, auto) { lengths.push_back((mesh.points[first->hi] - mesh.points[first->lo]).norm()); });
  if (lengths.empty()) return;
  std::sort(lengths.begin(), lengths.end());
  q.shortest_edge = lengths.front();
  q.median_edge = lengths[lengths.size() / 2];
  q.longest_edge = lengths.back();
}

std::optional<std::string> fault_of_triangle(const TriangleMesh& mesh, int t) {
  const auto name = [t] { return "triangle " + std::to_string(t); };
  for (const int p : mesh.triangles[t]) {
    if (p < 0 || p >= static_cast<int>(mesh.points.size())) {
      return name() + " names point " + std::to_string(p) + " of " + std::to_string(mesh.points.size());
    }
    if (!mesh.points[p].allFinite()) return "point " + std::to_string(p) + " is not finite";
  }
  const auto& [a, b, c] = mesh.triangles[t];
  if (a == b || b == c || c == a) return name() + " has a corner twice";
  return std::nullopt;
}

}  // namespace

MeshTopology topology(const TriangleMesh& mesh) {
  MeshTopology topo;
  std::vector<char> used(mesh.points.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (const int p : t) used[p] = 1;
  }
  topo.vertices = static_cast<int>(std::count(used.begin(), used.end(), 1));
  topo.triangles = static_cast<int>(mesh.triangles.size());
  topo.components = count_components(mesh, used);
  for_each_edge(sorted_uses(mesh), [&](auto first, auto last) {
    ++topo.edges;
    const auto uses = last - first;
    if (uses == 1) ++topo.border_edges;
    if (uses > 2 || (uses == 2 && first->forward == (first + 1)->forward)) ++topo.bad_edges;
  });
  return topo;
}

MeshQuality quality(const TriangleMesh& mesh) {
  MeshQuality q;
  if (mesh.triangles.empty()) return q;
  q.smallest_angle = 180.0;
  // Volumes of tetrahedra over a point of the mesh, not over a far origin: their sum would lose digits.
  const Xyz apex = mesh.points[mesh.triangles[0][0]];
  for (const auto& t : mesh.triangles) {
    const Xyz &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const TriangleShape s = shape(a, b, c);
    q.area += s.area;
    q.volume += (a - apex).dot((b - apex).cross(c - apex)) / 6.0;
    q.smallest_angle = std::min(q.smallest_angle, s.smallest);
    q.largest_angle = std::max(q.largest_angle, s.largest);
    q.mean_smallest_angle += s.smallest;
    q.below_20 += s.smallest < 20.0;
    q.below_30 += s.smallest < 30.0;
    q.zero_area += !(s.area > s.area_rounding);
  }
  q.mean_smallest_angle /= static_cast<double>(mesh.triangles.size());
  measure_edges(mesh, q);
  return q;
}

std::optional<std::string> first_fault(const TriangleMesh& mesh) {
  if (mesh.face_of.size() != mesh.triangles.size()) {
    return "face_of has " + std::to_string(mesh.face_of.size()) + " entries for " +
           std::to_string(mesh.triangles.size()) + " triangles";
  }
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    if (auto fault = fault_of_triangle(mesh, t)) return fault;
  }
  const std::vector<Use> uses = sorted_uses(mesh);
  for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
    const Use &a = uses[i], &b = uses[i + 1];
    if (!a.same_edge(b) || a.forward != b.forward) continue;
    return "triangles " + std::to_string(a.triangle) + " and " + std::to_string(b.triangle) +
           " both run through the edge from point " + std::to_string(a.forward ? a.lo : a.hi) + " to point " +
           std::to_string(a.forward ? a.hi : a.lo);
  }
  return std::nullopt;
}

}  // namespace geovor
