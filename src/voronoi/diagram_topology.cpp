#include "voronoi/diagram_topology.h"

#include <array>

namespace geovor {
namespace {

class Inspector {
 public:
  explicit Inspector(const VoronoiDiagram& d) : d_(d), walked_(d.edges.size(), {0, 0}) {}

  std::optional<TopologyFault> first_fault() {
    if (d_.cells.size() != d_.sites.size()) return TopologyFault{"there are not as many cells as sites"};
    for (int e = 0; e < count(d_.edges); ++e)
      if (auto text = edge_fault(d_.edges[e]); !text.empty()) return TopologyFault{text, -1, e};
    for (int v = 0; v < count(d_.vertices); ++v)
      if (auto text = vertex_fault(v); !text.empty()) return TopologyFault{text, v};
    for (int c = 0; c < count(d_.cells); ++c)
      if (auto text = cell_fault(c); !text.empty()) return TopologyFault{text, -1, -1, c};
    for (int e = 0; e < count(d_.edges); ++e)
      if (walked_[e] != std::array<int, 2>{1, 1}) return TopologyFault{"not walked once in each direction", -1, e};
    return std::nullopt;
  }

 private:
  template <class T>
  static int count(const std::vector<T>& list) {
    return static_cast<int>(list.size());
  }
  bool is_site(int i) const { return i >= 0 && i < count(d_.sites); }
  bool is_vertex(int i) const { return i >= 0 && i < count(d_.vertices); }

  std::string edge_fault(const DiagramEdge& e) const {
    if (e.points.size() < 2) return "less than two points";
    if (!is_site(e.left) || !is_site(e.right)) return "no such site";
    if (e.closed() ? e.to >= 0 : !is_vertex(e.from) || !is_vertex(e.to)) return "no such vertex";
    if ((e.kind == EdgeKind::CutLocus) != (e.left == e.right)) return "its kind is not that of its sites";
    return "";
  }

  std::string vertex_fault(int i) const {
    const DiagramVertex& v = d_.vertices[i];
    // Where all rays of the only site of a closed surface meet there is a vertex by itself.
    const bool alone = v.sites.size() == 1 && d_.edges.empty();
    const std::size_t wanted = alone ? 0 : v.on_boundary ? v.sites.size() - 1 : v.sites.size();
    if (v.sites.empty() || v.angles.size() != v.sites.size()) return "sites and angles differ in number";
    if (v.spokes.size() != wanted) return "a wrong number of spokes";
    for (std::size_t k = 0; k < v.spokes.size(); ++k) {
      const Spoke s = v.spokes[k];
      if (s.edge < 0 || s.edge >= count(d_.edges)) return "an open spoke";
      const DiagramEdge& e = d_.edges[s.edge];
      if ((s.at_end ? e.to : e.from) != i) return "a spoke's edge does not end here";
      const int right = v.sites[k], left = v.sites[(k + 1) % v.sites.size()];
      if ((s.at_end ? e.left : e.right) != right || (s.at_end ? e.right : e.left) != left)
        return "a spoke's edge has other sites than the generators beside it";
    }
    return "";
  }

  /// The vertices where a piece begins and ends; -1: it closes on itself.
  std::array<int, 2> ends(const CellPiece& piece) const {
    if (piece.edge < 0) return {piece.from_vertex, piece.to_vertex};
    const DiagramEdge& e = d_.edges[piece.edge];
    return piece.reversed ? std::array<int, 2>{e.to, e.from} : std::array<int, 2>{e.from, e.to};
  }

  std::string cell_fault(int i) {
    const DiagramCell& cell = d_.cells[i];
    if (cell.site != i) return "belongs to another site";
    if (cell.loops.empty() && (d_.sites.size() > 1 || !d_.edges.empty())) return "no loops";
    for (const auto& loop : cell.loops) {
      if (loop.empty()) return "an empty loop";
      for (const CellPiece& piece : loop) {
        if (piece.edge >= count(d_.edges)) return "no such edge";
        if (piece.edge < 0 && piece.border_uv.size() < 2) return "a stretch of border without length";
        if (piece.edge < 0) continue;
        ++walked_[piece.edge][piece.reversed ? 1 : 0];
        const DiagramEdge& e = d_.edges[piece.edge];
        if ((piece.reversed ? e.right : e.left) != i) return "an edge of other cells in its loop";
      }
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const int end = ends(loop[k])[1], start = ends(loop[(k + 1) % loop.size()])[0];
        if (end != start) return "a loop that does not hold together";
        if (end < 0 && loop.size() > 1) return "a piece that closes on itself beside others in a loop";
      }
    }
    return "";
  }

  const VoronoiDiagram& d_;
  std::vector<std::array<int, 2>> walked_;
};

}  // namespace

std::optional<TopologyFault> first_topology_fault(const VoronoiDiagram& diagram) {
  return Inspector(diagram).first_fault();
}

}  // namespace geovor
