#include "mesh/mesh_faults.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

namespace geovor {
namespace {

struct Use {
  int lo, hi, triangle;
  bool forward;
};

/// Sorted by edge, then by triangle. Triangles with a corner twice have no edges that count.
std::vector<Use> uses_of(const TriangleMesh& mesh) {
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const auto& c = mesh.triangles[t];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    for (int k = 0; k < 3; ++k) {
      const int a = c[k], b = c[(k + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::tie(a.lo, a.hi, a.triangle) < std::tie(b.lo, b.hi, b.triangle);
  });
  return uses;
}

template <typename Visit>
void for_each_edge(const std::vector<Use>& uses, Visit&& visit) {
  for (auto first = uses.begin(); first != uses.end();) {
    const auto last =
        std::find_if(first, uses.end(), [&](const Use& u) { return u.lo != first->lo || u.hi != first->hi; });
    visit(first, last);
    first = last;
  }
}

/// Sets of corners (3 t + k) that are joined through the edges of two triangles.
class Fans {
 public:
  explicit Fans(std::size_t triangles) : parent_(3 * triangles) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

int corner_at(const TriangleMesh& mesh, int triangle, int point) {
  const auto& c = mesh.triangles[triangle];
  return 3 * triangle + (c[0] == point ? 0 : c[1] == point ? 1 : 2);
}

// A point is pinched where its corners fall into more than one fan. At a crowded edge all triangles count as joined:
// that is said of the edge already.
std::vector<int> pinched_points(const TriangleMesh& mesh, const std::vector<Use>& uses) {
  Fans fans(mesh.triangles.size());
  for_each_edge(uses, [&](auto first, auto last) {
    for (auto next = first + 1; next != last; ++next) {
      for (const int p : {first->lo, first->hi}) {
        fans.join(corner_at(mesh, first->triangle, p), corner_at(mesh, next->triangle, p));
      }
    }
  });
  std::vector<int> fan_of(mesh.points.size(), -1), pinched;
  for (const Use& use : uses) {
    for (const int p : {use.lo, use.hi}) {
      const int fan = fans.root(corner_at(mesh, use.triangle, p));
      if (fan_of[p] < 0) fan_of[p] = fan;
      if (fan_of[p] != fan) pinched.push_back(p);
    }
  }
  std::sort(pinched.begin(), pinched.end());
  pinched.erase(std::unique(pinched.begin(), pinched.end()), pinched.end());
  return pinched;
}

bool has_no_area(const Xyz& a, const Xyz& b, const Xyz& c) {
  // Each corner carries an error of half an ulp of its coordinates, which the longest side turns into area.
  const double ulp = std::numeric_limits<double>::epsilon() *
                     std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return !(0.5 * (b - a).cross(c - a).norm() > ulp * longest);
}

double degrees_between(const Xyz& a, const Xyz& b) {
  return 180.0 / std::numbers::pi * std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

MeshFaults mesh_faults(const TriangleMesh& mesh) {
  MeshFaults faults;
  const std::vector<Use> uses = uses_of(mesh);
  for_each_edge(uses, [&](auto first, auto last) {
    const auto count = last - first;
    const bool agree = count != 2 || first->forward != (first + 1)->forward;
    if (count == 2 && agree) return;
    MeshEdge edge{first->lo, first->hi, {}};
    for (auto use = first; use != last; ++use) edge.triangles.push_back(use->triangle);
    (count == 1 ? faults.open : count > 2 ? faults.crowded : faults.disagreeing).push_back(std::move(edge));
  });
  faults.pinched = pinched_points(mesh, uses);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (has_no_area(mesh.points[a], mesh.points[b], mesh.points[c])) faults.without_area.push_back(t);
  }
  return faults;
}

std::array<double, 3> corner_angles(const TriangleMesh& mesh, int triangle) {
  std::array<double, 3> angles;
  for (int k = 0; k < 3; ++k) {
    const auto& t = mesh.triangles[triangle];
    const Xyz& a = mesh.points[t[k]];
    angles[k] = degrees_between(mesh.points[t[(k + 1) % 3]] - a, mesh.points[t[(k + 2) % 3]] - a);
  }
  return angles;
}

std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh) {
  std::vector<MeshEdge> edges;
  for_each_edge(uses_of(mesh), [&](auto first, auto last) {
    edges.push_back({first->lo, first->hi, {}});
    for (auto use = first; use != last; ++use) edges.back().triangles.push_back(use->triangle);
  });
  return edges;
}

EdgeLengths edge_lengths(const TriangleMesh& mesh) {
  EdgeLengths lengths;
  for_each_edge(uses_of(mesh), [&](auto edge, auto) {
    lengths.sorted.push_back((mesh.points[edge->hi] - mesh.points[edge->lo]).norm());
  });
  std::sort(lengths.sorted.begin(), lengths.sorted.end());
  return lengths;
}

double EdgeLengths::at(double share) const {
  if (sorted.empty()) return 0.0;
  const auto last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::clamp(std::round(share * last), 0.0, last))];
}

double EdgeLengths::mean() const {
  if (sorted.empty()) return 0.0;
  return std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
}

}  // namespace geovor
