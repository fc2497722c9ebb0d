#include "pipeline/cell_outlines.h"

#include <algorithm>

#include "pipeline/cell_sheet.h"

namespace geovor {

std::vector<CellOutline> outlines_of_cells(const CadModel& model, const CadFace& face, const VoronoiDiagram& diagram,
                                           double deflection) {
  const FaceOutline outline(model, face, deflection);
  const CellSheet sheet = sheet_of_cells(model, outline, diagram, deflection);
  std::vector<CellOutline> out;
  if (!sheet.problem.empty()) return out;
  for (const SheetCell& cell : sheet.cells) {
    out.push_back({cell.site, {}});
    for (const auto& loop : cell.loops) {
      std::vector<Uv> polygon;
      for (LineUse use : loop) {
        std::vector<Uv> uv = sheet.lines[use.line].uv;
        if (use.reversed) std::reverse(uv.begin(), uv.end());
        polygon.insert(polygon.end(), uv.begin(), uv.end() - 1);
      }
      out.back().loops.push_back(std::move(polygon));
    }
  }
  return out;
}

CellOutline outline_of_face(const CadModel& model, const CadFace& face, double deflection) {
  const FaceOutline outline(model, face, deflection);
  CellOutline out;
  for (const OutlineSide& side : outline.sides()) {
    if (side.loop >= static_cast<int>(out.loops.size())) out.loops.emplace_back();
    std::vector<Uv> uv = side.uv;
    if (side.reversed) std::reverse(uv.begin(), uv.end());
    out.loops.back().insert(out.loops.back().end(), uv.begin(), uv.end() - 1);
  }
  return out;
}

}  // namespace geovor
