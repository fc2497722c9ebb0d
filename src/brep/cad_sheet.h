// Faces cut out of one face of a CAD model, on their way into a CAD file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/interval.h"
#include "brep/cad_curve.h"

namespace geovor {

/// A curve of the parameter plane in the form of CadCurve.
struct CadPcurve {
  int degree = 0;
  std::vector<double> knots;
  std::vector<int> multiplicities;
  std::vector<Uv> poles;
};

/// Coedge `coedge` of loop `loop` of the CadFace; -1: none.
struct CoedgeName {
  int loop = -1, coedge = -1;
};

/// Either a new curve on the surface, or a piece of an edge of the CAD face.
struct SheetEdge {
  int from = -1, to = -1;             ///< vertices, in the direction of the parameter
  CadCurve curve;                     ///< without poles: a piece of a CAD edge
  CadPcurve pcurve;                   ///< same parameter as the curve
  Interval range;                     ///< a piece of a CAD edge: of its parameter
  std::array<CoedgeName, 2> coedges;  ///< and the coedges it is a piece of: that along the CAD edge, that against it
  bool is_cad_edge() const { return curve.poles.empty(); }
};

struct SheetUse {
  int edge = -1;
  bool reversed = false;
  UvVec shift;  ///< whole periods from the edge's p-curve to the one of this use
};

struct SheetFace {
  std::string name;
  std::vector<std::vector<SheetUse>> loops;  ///< the outer one first; the face to the left
};

/// The edges are shared by the faces. A face may use a piece of a seam of the CAD face twice, once in each direction,
/// or cross it: then some of its uses are shifted.
struct CadSheet {
  std::vector<Xyz> vertices;
  std::vector<SheetEdge> edges;
  std::vector<SheetFace> faces;
  std::vector<CadCurve> curves;  ///< beside the faces: named curves of their own
};

}  // namespace geovor
