// BRepCheck's findings in plain words.
#include <BRepCheck_Analyzer.hxx>
#include <BRepCheck_ListOfStatus.hxx>
#include <BRepCheck_Result.hxx>
#include <algorithm>

#include "occ_adapter/occ_private.h"

namespace geovor::occ {
namespace {

/// Empty for what is no fault of a single face.
std::string words(BRepCheck_Status status) {
  switch (status) {
    case BRepCheck_InvalidPointOnCurve:
      return "a vertex lies off its edge by more than its tolerance";
    case BRepCheck_InvalidPointOnCurveOnSurface:
    case BRepCheck_InvalidPointOnSurface:
      return "a vertex lies off the surface by more than its tolerance";
    case BRepCheck_No3DCurve:
    case BRepCheck_Invalid3DCurve:
    case BRepCheck_Multiple3DCurve:
      return "an edge has no usable curve in space";
    case BRepCheck_NoCurveOnSurface:
      return "an edge has no curve in the parameter plane";
    case BRepCheck_InvalidCurveOnSurface:
    case BRepCheck_InvalidCurveOnClosedSurface:
    case BRepCheck_InvalidSameParameterFlag:
      return "an edge lies off the surface by more than its tolerance";
    case BRepCheck_InvalidSameRangeFlag:
    case BRepCheck_InvalidRange:
      return "an edge has a parameter range that does not fit its curve";
    case BRepCheck_InvalidDegeneratedFlag:
      return "an edge is marked as a pole and is none, or the other way round";
    case BRepCheck_EmptyWire:
      return "a border loop has no edge";
    case BRepCheck_RedundantEdge:
      return "a border loop runs through the same edge twice";
    case BRepCheck_SelfIntersectingWire:
      return "a border loop crosses itself";
    case BRepCheck_NoSurface:
      return "it has no surface";
    case BRepCheck_InvalidWire:
    case BRepCheck_NotConnected:
      return "a border loop is not connected";
    case BRepCheck_NotClosed:
      return "a border loop is open";
    case BRepCheck_RedundantWire:
      return "two border loops coincide";
    case BRepCheck_IntersectingWires:
      return "two border loops cross each other";
    case BRepCheck_InvalidImbricationOfWires:
      return "the border loops are nested in a way that bounds no region";
    case BRepCheck_UnorientableShape:
    case BRepCheck_BadOrientation:
    case BRepCheck_BadOrientationOfSubshape:
      return "the border loops run in contradictory directions";
    case BRepCheck_InvalidToleranceValue:
      return "a tolerance has no sensible value";
    case BRepCheck_CheckFail:
      return "OpenCASCADE's check of it failed";
    default:
      return {};
  }
}

void add(const BRepCheck_ListOfStatus& statuses, std::vector<std::string>& problems) {
  for (const BRepCheck_Status status : statuses) {
    const std::string text = words(status);
    if (!text.empty() && std::find(problems.begin(), problems.end(), text) == problems.end()) problems.push_back(text);
  }
}

}  // namespace

std::vector<std::string> check_face(const TopoDS_Face& face) {
  std::vector<std::string> problems;
  try {
    const BRepCheck_Analyzer analyzer(face);
    if (analyzer.IsValid()) return problems;
    add(analyzer.Result(face)->Status(), problems);
    for (const TopAbs_ShapeEnum kind : {TopAbs_WIRE, TopAbs_EDGE, TopAbs_VERTEX}) {
      for (const TopoDS_Shape& part : parts_of(face, kind)) {
        const Handle(BRepCheck_Result)& result = analyzer.Result(part);
        if (result.IsNull()) continue;
        add(result->Status(), problems);
        for (result->InitContextIterator(); result->MoreShapeInContext(); result->NextShapeInContext()) {
          add(result->StatusOnShape(), problems);
        }
      }
    }
  } catch (const Standard_Failure&) {
    problems.push_back(words(BRepCheck_CheckFail));
  }
  return problems;
}

}  // namespace geovor::occ
