// A picture of a triangle mesh as SVG.
#pragma once

#include <string>

#include "mesh/triangle_mesh.h"

namespace geovor {

struct PictureOptions {
  int width = 1600, height = 1200;  ///< page units
  bool colour_by_face = true;       ///< a tint a CAD face; otherwise one for all
  bool lines = true;  ///< the triangles' sides; left out anyway where they would be closer than a few units
};

/// An isometric view: flat shading under soft light, hidden triangles left out, the borders of CAD faces and the
/// outline drawn stronger. The same mesh gives the same bytes. REQUIRES: first_fault(mesh) finds nothing.
std::string mesh_picture(const TriangleMesh& mesh, const PictureOptions& options = {});

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_mesh_picture(const TriangleMesh& mesh, const std::string& path, const PictureOptions& options = {});

}  // namespace geovor
