// The sizes of border edges where a face is narrow or its border has a sharp corner.
#pragma once

#include <optional>
#include <vector>

#include "brep/model.h"
#include "delaunay/edge_stations.h"
#include "delaunay/narrow_places.h"

namespace geovor {

/// Beside a narrow place h is no more than kLengthPerGap times its width, but never below the rule's smallest size;
/// where that is more than twice too large nothing is done.
///
/// In a sharp corner both edges begin with one segment of the same length, so that the one triangle in the corner is
/// isosceles and has the corner's angle; beyond it h follows the width. (With h following the width into the corner a
/// row of ever smaller triangles would end in one with that angle all the same.)
class NarrowSizes {
 public:
  NarrowSizes() = default;

  /// Adds the narrow places to the stations of their edges, where h is lowered except for those in sharp corners, which
  /// are kept for lower_in_corners().
  NarrowSizes(const CadModel& model, const std::vector<NarrowFace>& faces,
              const std::vector<std::vector<FaceUse>>& uses, std::vector<std::optional<EdgeStations>>& stations);

  /// The lengths of an edge's first and last segment where these end in a sharp corner; 0 elsewhere.
  struct Caps {
    double first = 0.0, last = 0.0;
  };

  /// `h[e]` and `vertex` are graded sizes of the stations and vertices. Lowers h beside sharp corners; it has to be
  /// graded again where a cap is not 0.
  std::vector<Caps> lower_in_corners(const std::vector<std::optional<EdgeStations>>& stations,
                                     const std::vector<double>& vertex, std::vector<std::vector<double>>& h) const;

  const std::vector<FaceCorner>& corners() const { return corners_; }

  /// A station of one edge and one of another (or of the same) across a face.
  struct Link {
    int station = -1, to_edge = -1, to_station = -1;
    double distance = 0.0;
  };
  /// Those of each edge, by station; each also the other way.
  const std::vector<std::vector<Link>>& links() const { return links_; }

 private:
  struct InCorner {
    int edge = -1, station = -1, corner = -1;
    double from_corner = 0.0, size = 0.0;
  };
  void add_links(const std::vector<NarrowFace>& faces, const std::vector<std::optional<EdgeStations>>& stations);

  std::vector<std::vector<Link>> links_;
  std::vector<FaceCorner> corners_;
  std::vector<double> least_;  // of the faces
  std::vector<InCorner> in_corners_;
};

}  // namespace geovor
