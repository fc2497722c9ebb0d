// Points in rows: equilateral triangles are put on the border, and on each other, until the face is full.
#pragma once

#include <vector>

#include "delaunay/mesh_border.h"
#include "delaunay/mesh_vertex.h"
#include "delaunay/size_field.h"
#include "delaunay/size_rule.h"
#include "delaunay/surface_probe.h"

namespace geovor {

/// The points of a face's mesh: those of its border, in their order, then the inner ones. Each is about its size away
/// from the next. They are made without a triangulation and without the parameter plane: every decision is one about
/// places in space, normals and sizes, so that the same face has the same points under any parameterization.
///
/// Empty where the face has no border and no place to start from is found, and where it wants more than four million.
std::vector<MeshVertex> fill_by_fronts(const SurfaceProbe& probe, const SizeRule& rule, const SizeField& field,
                                       const MeshBorder& border);

}  // namespace geovor
