// Triangle meshes in the formats of other programs. docs/FILES.md tells what each file holds.
#pragma once

#include "io/byte_stream.h"
#include "mesh/labelled_mesh.h"

namespace geovor {

// Each writer puts a whole file into the stream, face by face where the format has groups; the same mesh gives the same
// bytes, on every machine. Memory beside the mesh: at most some 100 bytes a triangle. Throws Error(Unwritable) where
// the format can't hold the mesh. REQUIRES: first_fault(labelled.mesh) finds nothing; at least one triangle.

enum class StlForm {
  Binary,  ///< single precision; refuses a coordinate beyond it, and more than 2^32 - 1 triangles
  Ascii,   ///< one solid "geovor"; coordinates read back as the same doubles
};
/// STL. Normals are of unit length, zero for a triangle without area.
void put_stl(const TriangleMesh& mesh, StlForm form, ByteStream& out);

/// Wavefront OBJ: all points, then a group a face. Coordinates read back as the same doubles.
void put_obj(const LabelledMesh& labelled, ByteStream& out);

/// PLY, binary, doubles: each triangle has its face number and, where any face has a colour, red, green, blue (sRGB).
void put_ply(const LabelledMesh& labelled, ByteStream& out);

/// VTK's XML for polygonal data: cell data `face`, `group` and, where any face has a colour, `colour` (sRGB); the names
/// of the groups as field data.
void put_mesh_vtp(const LabelledMesh& labelled, ByteStream& out);

/// Gmsh's MSH 4.1 as text: a surface and a physical group a face, both with the face's number. Coordinates read back as
/// the same doubles.
void put_msh(const LabelledMesh& labelled, ByteStream& out);

/// Abaqus: S3 elements, an element set a face. A number has at most 20 characters, all that solvers read: magnitudes
/// from 0.01 to 1e16 read back as the same doubles, others to 13 digits at least.
void put_inp(const LabelledMesh& labelled, ByteStream& out);

/// I-DEAS universal file: nodes (as the same doubles), thin-shell triangles, a group a face. Without a dataset of
/// units: readers multiply by its factor where its definition says divide, and leave the numbers alone where there is
/// none.
void put_unv(const LabelledMesh& labelled, ByteStream& out);

/// glTF 2.0 in one binary file: a node with one primitive a face, metres, y up, smooth normals within each face. Single
/// precision, relative to the middle of the mesh. Refuses more than 4 GiB.
void put_glb(const LabelledMesh& labelled, ByteStream& out);

/// STEP (AP214), a planar face a triangle with shared vertices and edges: a solid a closed shell, its normals looking
/// outwards, a surface model an open one. Faces have the names and colours of the CAD faces. Coordinates read back as
/// the same doubles. Refuses a triangle without area, which has no plane.
void put_step_facets(const LabelledMesh& labelled, ByteStream& out);

/// STEP (AP242), tessellated: a triangulated face a CAD face, with name, colour and smooth normals, in a tessellated
/// solid a closed shell, a tessellated shell an open one. Coordinates read back as the same doubles.
void put_step_tessellation(const LabelledMesh& labelled, ByteStream& out);

/// A page without anything from outside that shows the mesh and turns it; see docs/FILES.md.
void put_mesh_html(const LabelledMesh& labelled, ByteStream& out);

}  // namespace geovor
