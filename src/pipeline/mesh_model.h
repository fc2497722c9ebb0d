// From a CAD model to a triangle mesh: the borders once, then every face, then one mesh of it all.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "brep/model.h"
#include "mesh/triangle_mesh.h"
#include "pipeline/corner_facts.h"

namespace geovor {

/// What one face is to be like; what is left out is as for all faces. An edge takes the finer of its faces' sizes.
struct FaceRule {
  int face = 0;  ///< FaceN's N
  std::optional<double> size, deflection, angle;
};

/// What the mesh is to be like. The smallest of the rules holds at each place, graded by `gradation`.
struct MeshOptions {
  double size = 0.0;      ///< the length that an edge is to have, model units; REQUIRES > 0
  double min_size = 0.0;  ///< no rule asks for less than this; 0: smallest_size()
  double deflection = std::numeric_limits<double>::infinity();  ///< largest distance from a triangle to the face
  double angle = 0.26179938779914943;  ///< largest turn of the normal across an edge, radians (15 degrees)
  double gradation = 0.5;              ///< how fast the size may grow with distance: h(x) <= h(y) + gradation * d(x, y)
  std::vector<FaceRule> face_rules;    ///< one a face at most
  std::vector<int> faces;              ///< face numbers to mesh (FaceN's N); empty: all

  /// Runs body(0) … body(n-1), in any order, perhaps at once; the result does not depend on it. Default: one after
  /// another.
  std::function<void(int n, const std::function<void(int)>& body)> for_each;
  /// Called after each face with the number done and the number in all; never from two threads at once. Returning false
  /// stops the work: the remaining faces are Stopped.
  std::function<bool(int done, int total)> progress;
};

enum class FaceStatus {
  Meshed,
  Rejected,  ///< the face can't be meshed: `why` says what is wrong and what would mend it
  Partial,   ///< meshed, but not as fine as was asked for, or with a fault: `why` says what
  Stopped,
};

struct FaceReport {
  int face = 0;  ///< FaceN's N
  FaceStatus status = FaceStatus::Rejected;
  std::string why;
  int triangles = 0;
  int inverted = 0;               ///< triangles whose normal points against the face's
  double size = 0.0;              ///< that was asked for on this face, model units
  double smallest_angle = 0.0;    ///< degrees
  SmallAngles below_30;           ///< triangles
  double largest_distance = 0.0;  ///< from points sampled on the triangles to the face, model units
  double mesh_area = 0.0;
  double face_area = 0.0;     ///< by quadrature on the surface
  int estimated_lengths = 0;  ///< edges whose geodesic length was estimated because the shooting did not converge
  double seconds = 0.0;
};

struct MeshResult {
  TriangleMesh mesh;  ///< of the faces that were meshed, in the order of their numbers
  std::vector<FaceReport> faces;
  std::vector<SharpCorner> sharp_corners;  ///< of the faces that were to be meshed
  double smallest_size = 0.0;  ///< that the rules were allowed to ask for where a face has no rule of its own
  double seconds_borders = 0.0, seconds_faces = 0.0;
};

/// The smallest size that the rules may ask for: options.min_size, or, where that is 0, a twentieth of the size (of a
/// tenth of the model's diagonal, where the size is larger than that).
double smallest_size(const MeshOptions& options, const CadModel& model);

/// Throws Error(Usage) where an option makes no sense; a face that fails is no error but a status in its report.
MeshResult mesh_model(const CadModel& model, const MeshOptions& options);

}  // namespace geovor
