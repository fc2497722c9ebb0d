#include "mesh/mesh_shells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <tuple>

namespace geovor {
namespace {

/// Disjoint sets of triangles; the root of a set is its first triangle.
class Sets {
 public:
  explicit Sets(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0); }

  int root(int i) {
    while (up_[i] != i) {
      up_[i] = up_[up_[i]];
      i = up_[i];
    }
    return i;
  }

  void join(int i, int j) {
    i = root(i), j = root(j);
    up_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int> up_;
};

double six_volumes(const TriangleMesh& mesh, const std::vector<int>& triangles) {
  // From a point of the shell, so that a shell far from the origin keeps its digits.
  const Xyz origin = mesh.points[mesh.triangles[triangles.front()][0]];
  double sum = 0.0;
  for (const int t : triangles) {
    const auto& [a, b, c] = mesh.triangles[t];
    sum += (mesh.points[a] - origin).dot((mesh.points[b] - origin).cross(mesh.points[c] - origin));
  }
  return sum;
}

}  // namespace

SharedEdges shared_edges(const TriangleMesh& mesh) {
  // All uses sorted by their ends: equal ones are one edge, numbered afterwards by its first use.
  struct Side {
    int low, high;
    std::size_t use;  // 3 * triangle + corner
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      sides.push_back({low, high, 3 * t + k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.use) < std::tie(b.low, b.high, b.use);
  });
  std::vector<std::size_t> first_use(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool same = i > 0 && sides[i].low == sides[i - 1].low && sides[i].high == sides[i - 1].high;
    first_use[sides[i].use] = same ? first_use[sides[i - 1].use] : sides[i].use;
  }
  SharedEdges edges;
  edges.uses.resize(mesh.triangles.size());
  for (std::size_t use = 0; use < first_use.size(); ++use) {
    const std::array<int, 3>& corners = mesh.triangles[use / 3];
    const int from = corners[use % 3], to = corners[(use % 3 + 1) % 3];
    EdgeUse& out = edges.uses[use / 3][use % 3];
    if (first_use[use] == use) {
      out = {static_cast<int>(edges.ends.size()), false};
      edges.ends.push_back({from, to});
    } else {
      out.edge = edges.uses[first_use[use] / 3][first_use[use] % 3].edge;
      out.reversed = edges.ends[out.edge][0] != from;
    }
  }
  return edges;
}

std::vector<MeshShell> shells_of(const TriangleMesh& mesh, const SharedEdges& edges) {
  std::vector<int> owner(edges.ends.size(), -1), along(edges.ends.size(), 0), against(edges.ends.size(), 0);
  Sets sets(mesh.triangles.size());
  for (std::size_t t = 0; t < edges.uses.size(); ++t) {
    for (const EdgeUse& use : edges.uses[t]) {
      if (owner[use.edge] < 0) owner[use.edge] = static_cast<int>(t);
      sets.join(owner[use.edge], static_cast<int>(t));
      ++(use.reversed ? against : along)[use.edge];
    }
  }
  std::vector<int> shell_of(mesh.triangles.size(), -1);
  std::vector<MeshShell> shells;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    int& shell = shell_of[sets.root(t)];
    if (shell < 0) {
      shell = static_cast<int>(shells.size());
      shells.push_back({{}, true, 0.0});
    }
    shells[shell].triangles.push_back(t);
  }
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    if (along[e] != 1 || against[e] != 1) shells[shell_of[sets.root(owner[e])]].closed = false;
  }
  for (MeshShell& shell : shells) {
    if (shell.closed) shell.volume = six_volumes(mesh, shell.triangles) / 6.0;
  }
  return shells;
}

bool is_flat(const TriangleMesh& mesh, int triangle) {
  constexpr double kLeastSine = 1e-13;  // some hundred roundings: below it the plane of the triangle is noise
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Xyz ab = mesh.points[b] - mesh.points[a], ac = mesh.points[c] - mesh.points[a];
  return !(ab.cross(ac).norm() > kLeastSine * ab.norm() * ac.norm());
}

}  // namespace geovor
