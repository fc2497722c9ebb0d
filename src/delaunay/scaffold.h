// The first triangulation of a face: valid, fine enough to follow its shape, not yet good.
#pragma once

#include <string>
#include <vector>

#include "brep/model.h"
#include "delaunay/border.h"
#include "delaunay/half_edges.h"
#include "delaunay/mesh_vertex.h"
#include "delaunay/size_rule.h"
#include "delaunay/surface_probe.h"

namespace geovor {

struct Scaffold {
  bool ok = false;
  std::string why;              ///< if not ok: what is wrong with the face
  std::vector<int> bad_points;  ///< if not ok: border points that should be closer together
  HalfEdges triangles;          ///< on the surface: seams sewn, poles one vertex; CAD edges fixed
  std::vector<MeshVertex> vertices;
};

/// Triangulates the face's border polygon in the parameter plane and halves edges at their middle parameters, the one
/// that is longest on the surface first, until none is longer than the rule allows or turns the normal by more than it
/// can follow. Then sews the seams and closes the poles. The parameter plane decides here, and only here, which points
/// there are; refine() replaces them.
Scaffold build_scaffold(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border,
                        const SizeRule& rule);

/// The border points at which the face's border polygon touches or crosses itself; empty where it is simple.
std::vector<int> border_faults(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border);

}  // namespace geovor
