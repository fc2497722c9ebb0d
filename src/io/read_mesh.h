// Triangle meshes from files of other programs, and our own.
#pragma once

#include <string>
#include <vector>

#include "mesh/loaded_mesh.h"

namespace geovor {

/// The endings that read_mesh knows: ".stl", ".obj", …
const std::vector<std::string>& readable_mesh_endings();

/// Reads by the ending: .stl (binary or text), .obj, .ply (text or binary), .off, .vtp (not compressed), .msh (Gmsh 2.2
/// or 4.1, text) and .inp. Polygons are cut into fans of triangles; of curved triangles the corners are taken.
/// STL repeats its points: those of equal coordinates are one. The other formats number their points, and what a file
/// keeps apart stays apart.
/// Groups: solids of .stl, `g` of .obj, a property `face` of .ply and an array `face` of .vtp, the physical groups (or
/// else the surfaces) of .msh, element sets of .inp.
/// Indices are in range and points finite. Throws Error(Unreadable), without the path in front.
LoadedMesh read_mesh(const std::string& path);

}  // namespace geovor
