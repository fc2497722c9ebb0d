// A mesh of any origin, measured against the CAD model that it stands for.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/loaded_mesh.h"
#include "mesh/mesh_checks.h"
#include "mesh/mesh_faults.h"
#include "pipeline/mesh_distances.h"

namespace geovor {

/// A triangle and a number that makes it worth showing. Faces are indices into CadModel::faces everywhere here.
struct TriangleNote {
  int triangle = -1;
  double value = 0.0;
  int face = -1;
};

/// The triangles with an angle below a limit.
struct NarrowTriangles {
  double limit = 0.0;  ///< degrees
  int count = 0;
  int at_sharper_corners = 0;  ///< of these: the small angle fills a corner of the CAD that is below the limit itself
};

struct CheckedAngles {
  double smallest = 0.0, largest = 0.0, mean_smallest = 0.0;  ///< degrees
  int smallest_at = -1;                                       ///< triangle
  std::array<NarrowTriangles, 3> narrow{{{15.0}, {20.0}, {30.0}}};
  double smallest_elsewhere = 0.0;  ///< smallest angle but for corners of the CAD below 30 degrees; 0: none
  std::vector<TriangleNote> at_sharper_corners;  ///< the triangles below 30 degrees there, and their angles
};

/// The vertices' distances from the CAD.
struct CheckedVertices {
  double largest = 0.0;
  int largest_at = -1;     ///< point
  double tolerance = 0.0;  ///< kOnCad of the diagonal, plus the rounding of the file
  int beyond = 0;          ///< vertices that lie farther off
};

struct CheckedNormals {
  double largest = 0.0, mean = 0.0, rms = 0.0;  ///< degrees between triangle and face at its centroid; over the area
  int largest_at = -1;                          ///< triangle
  std::vector<int> inverted;                    ///< triangles that turn by more than 90 degrees from their face
};

struct CheckedFace {
  int triangles = 0;
  double mesh_area = 0.0, face_area = 0.0;
  double to_cad = 0.0;   ///< largest distance of its triangles from the CAD
  double to_mesh = 0.0;  ///< of the face from the mesh
  double smallest_angle = 0.0, normal_deviation = 0.0;
  int inverted = 0;
  std::string why_not;  ///< why the face can't be measured; empty where it can
};

struct CheckedGroup {
  int triangles = 0;
  int face = -1;      ///< the face that it stands for; -1: it spreads over several
  int elsewhere = 0;  ///< its triangles that lie on another face by their nearest place
};

struct MeshCheck {
  MeshTopology topology;
  MeshFaults faults;
  std::vector<int> face_of;  ///< of a triangle
  MeshOnCad on_cad;
  CadOnMesh on_mesh;
  CheckedVertices vertices;
  CheckedAngles angles;
  CheckedNormals normals;
  EdgeLengths edges;
  std::vector<CheckedFace> faces;    ///< as CadModel::faces
  std::vector<CheckedGroup> groups;  ///< as LoadedMesh::groups
  double area = 0.0;                 ///< of the mesh
  double volume = 0.0;               ///< where it is closed
  double hausdorff() const { return std::max(on_cad.distance.largest, on_mesh.distance.largest); }
};

/// A vertex within this part of the diagonal lies on the CAD; the file's rounding comes on top.
inline constexpr double kOnCad = 1e-9;
/// A group stands for the face on which at least this part of its triangles lies.
inline constexpr double kOfOneFace = 0.9;

/// Throws Error(Unreadable) where the mesh holds no triangle or no face of the model can be used.
/// REQUIRES: indices of the mesh in range, points finite.
MeshCheck check_mesh(const LoadedMesh& loaded, const CadModel& model, const NearestOnCad::ForEach& for_each);

}  // namespace geovor
