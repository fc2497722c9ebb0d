#include "voronoi/cells.h"

#include <algorithm>

namespace geovor {
namespace {

/// An edge with a direction of travel; the cell that it walks around is to the left.
struct Dart {
  int edge = -1;
  bool reversed = false;
  bool valid() const { return edge >= 0; }
};

class CellWalker {
 public:
  CellWalker(const FaceBorder& border, VoronoiDiagram& diagram)
      : border_(border),
        diagram_(diagram),
        walked_(diagram.edges.size(), {false, false}),
        on_cycle_(border.cycle_count()),
        next_(diagram.vertices.size(), -1) {
    for (int v = 0; v < static_cast<int>(diagram.vertices.size()); ++v) {
      if (diagram.vertices[v].on_boundary) on_cycle_[diagram.vertices[v].border_cycle].push_back(v);
    }
    for (auto& list : on_cycle_) {
      std::stable_sort(list.begin(), list.end(), [&](int a, int b) {
        return diagram.vertices[a].border_parameter < diagram.vertices[b].border_parameter;
      });
      for (size_t i = 0; i < list.size(); ++i) next_[list[i]] = list[(i + 1) % list.size()];
    }
  }

  void walk_all() {
    for (int e = 0; e < static_cast<int>(diagram_.edges.size()); ++e) {
      for (bool reversed : {false, true}) {
        if (!walked_[e][reversed]) walk({e, reversed});
      }
    }
  }

  bool untouched(int cycle) const { return on_cycle_[cycle].empty(); }

  CellPiece border_piece(int cycle, int from, int to) const {
    const auto place = [&](int v) {
      return v < 0 ? BorderPlace{cycle, 0.0} : BorderPlace{cycle, diagram_.vertices[v].border_parameter};
    };
    CellPiece piece;
    piece.from_vertex = from, piece.to_vertex = to, piece.border_cycle = cycle;
    piece.border_uv =
        is_point(from, to) ? std::vector<Uv>(2, diagram_.vertices[from].uv) : border_.stretch(place(from), place(to));
    for (Uv p : piece.border_uv) piece.border_xyz.push_back(border_.xyz_of(p));
    return piece;
  }

 private:
  int cell_of(Dart d) const { return d.reversed ? diagram_.edges[d.edge].right : diagram_.edges[d.edge].left; }
  int end_of(Dart d) const { return d.reversed ? diagram_.edges[d.edge].from : diagram_.edges[d.edge].to; }
  static Dart leave(const Spoke& spoke) { return {spoke.edge, spoke.at_end}; }

  void walk(Dart start) {
    const int site = cell_of(start);
    std::vector<CellPiece> loop;
    Dart d = start;
    do {
      walked_[d.edge][d.reversed] = true;
      CellPiece piece;
      piece.edge = d.edge, piece.reversed = d.reversed;
      loop.push_back(piece);
      if (!diagram_.edges[d.edge].closed()) d = next(d, loop);
      if (!d.valid() || cell_of(d) != site) {
        give_up(site);
        return;
      }
    } while (!walked_[d.edge][d.reversed]);
    if (d.edge != start.edge || d.reversed != start.reversed) {
      give_up(site);
      return;
    }
    diagram_.cells[site].loops.push_back(std::move(loop));
  }

  // The spoke by which the walk arrives has its cell to the right, seen from the vertex; the next edge of the cell is
  // the spoke before it. On the border the first spoke has none before it: the border follows.
  Dart next(Dart d, std::vector<CellPiece>& loop) {
    const int v = end_of(d);
    const DiagramVertex& vertex = diagram_.vertices[v];
    const auto arrived = std::find_if(vertex.spokes.begin(), vertex.spokes.end(),
                                      [&](const Spoke& s) { return s.edge == d.edge && s.at_end == !d.reversed; });
    if (arrived == vertex.spokes.end()) return {};
    if (arrived != vertex.spokes.begin()) return leave(*(arrived - 1));
    if (!vertex.on_boundary) return leave(vertex.spokes.back());
    const int other = next_[v];
    loop.push_back(border_piece(vertex.border_cycle, v, other));
    return leave(diagram_.vertices[other].spokes.back());
  }

  /// Two vertices in one place: between the first and the last of them, around the cycle, lies all of it.
  bool is_point(int from, int to) const {
    if (from < 0 || from == to) return false;
    const DiagramVertex &a = diagram_.vertices[from], &b = diagram_.vertices[to];
    return a.border_parameter == b.border_parameter && on_cycle_[a.border_cycle].front() != to;
  }

  void give_up(int site) {
    diagram_.warnings.push_back({"unresolved",
                                 {site},
                                 diagram_.sites[site].uv,
                                 "the border of this cell does not close; its loop is left out"});
  }

  const FaceBorder& border_;
  VoronoiDiagram& diagram_;
  std::vector<std::array<bool, 2>> walked_;
  std::vector<std::vector<int>> on_cycle_;  ///< vertices along each cycle
  std::vector<int> next_;                   ///< vertex on the border: the one that follows it
};

double length(const std::vector<CellPiece>& loop, const VoronoiDiagram& diagram) {
  double sum = 0.0;
  for (const CellPiece& piece : loop) {
    if (piece.edge >= 0) sum += diagram.edges[piece.edge].length;
    for (size_t i = 1; i < piece.border_xyz.size(); ++i) sum += (piece.border_xyz[i] - piece.border_xyz[i - 1]).norm();
  }
  return sum;
}

void sort_by_length(DiagramCell& cell, const VoronoiDiagram& diagram) {
  std::vector<std::pair<double, size_t>> order;
  for (size_t i = 0; i < cell.loops.size(); ++i) order.push_back({-length(cell.loops[i], diagram), i});
  std::sort(order.begin(), order.end());
  std::vector<std::vector<CellPiece>> sorted;
  for (const auto& [minus_length, i] : order) sorted.push_back(std::move(cell.loops[i]));
  cell.loops = std::move(sorted);
}

}  // namespace

void assemble_cells(const FaceBorder& border, const std::function<int(int cycle)>& cycle_owner,
                    VoronoiDiagram& diagram) {
  diagram.cells.resize(diagram.sites.size());
  for (int i = 0; i < static_cast<int>(diagram.cells.size()); ++i) diagram.cells[i].site = i;
  CellWalker walker(border, diagram);
  walker.walk_all();
  for (int cycle = 0; cycle < border.cycle_count() && !diagram.sites.empty(); ++cycle) {
    const int owner = walker.untouched(cycle) ? cycle_owner(cycle) : -1;
    if (owner >= 0) diagram.cells[owner].loops.push_back({walker.border_piece(cycle, -1, -1)});
  }
  for (DiagramCell& cell : diagram.cells) {
    if (cell.loops.size() > 1) sort_by_length(cell, diagram);
  }
}

}  // namespace geovor
