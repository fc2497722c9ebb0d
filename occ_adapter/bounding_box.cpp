// The box of the true geometry. OpenCASCADE's exact box optimizes over every spline face (6 s for 255 faces), its quick
// box is that of the poles: too large, but it holds the face. A face whose quick box adds nothing needs no exact one.
#include <BRepBndLib.hxx>
#include <BRep_Tool.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>

#include "occ_adapter/occ_private.h"

namespace geovor::occ {
namespace {

/// BRepBndLib adds Precision::Confusion() here and there; growth below this is none.
constexpr double kNoGrowth = 1e-6;

Bnd_Box quick_box(const TopoDS_Shape& face) {
  Bnd_Box box;
  BRepBndLib::Add(face, box, false);
  box.SetGap(0.0);
  return box;
}

double growth(const Bnd_Box& box, const Bnd_Box& by) {
  if (by.IsVoid()) return 0.0;
  if (box.IsVoid()) return std::numeric_limits<double>::infinity();
  const gp_Pnt low = box.CornerMin(), high = box.CornerMax(), by_low = by.CornerMin(), by_high = by.CornerMax();
  double most = 0.0;
  for (int i = 1; i <= 3; ++i) {
    most = std::max({most, low.Coord(i) - by_low.Coord(i), by_high.Coord(i) - high.Coord(i)});
  }
  return most;
}

}  // namespace

Bnd_Box bounding_box(const TopoDS_Shape& shape) {
  Bnd_Box box;
  for (const TopoDS_Shape& vertex : parts_of(shape, TopAbs_VERTEX)) box.Add(BRep_Tool::Pnt(TopoDS::Vertex(vertex)));
  std::vector<std::pair<Bnd_Box, TopoDS_Shape>> faces;
  for (const TopoDS_Shape& face : parts_of(shape, TopAbs_FACE)) faces.emplace_back(quick_box(face), face);
  // The large ones first: they make most of the others needless.
  std::stable_sort(faces.begin(), faces.end(),
                   [&box](const auto& a, const auto& b) { return growth(box, a.first) > growth(box, b.first); });
  for (const auto& [quick, face] : faces) {
    if (growth(box, quick) <= kNoGrowth) continue;
    Bnd_Box exact;
    BRepBndLib::AddOptimal(face, exact, false, false);
    exact.SetGap(0.0);
    box.Add(exact);
  }
  box.SetGap(0.0);
  return box;
}

}  // namespace geovor::occ
