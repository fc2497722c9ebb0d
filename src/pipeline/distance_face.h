// The distance between two points of a face, with the shortest paths and where they leave the face.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "brep/cad_curve.h"
#include "brep/face_domain.h"
#include "geodesic/distance.h"
#include "pipeline/face_point.h"
#include "pipeline/surface_path.h"
#include "voronoi/cell_raster.h"

namespace geovor {

/// Where a path leaves the face, on its border, and where it comes back; nothing where it ends outside.
struct FaceExit {
  PathPoint out;
  std::optional<PathPoint> back;
};

struct FacePath {
  Connection connection;          ///< length, directions in parameters, y; the residual is measured at points.back()
  Uv start;                       ///< what it was followed from: at a point with many parameters the ones it leaves by
  std::vector<PathPoint> points;  ///< both ends included, chords within kPolylineDeviation of the path
  Xyz end_tangent = Xyz::Zero();  ///< unit, pointing on along the path; that at the start is points.front().tangent
  std::optional<FaceExit> exit;
};

/// Of the path's length: how far the polyline through FacePath::points may lie from the path, in space and measured
/// along straight lines of the parameter plane alike. Some 200 points for half a circle.
inline constexpr double kPolylineDeviation = 1e-5;

struct DistanceWarning {
  std::string kind;  ///< "path_leaves_face", "many_paths", "path_not_followed"
  std::string text;
};

struct FaceDistance {
  FacePlace from, to;
  DistanceResult result;        ///< on the surface without its trims; usable where its status is Converged
  std::vector<FacePath> paths;  ///< of all shortest paths, those that could be followed to their ends
  /// Where the shortest path leaves the face: the length of the shortest geodesic found that stays on it. The distance
  /// in the face lies between the two; nothing where no such geodesic was found.
  std::optional<double> stays_on_face;
  std::vector<DistanceWarning> warnings;

  double length() const { return result.shortest.length; }
  bool leaves_face() const;  ///< every shortest path does: `length` is not the distance in the face
};

/// What is asked of one face again and again. Immutable. REQUIRES: the model outlives it.
class FaceDistances {
 public:
  /// Throws Error(FaceRejected) where the face can't be used.
  FaceDistances(const CadModel& model, const CadFace& face);

  /// Throws Error(Usage), a clause about the point, where it is off the face and shall not be moved (`snap`).
  FacePlace place(const FacePoint& point, bool snap) const;

  /// Never throws for places of place(); what does not settle is a status in the result.
  FaceDistance between(const FacePlace& from, const FacePlace& to) const;

  /// The path as a curve in space that lies within spline_deviation() of it. REQUIRES: a length above 0.
  CadCurve spline(const FacePath& path, const std::string& name) const;
  double spline_deviation(const FacePath& path) const;

  /// The face in patches, for a picture.
  CellRaster patches() const;

  const Surface& surface() const { return domain_.surface(); }
  const UvBox& box() const { return domain_.box(); }
  /// Nearer to the border than this, model units, is on the border: what the CAD promises of it.
  double tolerance() const { return tolerance_; }

 private:
  std::optional<Uv> start_of(const FacePlace& from, const FacePlace& to, const Connection& connection) const;
  FacePath follow(Uv start, const FacePlace& from, const FacePlace& to, const Connection& connection) const;
  std::optional<FaceExit> find_exit(const SurfacePath& path, const FacePlace& from, const FacePlace& to) const;
  double outside(const FacePlace& place) const;

  const CadModel& model_;
  const CadFace& face_;
  double tolerance_;
  FaceDomain domain_;
  double printed_tolerance_;
  DistanceFinder finder_;
};

}  // namespace geovor
