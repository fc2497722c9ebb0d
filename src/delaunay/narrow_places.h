// Where two parts of a face's border come near each other across the face, and where they meet in a sharp corner.
#pragma once

#include <optional>
#include <vector>

#include "brep/model.h"
#include "delaunay/edge_stations.h"

namespace geovor {

/// A face narrower than its mesh is long is filled well by triangles on both its sides whose edges are no longer than
/// this many times its width: their angles are atan(1 / 1.5) = 33 degrees or more, however the points of the sides
/// stand to each other.
inline constexpr double kLengthPerGap = 1.5;
/// In a sharp corner the points of both sides stand to each other as badly as can be, and it widens.
inline constexpr double kLengthPerGapInCorners = 1.15;

/// A place on a face's border and the way from there across the face to another part of it.
struct NarrowPlace {
  int edge = -1;
  double s = 0.0;    ///< on the edge's way
  double gap = 0.0;  ///< in a straight line
  int corner = -1;   ///< the vertex of the sharp corner in which the two parts meet; -1: they don't
  double from_corner = 0.0;
};

/// Two places that see each other.
struct PlacePair {
  struct Place {
    int edge = -1;
    double s = 0.0;
  };
  Place a, b;
  double distance = 0.0;
};

/// The end of one edge and the start of the next, with the face between them.
struct FaceCorner {
  int face = -1, vertex = -1;
  struct End {
    int edge = -1;
    bool at_start = false;  ///< of the edge, not of its use
  };
  End in, out;
  double angle = 0.0;  ///< radians, in the tangent plane
};

struct NarrowFace {
  double least = 0.0;  ///< no size below this may be asked for
  std::vector<NarrowPlace> places;
  std::vector<PlacePair> pairs;  ///< also of places farther from each other, up to h: sizes are graded across the face
  std::vector<FaceCorner> corners;  ///< the sharp ones
};

/// Below this angle (41 degrees) a corner is sharp here: right across it is seen from both sides under at least 49
/// degrees, and wider ones need no finer border.
inline constexpr double kSharpCosine = 0.75;

/// The places from which a gap is seen that is less than h / kLengthPerGap, where `sizes[e]` has the h of the stations
/// of edge e. Seen means: on the same sheet, through the inside of the face, from either end under 49 degrees or more.
/// Every place and every gap is one of the geometry's own: arc lengths, distances and angles decide, not parameters.
/// `uses` and `stations` are those of all edges.
NarrowFace narrow_places(const CadModel& model, int face, const SurfaceProbe& probe, const SizeRule& rule,
                         const std::vector<std::vector<FaceUse>>& uses,
                         const std::vector<std::optional<EdgeStations>>& stations,
                         const std::vector<std::vector<double>>& sizes);

}  // namespace geovor
