#include <algorithm>

#include "io/face_groups.h"
#include "io/mesh_writers.h"

namespace geovor {
namespace {

constexpr int kSurface = 2;   // a dimension
constexpr int kTriangle = 2;  // Gmsh's number of the element of three nodes

/// Every node lies in one block: that of the first face that uses it.
std::vector<std::vector<int>> nodes_of(const FaceGroups& groups, const TriangleMesh& mesh) {
  std::vector<bool> seen(mesh.points.size(), false);
  std::vector<std::vector<int>> nodes(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const int t : groups.groups()[g].triangles) {
      for (const int corner : mesh.triangles[t]) {
        if (!seen[corner]) nodes[g].push_back(corner);
        seen[corner] = true;
      }
    }
    std::sort(nodes[g].begin(), nodes[g].end());
  }
  return nodes;
}

void put_point(const Xyz& p, ByteStream& out) { out << p.x() << ' ' << p.y() << ' ' << p.z(); }

void put_entities(const FaceGroups& groups, const TriangleMesh& mesh, ByteStream& out) {
  out << "$Entities\n0 0 " << groups.size() << " 0\n";
  for (const FaceGroup& group : groups) {
    Xyz lower = mesh.points[mesh.triangles[group.triangles.front()][0]], upper = lower;
    for (const int t : group.triangles) {
      for (const int corner : mesh.triangles[t]) {
        lower = lower.cwiseMin(mesh.points[corner]), upper = upper.cwiseMax(mesh.points[corner]);
      }
    }
    out << group.face << ' ';
    put_point(lower, out), out << ' ', put_point(upper, out);
    out << " 1 " << group.face << " 0\n";  // one physical group, no bounding curve
  }
  out << "$EndEntities\n";
}

void put_nodes(const FaceGroups& groups, const TriangleMesh& mesh, ByteStream& out) {
  const std::vector<std::vector<int>> nodes = nodes_of(groups, mesh);
  std::size_t count = 0;
  int first = static_cast<int>(mesh.points.size()) - 1, last = 0;
  for (const std::vector<int>& block : nodes) {
    count += block.size();
    if (!block.empty()) first = std::min(first, block.front()), last = std::max(last, block.back());
  }
  out << "$Nodes\n" << groups.size() << ' ' << count << ' ' << first + 1 << ' ' << last + 1 << '\n';
  for (std::size_t g = 0; g < groups.size(); ++g) {
    out << kSurface << ' ' << groups.groups()[g].face << " 0 " << nodes[g].size() << '\n';
    for (const int node : nodes[g]) out << node + 1 << '\n';
    for (const int node : nodes[g]) put_point(mesh.points[node], out), out << '\n';
  }
  out << "$EndNodes\n";
}

void put_elements(const FaceGroups& groups, const TriangleMesh& mesh, ByteStream& out) {
  const std::size_t count = mesh.triangles.size();
  out << "$Elements\n" << groups.size() << ' ' << count << " 1 " << count << '\n';
  std::size_t tag = 0;
  for (const FaceGroup& group : groups) {
    out << kSurface << ' ' << group.face << ' ' << kTriangle << ' ' << group.triangles.size() << '\n';
    for (const int t : group.triangles) {
      const auto& [a, b, c] = mesh.triangles[t];
      out << ++tag << ' ' << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    }
  }
  out << "$EndElements\n";
}

}  // namespace

void put_msh(const LabelledMesh& labelled, ByteStream& out) {
  const FaceGroups groups(labelled, NameAlphabet::Text);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n" << groups.size() << '\n';
  for (const FaceGroup& group : groups) out << kSurface << ' ' << group.face << " \"" << group.name << "\"\n";
  out << "$EndPhysicalNames\n";
  put_entities(groups, labelled.mesh, out);
  put_nodes(groups, labelled.mesh, out);
  put_elements(groups, labelled.mesh, out);
}

}  // namespace geovor
