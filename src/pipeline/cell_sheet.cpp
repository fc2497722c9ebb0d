#include "pipeline/cell_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "pipeline/merged_sets.h"
#include "pipeline/sheet_nodes.h"

// The lines and the outline make a planar map of the parameter plane. Around a node inside the face the runs stand as
// the diagram's vertex has them; around one on the outline they stand between the stretch that leaves and the one that
// arrives, ordered by their angles. A walk with the face to the left takes, wherever it arrives, the neighbour
// clockwise.

namespace geovor {
namespace {

// What lies within this part of the model's size of a seam or a pole lies on it: rounding of the diagram.
constexpr double kSnap = 1e-9;

struct Spoke2 {
  int line = -1;
  bool at_end = false;
  double order = 0.0;
};

struct WalkedLoop {
  std::vector<LineUse> uses;
  int site = -1;
  double area = 0.0;  ///< signed, of the parameter plane
  std::vector<Uv> polygon;
};

double signed_area(const std::vector<Uv>& polygon) {
  double twice = 0.0;
  for (size_t i = 0, n = polygon.size(); i < n; ++i) {
    twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % n] - polygon[0]);
  }
  return 0.5 * twice;
}

bool holds(const std::vector<Uv>& polygon, Uv p) {
  bool inside = false;
  for (size_t i = 0, n = polygon.size(); i < n; ++i) {
    const Uv a = polygon[i], b = polygon[(i + 1) % n];
    if ((a.v > p.v) == (b.v > p.v)) continue;
    if (p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
  }
  return inside;
}

class SheetBuilder {
 public:
  SheetBuilder(const CadModel& model, const FaceOutline& outline, const VoronoiDiagram& diagram, double deflection)
      : outline_(outline), diagram_(diagram), nodes_(model, outline, deflection) {
    constexpr double kReach = 4.0;  // deflections between the diagram's border and the outline
    runs_ = cut_edges(outline, diagram, kSnap * model.diagonal(), kReach * deflection);
  }

  CellSheet build() {
    place_nodes();
    add_stretches();
    add_runs();
    sort_spokes();
    walk_all();
    assign_holes();
    for (int i = 0; i < nodes_.vertices().count(); ++i) sheet_.vertices.push_back(nodes_.vertices().at(i));
    std::stable_sort(sheet_.cells.begin(), sheet_.cells.end(),
                     [](const SheetCell& a, const SheetCell& b) { return a.site < b.site; });
    return std::move(sheet_);
  }

 private:
  int vertex_of(const RunEnd& end, const DiagramEdge& edge, const Xyz& x) {
    if (end.vertex >= 0) return nodes_.diagram_vertex(end.vertex, diagram_.vertices[end.vertex].xyz);
    // An edge that closes on itself inside the face gets a vertex of its own, beyond those of the diagram.
    const int own = static_cast<int>(diagram_.vertices.size() + (&edge - diagram_.edges.data()));
    return end.side < 0 ? nodes_.diagram_vertex(own, x) : -1;
  }

  void place_nodes() {
    for (const EdgeRun& run : runs_.runs) {
      const DiagramEdge& edge = diagram_.edges[run.edge];
      if (run.from.side >= 0) nodes_.add_place(run.from.side, run.from.t, vertex_of(run.from, edge, run.xyz.front()));
      if (run.to.side >= 0) nodes_.add_place(run.to.side, run.to.t, vertex_of(run.to, edge, run.xyz.back()));
    }
    for (const SeamRun& run : runs_.in_seams) {
      const DiagramEdge& edge = diagram_.edges[run.edge];
      nodes_.add_place(run.from.side, run.from.t, vertex_of(run.from, edge, {}));
      nodes_.add_place(run.to.side, run.to.t, vertex_of(run.to, edge, {}));
    }
    nodes_.settle();
    spokes_.resize(nodes_.count());
    leaving_.assign(nodes_.count(), -1);
    on_outline_ = nodes_.count();
  }

  void add_stretches() {
    for (int i = 0; i < static_cast<int>(outline_.sides().size()); ++i) {
      const OutlineSide& side = outline_.sides()[i];
      const auto& places = nodes_.places(i);
      const int last = static_cast<int>(places.size()) - 1;
      for (int step = 0; step < last; ++step) {
        const int k0 = side.reversed ? last - step : step, k1 = side.reversed ? k0 - 1 : k0 + 1;
        SheetLine line;
        line.side = i, line.t0 = places[k0], line.t1 = places[k1];
        line.uv = outline_.between(i, line.t0, line.t1);
        line.uv.insert(line.uv.begin(), side.at(line.t0));
        line.uv.push_back(side.at(line.t1));
        for (Uv p : line.uv) line.xyz.push_back(outline_.surface().position(p));
        const int from = nodes_.node_at(i, k0), to = nodes_.node_at(i, k1);
        leaving_[from] = static_cast<int>(sheet_.lines.size());
        add_line(std::move(line), from, to, -1, -1);
      }
    }
    for (const SeamRun& run : runs_.in_seams) label_seam(run);
  }

  /// The stretches between the run's ends divide its edge's cells: that to the left lies on the side that runs with it.
  void label_seam(const SeamRun& run) {
    const DiagramEdge& edge = diagram_.edges[run.edge];
    const bool ascends = run.to.t > run.from.t;
    const double lo = std::min(run.from.t, run.to.t), hi = std::max(run.from.t, run.to.t);
    for (size_t i = 0; i < sheet_.lines.size(); ++i) {
      const SheetLine& line = sheet_.lines[i];
      if (line.side != run.from.side && line.side != outline_.sides()[run.from.side].partner) continue;
      const double middle = 0.5 * (line.t0 + line.t1);
      if (middle > lo && middle < hi) left_[i] = (line.t1 > line.t0) == ascends ? edge.left : edge.right;
    }
  }

  int node_of(const RunEnd& end, const DiagramEdge& edge, const Xyz& x) {
    if (end.side >= 0) return nodes_.node(end.side, end.t);
    const int vertex = vertex_of(end, edge, x);
    const auto [at, is_new] = inner_nodes_.try_emplace(vertex, static_cast<int>(spokes_.size()));
    if (is_new) spokes_.emplace_back(), leaving_.push_back(-1), inner_vertex_.push_back(vertex);
    return at->second;
  }

  int vertex_at(int node) const {
    return node < on_outline_ ? nodes_.vertex_of(node) : nodes_.vertices().find(inner_vertex_[node - on_outline_]);
  }

  void add_line(SheetLine line, int from, int to, int left, int right) {
    line.from = vertex_at(from), line.to = vertex_at(to);
    sheet_.lines.push_back(std::move(line));
    from_.push_back(from), to_.push_back(to), left_.push_back(left), right_.push_back(right);
  }

  void add_runs() {
    for (const EdgeRun& run : runs_.runs) {
      const DiagramEdge& edge = diagram_.edges[run.edge];
      const int from = node_of(run.from, edge, run.xyz.front()), to = node_of(run.to, edge, run.xyz.back());
      SheetLine line;
      line.run = run.edge, line.uv = run.uv, line.xyz = run.xyz;
      const int index = static_cast<int>(sheet_.lines.size());
      for (bool at_end : {false, true}) {
        const RunEnd& end = at_end ? run.to : run.from;
        spokes_[at_end ? to : from].push_back({index, at_end, order_of(end, run, at_end)});
      }
      add_line(std::move(line), from, to, edge.left, edge.right);
    }
  }

  /// Where the run stands around its node: as the diagram's vertex says, else (on a seam or a pole) by its angle.
  double order_of(const RunEnd& end, const EdgeRun& run, bool at_end) const {
    const bool on_seam = end.side >= 0 && FaceOutline::kind(outline_.sides()[end.side]) != SideKind::Border;
    if (end.vertex < 0 && !on_seam) return at_end;
    if (!on_seam) {
      const auto& spokes = diagram_.vertices[end.vertex].spokes;
      const auto same = [&](const Spoke& s) { return s.edge == run.edge && s.at_end == at_end; };
      return static_cast<double>(std::find_if(spokes.begin(), spokes.end(), same) - spokes.begin());
    }
    const OutlineSide& side = outline_.sides()[end.side];
    const size_t n = run.uv.size();
    const UvVec way = at_end ? run.uv[n - 2] - run.uv[n - 1] : run.uv[1] - run.uv[0];
    const Uv a = side.uv.front(), b = side.uv.back();
    const UvVec along = side.reversed ? a - b : b - a;
    const double su = 1.0 / outline_.box().u.length(), sv = 1.0 / outline_.box().v.length();
    const double angle = std::atan2(way.v * sv, way.u * su) - std::atan2(along.v * sv, along.u * su);
    return angle - 2.0 * std::numbers::pi * std::floor(angle / (2.0 * std::numbers::pi));
  }

  void sort_spokes() {
    for (auto& list : spokes_) {
      std::stable_sort(list.begin(), list.end(), [](const Spoke2& a, const Spoke2& b) { return a.order < b.order; });
    }
  }

  std::optional<LineUse> next(LineUse use) const {
    const int node = use.reversed ? from_[use.line] : to_[use.line];
    const auto& list = spokes_[node];
    const auto leave = [](const Spoke2& s) { return LineUse{s.line, s.at_end}; };
    const bool outline = leaving_[node] >= 0;
    if (sheet_.lines[use.line].run < 0) return list.empty() ? LineUse{leaving_[node], false} : leave(list.back());
    const auto here = std::find_if(list.begin(), list.end(),
                                   [&](const Spoke2& s) { return s.line == use.line && s.at_end == !use.reversed; });
    if (here == list.end() || (!outline && list.size() < 2)) return std::nullopt;
    if (here != list.begin()) return leave(*(here - 1));
    return outline ? LineUse{leaving_[node], false} : leave(list.back());
  }

  void walk_all() {
    std::array<std::vector<char>, 2> walked;
    for (auto& w : walked) w.assign(sheet_.lines.size(), 0);
    for (int i = 0; i < static_cast<int>(sheet_.lines.size()); ++i) {
      for (bool reversed : {false, true}) {
        if (walked[reversed][i] || (reversed && sheet_.lines[i].run < 0)) continue;
        WalkedLoop loop;
        std::optional<LineUse> use = LineUse{i, reversed};
        while (use && !walked[use->reversed][use->line]) {
          walked[use->reversed][use->line] = 1;
          append(*use, loop);
          use = next(*use);
        }
        const bool closed = use && use->line == i && use->reversed == reversed;
        if (!closed) give_up("the edges around the cell of site " + std::to_string(loop.site) + " do not close");
        loop.area = signed_area(loop.polygon);
        if (closed) loops_.push_back(std::move(loop));
      }
    }
  }

  void append(LineUse use, WalkedLoop& loop) {
    const int site = use.reversed ? right_[use.line] : left_[use.line];
    if (site >= 0 && loop.site >= 0 && loop.site != site) {
      give_up("nothing divides the cells of sites " + std::to_string(std::min(site, loop.site)) + " and " +
              std::to_string(std::max(site, loop.site)));
    }
    if (site >= 0) loop.site = site;
    loop.uses.push_back(use);
    std::vector<Uv> uv = sheet_.lines[use.line].uv;
    if (use.reversed) std::reverse(uv.begin(), uv.end());
    loop.polygon.insert(loop.polygon.end(), uv.begin(), uv.end() - 1);
  }

  static std::string place_of(const WalkedLoop& loop) {
    char text[80];
    const Uv p = loop.polygon.front();
    std::snprintf(text, sizeof text, " (near u = %.6g, v = %.6g)", p.u, p.v);
    return text;
  }

  void give_up(const std::string& why) {
    if (sheet_.problem.empty()) sheet_.problem = why;
  }

  /// Which lines hang together: the walks along the outside of such a part run clockwise, and lie in a cell of
  /// another part. (An island's border, a closed edge, is walked both ways: once around the island's cell and once as
  /// the hole of the cell around it.)
  void find_parts() {
    parts_.resize(static_cast<int>(spokes_.size()));
    for (size_t i = 0; i < from_.size(); ++i) parts_.merge(from_[i], to_[i]);
  }

  int part_of(const WalkedLoop& loop) const { return parts_.find(from_[loop.uses.front().line]); }

  /// A hole belongs to the smallest loop of another part that is around it.
  void assign_holes() {
    find_parts();
    std::vector<int> outer;
    for (int i = 0; i < static_cast<int>(loops_.size()); ++i) {
      if (loops_[i].area > 0.0) outer.push_back(i);
    }
    std::vector<SheetCell> cells(loops_.size());
    for (int i : outer) cells[i].loops.push_back(loops_[i].uses), cells[i].site = loops_[i].site;
    for (const WalkedLoop& hole : loops_) {
      if (hole.area > 0.0) continue;
      int best = -1;
      for (int i : outer) {
        if (best >= 0 && loops_[i].area >= loops_[best].area) continue;
        if (part_of(loops_[i]) == part_of(hole)) continue;
        if (mostly_inside(loops_[i].polygon, hole.polygon)) best = i;
      }
      if (best < 0) {
        give_up("a part of the border lies in no cell" + place_of(hole));
        continue;
      }
      cells[best].loops.push_back(hole.uses);
      if (cells[best].site < 0) cells[best].site = hole.site;
      if (hole.site >= 0 && hole.site != cells[best].site) {
        give_up("the cell of site " + std::to_string(hole.site) + " lies in that of site " +
                std::to_string(cells[best].site) + ", and no edge divides them");
      }
    }
    for (int i : outer) {
      if (cells[i].site < 0) cells[i].site = owner_of_border(loops_[i]);
      if (cells[i].site < 0)
        give_up("a part of the face belongs to no cell" + place_of(loops_[i]));
      else
        sheet_.cells.push_back(std::move(cells[i]));
    }
  }

  /// Parts may touch up to rounding, so one point does not tell.
  static bool mostly_inside(const std::vector<Uv>& outer, const std::vector<Uv>& inner) {
    const auto count = std::count_if(inner.begin(), inner.end(), [&](Uv p) { return holds(outer, p); });
    return 2 * static_cast<size_t>(count) > inner.size();
  }

  /// A loop on which no edge ends: the diagram knows the cell that has that cycle of the border.
  int owner_of_border(const WalkedLoop& loop) const {
    if (diagram_.sites.size() == 1) return 0;
    const Xyz x = outline_.surface().position(loop.polygon.front());
    int owner = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const DiagramCell& cell : diagram_.cells) {
      for (const auto& pieces : cell.loops) {
        for (const CellPiece& piece : pieces) {
          if (piece.edge >= 0 || piece.from_vertex >= 0) continue;
          for (const Xyz& y : piece.border_xyz) {
            if ((y - x).norm() < least) least = (y - x).norm(), owner = cell.site;
          }
        }
      }
    }
    return owner;
  }

  const FaceOutline& outline_;
  const VoronoiDiagram& diagram_;
  SheetNodes nodes_;
  EdgeRuns runs_;
  CellSheet sheet_;
  int on_outline_ = 0;  ///< nodes below this number lie on the outline
  std::map<int, int> inner_nodes_;
  std::vector<int> inner_vertex_;
  std::vector<std::vector<Spoke2>> spokes_;    ///< of a node
  std::vector<int> leaving_;                   ///< of a node on the outline: the stretch that leaves it
  std::vector<int> from_, to_, left_, right_;  ///< of a line: nodes, sites
  MergedSets parts_;                           ///< nodes that lines join
  std::vector<WalkedLoop> loops_;
};

}  // namespace

CellSheet sheet_of_cells(const CadModel& model, const FaceOutline& outline, const VoronoiDiagram& diagram,
                         double deflection) {
  return SheetBuilder(model, outline, diagram, deflection).build();
}

}  // namespace geovor
