#include "voronoi/dual_checks.h"

#include <algorithm>
#include <set>

namespace geovor {
namespace {

std::string number(int i) { return std::to_string(i); }
std::string cell_of(int i) { return "the cell of site " + number(i); }
std::string pair_of(int a, int b) { return "sites " + number(std::min(a, b)) + " and " + number(std::max(a, b)); }

/// Stretches of the face's border that the cell holds.
int border_pieces(const DiagramCell& cell) {
  int count = 0;
  for (const auto& loop : cell.loops) {
    for (const CellPiece& piece : loop) count += piece.edge < 0 ? 1 : 0;
  }
  return count;
}

std::string fault_of(const VoronoiDiagram& diagram, const DiagramCell& cell) {
  if (cell.loops.empty()) return cell_of(cell.site) + " is the whole closed surface";
  const int euler = euler_number(diagram, cell);
  if (euler > 1) return cell_of(cell.site) + " covers the whole closed surface, and meets itself";
  if (euler < 1) return cell_of(cell.site) + " is no disk: it runs around something, or touches itself";
  if (border_pieces(cell) > 1) {
    return cell_of(cell.site) + " has " + number(border_pieces(cell)) + " pieces of the border of the face";
  }
  return "";
}

std::string fault_of_cells(const VoronoiDiagram& diagram) {
  for (const DiagramCell& cell : diagram.cells) {
    if (const std::string fault = fault_of(diagram, cell); !fault.empty()) return fault;
  }
  for (const DiagramEdge& e : diagram.edges) {
    if (e.kind == EdgeKind::CutLocus) return cell_of(e.left) + " meets itself: its dual edge is a loop";
  }
  for (const DiagramVertex& v : diagram.vertices) {
    if (v.sites.size() == 1) return "a vertex has one generator, of site " + number(v.sites[0]);
  }
  return "";
}

std::string fault_of_edges(const DualGraph& dual) {
  std::set<std::pair<int, int>> pairs, sides;
  for (const DualEdge& e : dual.edges) {
    if (!pairs.insert(std::minmax(e.a, e.b)).second)
      return "the cells of " + pair_of(e.a, e.b) + " meet more than once";
  }
  for (const auto& t : dual.triangles) {
    for (int k = 0; k < 3; ++k) sides.insert(std::minmax(t[k], t[(k + 1) % 3]));
  }
  for (const DualEdge& e : dual.edges) {
    if (sides.count(std::minmax(e.a, e.b)) == 0) return "the edge between " + pair_of(e.a, e.b) + " has no triangle";
  }
  return "";
}

std::string fault_of_triangles(const DualGraph& dual) {
  std::set<std::array<int, 3>> corners;
  for (auto t : dual.triangles) {
    std::sort(t.begin(), t.end());
    if (corners.insert(t).second) continue;
    return "the cells of sites " + number(t[0]) + ", " + number(t[1]) + " and " + number(t[2]) +
           " meet in more than one vertex";
  }
  return "";
}

}  // namespace

// A loop that is one closed edge, or a whole cycle of the border, has as many vertices as edges: none count. The cell's
// inside, cut open along its loops, is a disk with a hole for every loop beyond the first.
int euler_number(const VoronoiDiagram& diagram, const DiagramCell& cell) {
  if (cell.loops.empty()) return 2;
  std::set<int> vertices, edges;
  int stretches = 0;
  for (const auto& loop : cell.loops) {
    for (const CellPiece& piece : loop) {
      const bool border = piece.edge < 0;
      const int from = border ? piece.from_vertex : diagram.edges[piece.edge].from;
      if (from < 0) continue;
      vertices.insert({from, border ? piece.to_vertex : diagram.edges[piece.edge].to});
      if (border) {
        ++stretches;
      } else {
        edges.insert(piece.edge);
      }
    }
  }
  const int loops = static_cast<int>(cell.loops.size());
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) - stretches + 2 - loops;
}

std::string why_no_triangulation(const VoronoiDiagram& diagram, const DualGraph& dual) {
  if (diagram.sites.size() < 3) return "there are fewer than three sites";
  for (const DiagramWarning& w : diagram.warnings) {
    if (w.kind == "unresolved") return "a part of the diagram is unresolved";
  }
  if (std::string fault = fault_of_cells(diagram); !fault.empty()) return fault;
  if (dual.triangles.empty()) return "no three cells meet";
  if (std::string fault = fault_of_edges(dual); !fault.empty()) return fault;
  return fault_of_triangles(dual);
}

}  // namespace geovor
