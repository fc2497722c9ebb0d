#include "voronoi/border_cover.h"

#include <algorithm>
#include <cmath>

namespace geovor {
namespace {

// The lengths of the stretches of a cycle add up to a whole number of turns, but for rounding.
constexpr double kOneTurn = 0.5;

class Inspector {
 public:
  Inspector(const FaceBorder& border, const VoronoiDiagram& diagram)
      : border_(border),
        d_(diagram),
        left_(diagram.vertices.size(), 0),
        reached_(diagram.vertices.size(), 0),
        covered_(static_cast<std::size_t>(border.cycle_count()), 0.0) {}

  std::optional<TopologyFault> first_fault() {
    for (std::size_t v = 0; v < d_.vertices.size(); ++v)
      if (auto text = vertex_fault(d_.vertices[v]); !text.empty()) return TopologyFault{text, static_cast<int>(v)};
    for (const DiagramCell& cell : d_.cells)
      if (auto text = cell_fault(cell); !text.empty()) return TopologyFault{text, -1, -1, cell.site};
    for (std::size_t v = 0; v < d_.vertices.size(); ++v) {
      if (d_.vertices[v].on_boundary && (left_[v] != 1 || reached_[v] != 1))
        return TopologyFault{"the border beside it belongs to no cell, or to two", static_cast<int>(v)};
    }
    for (int c = 0; c < border_.cycle_count(); ++c) {
      if (!(std::abs(covered_[c] - border_.segment_count(c)) < kOneTurn))
        return TopologyFault{"a cycle of the face's border belongs to no cell, or to two"};
    }
    return std::nullopt;
  }

 private:
  bool is_cycle(int c) const { return c >= 0 && c < border_.cycle_count(); }

  std::string vertex_fault(const DiagramVertex& v) const {
    if (!v.on_boundary) return "";
    if (!is_cycle(v.border_cycle)) return "on a cycle that the face's border does not have";
    const bool on_it = v.border_parameter >= 0.0 && v.border_parameter <= border_.segment_count(v.border_cycle);
    return on_it ? "" : "its place on the border is not on it";
  }

  bool on_cycle(int v, int cycle) const {
    return v >= 0 && v < static_cast<int>(d_.vertices.size()) && d_.vertices[v].on_boundary &&
           d_.vertices[v].border_cycle == cycle;
  }

  std::string cell_fault(const DiagramCell& cell) {
    for (const auto& loop : cell.loops) {
      for (const CellPiece& piece : loop) {
        if (piece.edge >= 0) continue;
        if (!is_cycle(piece.border_cycle)) return "a stretch of a cycle that the face's border does not have";
        if (auto text = piece_fault(cell.site, piece); !text.empty()) return text;
      }
    }
    return "";
  }

  std::string piece_fault(int site, const CellPiece& piece) {
    const int n = border_.segment_count(piece.border_cycle);
    if (piece.from_vertex < 0 && piece.to_vertex < 0) {
      covered_[piece.border_cycle] += n;
      return polyline_fault(piece, border_.stretch({piece.border_cycle, 0.0}, {piece.border_cycle, 0.0}));
    }
    if (!on_cycle(piece.from_vertex, piece.border_cycle) || !on_cycle(piece.to_vertex, piece.border_cycle))
      return "a stretch of border between vertices that are not on it";
    const DiagramVertex &a = d_.vertices[piece.from_vertex], &b = d_.vertices[piece.to_vertex];
    if (a.sites.front() != site || b.sites.back() != site) return "a stretch of border of another cell in its loop";
    ++left_[piece.from_vertex], ++reached_[piece.to_vertex];
    if (is_point(piece)) return polyline_fault(piece, {a.uv, b.uv});
    const double way = b.border_parameter - a.border_parameter;
    covered_[piece.border_cycle] += way > 0.0 ? way : way + n;
    return polyline_fault(
        piece, border_.stretch({piece.border_cycle, a.border_parameter}, {piece.border_cycle, b.border_parameter}));
  }

  /// Between two vertices in one place. The other stretch between them is the whole cycle.
  bool is_point(const CellPiece& piece) const {
    const DiagramVertex &a = d_.vertices[piece.from_vertex], &b = d_.vertices[piece.to_vertex];
    return piece.from_vertex != piece.to_vertex && a.border_parameter == b.border_parameter &&
           piece.border_uv.size() == 2 && piece.border_uv[0] == piece.border_uv[1];
  }

  std::string polyline_fault(const CellPiece& piece, const std::vector<Uv>& wanted) const {
    if (piece.border_uv.size() != wanted.size() || piece.border_xyz.size() != wanted.size())
      return "a stretch of border with more or fewer points than the border has there";
    std::vector<Xyz> places;
    for (const Uv p : wanted) places.push_back(border_.xyz_of(p));
    double length = 0.0, off = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i > 0) length += (places[i] - places[i - 1]).norm();
      off = std::max(
          {off, (piece.border_xyz[i] - places[i]).norm(), (border_.xyz_of(piece.border_uv[i]) - places[i]).norm()});
    }
    const double rounding = kCoordinates * places.front().lpNorm<Eigen::Infinity>();
    return off <= kSameStretch * length + rounding ? "" : "a stretch of border that lies beside the face's";
  }

  static constexpr double kCoordinates = 1e-13;  ///< part of their size by which equal places may differ

  const FaceBorder& border_;
  const VoronoiDiagram& d_;
  std::vector<int> left_, reached_;
  std::vector<double> covered_;  ///< of each cycle, in segments
};

}  // namespace

std::optional<TopologyFault> first_border_fault(const FaceBorder& border, const VoronoiDiagram& diagram) {
  return Inspector(border, diagram).first_fault();
}

}  // namespace geovor
