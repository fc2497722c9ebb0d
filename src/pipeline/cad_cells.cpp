#include "pipeline/cad_cells.h"

#include <cmath>
#include <map>

#include "base/error.h"
#include "pipeline/cell_sheet.h"
#include "pipeline/edge_spline.h"
#include "pipeline/joined_cells.h"
#include "pipeline/merged_sets.h"

namespace geovor {
namespace {

// Part of the diagram's tolerance that fitting may add.
constexpr double kFitShare = 0.05;
// Curve and p-curve agree within half of what CAD programs take for one point.
constexpr double kGap = 5e-8;

/// A polyline of an edge without points that are one in space, its parameters running on across seams.
struct EdgeLine {
  std::vector<Uv> uv;
  std::vector<Xyz> xyz;
};

EdgeLine without_doubles(const std::vector<Uv>& uv, const std::vector<Xyz>& xyz) {
  EdgeLine line;
  for (size_t i = 0; i < uv.size(); ++i) {
    const bool last = i + 1 == uv.size();
    if (i > 0 && (xyz[i] - line.xyz.back()).norm() <= kGap) {
      // The ends are kept: the last one takes the place of a point that is too near to it.
      if (!last || line.uv.size() < 2) continue;
      line.uv.pop_back(), line.xyz.pop_back();
    }
    line.uv.push_back(uv[i]), line.xyz.push_back(xyz[i]);
  }
  return line;
}

EdgeLine unrolled(const Surface& surface, const DiagramEdge& edge) {
  const auto periods = [](double d, const std::optional<double>& period) {
    return period ? *period * std::round(d / *period) : 0.0;
  };
  std::vector<Uv> uv;
  std::vector<Xyz> xyz;
  for (const EdgePoint& p : edge.points) {
    Uv q = p.uv;
    if (!uv.empty()) {
      q.u -= periods(q.u - uv.back().u, surface.u_period());
      q.v -= periods(q.v - uv.back().v, surface.v_period());
    }
    uv.push_back(q), xyz.push_back(p.xyz);
  }
  return without_doubles(uv, xyz);
}

std::string name_of(const DiagramEdge& edge, size_t i) {
  const std::string number = std::to_string(i), left = std::to_string(edge.left);
  if (edge.kind == EdgeKind::CutLocus) return "cut locus " + number + " (site " + left + ")";
  return "edge " + number + " (sites " + left + " " + std::to_string(edge.right) + ")";
}

class SheetWriter {
 public:
  SheetWriter(const FaceOutline& outline, const CellSheet& cells, const SplineFit& fit)
      : outline_(outline), cells_(cells), fit_(fit) {}

  void add_faces(CadSheet& out) {
    out.vertices = cells_.vertices;
    merge_vertices();
    for (const JoinedCell& cell : joined_cells(cells_, outline_)) {
      SheetFace face;
      face.name = "site " + std::to_string(cell.site);
      for (const auto& loop : cell.loops) {
        face.loops.emplace_back();
        for (const ShiftedUse& one : loop) {
          if (is_short(cells_.lines[one.use.line])) continue;
          face.loops.back().push_back(use_of(one.use, out));
          face.loops.back().back().shift = one.shift;
        }
      }
      out.faces.push_back(std::move(face));
    }
  }

 private:
  /// One point for CAD programs: its two vertices are one, and the faces around leave it out.
  static bool is_short(const SheetLine& line) {
    return line.run >= 0 && without_doubles(line.uv, line.xyz).uv.size() < 2;
  }

  void merge_vertices() {
    vertices_.resize(static_cast<int>(cells_.vertices.size()));
    for (const SheetLine& line : cells_.lines) {
      if (is_short(line)) vertices_.merge(line.from, line.to);
    }
  }

  SheetUse use_of(LineUse use, CadSheet& out) {
    const SheetLine& line = cells_.lines[use.line];
    if (line.run < 0) return stretch(line, out);
    const auto [at, is_new] = runs_.try_emplace(use.line, static_cast<int>(out.edges.size()));
    if (is_new) out.edges.push_back(run(line));
    return {at->second, use.reversed, {}};
  }

  SheetEdge run(const SheetLine& line) const {
    const EdgeLine points = without_doubles(line.uv, line.xyz);
    SurfaceCurve spline = spline_on_surface(outline_.surface(), points.uv, points.xyz, fit_);
    SheetEdge edge;
    edge.from = vertices_.find(line.from), edge.to = vertices_.find(line.to);
    edge.curve = std::move(spline.curve), edge.pcurve = std::move(spline.pcurve);
    return edge;
  }

  /// Both sides of a seam use one edge: the parameter names it.
  SheetUse stretch(const SheetLine& line, CadSheet& out) {
    const OutlineSide& side = outline_.sides()[line.side];
    const bool reversed = line.t1 < line.t0;
    const double lo = std::min(line.t0, line.t1);
    const int first = side.partner >= 0 ? std::min(line.side, side.partner) : line.side;
    const auto [at, is_new] = stretches_.try_emplace({first, lo}, static_cast<int>(out.edges.size()));
    if (is_new) {
      SheetEdge edge;
      edge.from = vertices_.find(reversed ? line.to : line.from);
      edge.to = vertices_.find(reversed ? line.from : line.to);
      edge.range = {lo, std::max(line.t0, line.t1)};
      for (int s : {line.side, side.partner}) {
        if (s < 0) continue;
        const OutlineSide& one = outline_.sides()[s];
        edge.coedges[one.reversed] = {one.loop, one.index};
      }
      out.edges.push_back(std::move(edge));
    }
    return {at->second, reversed, {}};
  }

  const FaceOutline& outline_;
  const CellSheet& cells_;
  SplineFit fit_;
  MergedSets vertices_;
  std::map<int, int> runs_;
  std::map<std::pair<int, double>, int> stretches_;
};

}  // namespace

CadSheet cad_cells(const CadModel& model, const CadFace& face, const VoronoiDiagram& diagram, double deflection) {
  const FaceOutline outline(model, face, deflection);
  const CellSheet cells = sheet_of_cells(model, outline, diagram, deflection);
  if (!cells.problem.empty()) {
    throw Error(
        ErrorCode::FaceRejected,
        cells.problem + ", so that the cells can't be written as CAD faces; more sites, or other ones, may mend it");
  }
  const SplineFit fit{kFitShare * diagram.tolerance, kGap};
  CadSheet sheet;
  SheetWriter(outline, cells, fit).add_faces(sheet);
  for (size_t i = 0; i < diagram.edges.size(); ++i) {
    const EdgeLine line = unrolled(*face.surface, diagram.edges[i]);
    if (line.uv.size() < 2) continue;
    CadCurve curve = spline_on_surface(*face.surface, line.uv, line.xyz, fit).curve;
    curve.name = name_of(diagram.edges[i], i);
    sheet.curves.push_back(std::move(curve));
  }
  return sheet;
}

}  // namespace geovor
