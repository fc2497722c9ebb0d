// A CAD model as geovor sees it: surfaces cut by loops of edges, the edges shared between faces.
// Plain data; who reads files fills it in (occ_adapter), who meshes reads it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/xyz.h"
#include "surface/curve.h"
#include "surface/surface.h"

namespace geovor {

struct CadVertex {
  Xyz position;
  double tolerance = 0.0;
};

/// An edge of the CAD: a piece of a space curve, used by any number of faces.
struct CadEdge {
  Curve3Ptr curve;         ///< null for a degenerated edge (a pole: its p-curve has length, the edge has none)
  Interval range;          ///< the piece of `curve`
  int first_vertex = -1;   ///< vertex at range.lo, index into CadModel::vertices; -1: none known
  int last_vertex = -1;    ///< vertex at range.hi
  double tolerance = 0.0;  ///< the CAD's promise: curve and surfaces lie within this distance
  bool degenerate() const { return curve == nullptr; }
};

/// One use of an edge by a face.
struct Coedge {
  int edge = -1;          ///< index into CadModel::edges
  Curve2Ptr pcurve;       ///< the edge in the face's parameter plane; pcurve(t) belongs to curve(t), same t
  Interval range;         ///< of the p-curve; equals the edge's range where that is not degenerate
  bool reversed = false;  ///< the loop runs through the edge from range.hi to range.lo
};

/// A closed chain of coedges in the order of travel, with the material of the face on the left in the parameter
/// plane (u to the right, v up): outer loops turn counter-clockwise, holes clockwise.
struct TrimLoop {
  std::vector<Coedge> coedges;
};

struct Colour {
  double r = 0, g = 0, b = 0;  ///< 0 … 1, linear
};

/// A face: a piece of a surface. On a closed surface the loops run along the seam (its edge is used twice, with two
/// p-curves) and along the poles (degenerated edges), so that in the parameter plane they always bound a region.
struct CadFace {
  int number = 0;    ///< FreeCAD's FaceN, from 1
  std::string name;  ///< the file's name of the face, may be empty
  std::optional<Colour> colour;
  SurfacePtr surface;  ///< null where the surface can't be used; `problems` then says why
  std::vector<TrimLoop> loops;
  bool reversed = false;  ///< the outward normal is -(Su x Sv)
  double tolerance = 0.0;
  std::vector<std::string> problems;  ///< what is wrong with it, one clear phrase each

  /// For `info`: what OpenCASCADE calls the surface.
  struct SplineFacts {
    int u_degree = 0, v_degree = 0, u_poles = 0, v_poles = 0;
    bool rational = false;
  };
  std::optional<SplineFacts> spline;
};

/// A closed or open set of faces. Solids are closed shells.
struct CadShell {
  std::vector<int> faces;  ///< indices into CadModel::faces
  bool closed = false;     ///< every edge that is not degenerated is used twice, in opposite directions
};

struct CadModel {
  std::string file;         ///< as the user gave it
  std::string unit = "mm";  ///< of all lengths here
  std::string file_unit;    ///< the unit that the file states, for information; empty where it states none
  std::vector<CadVertex> vertices;
  std::vector<CadEdge> edges;
  std::vector<CadFace> faces;  ///< face i is FaceN with N = i + 1
  std::vector<CadShell> shells;
  Xyz lower = Xyz::Zero();  ///< bounding box
  Xyz upper = Xyz::Zero();
  std::vector<std::string> warnings;

  double diagonal() const { return (upper - lower).norm(); }
};

}  // namespace geovor
