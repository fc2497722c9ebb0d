// From sites, or a number of them, to the geodesic Voronoi diagram of one face of a model.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "brep/model.h"
#include "voronoi/cell_raster.h"
#include "voronoi/certificate.h"
#include "voronoi/diagram.h"
#include "voronoi/dual.h"
#include "voronoi/sites.h"

namespace geovor {

struct VoronoiRequest {
  /// Given sites, all that there are to be; a place in space is projected on the face.
  std::vector<std::variant<Uv, Xyz>> sites;
  /// Without given sites: how many to place by farthest points, or how far apart (one of the two is positive).
  int count = 0;
  double spacing = 0.0;    ///< model units
  std::uint64_t seed = 0;  ///< picks the first place
  bool snap = false;       ///< take a place in space that is off the face to the nearest point of it
  double tolerance = 0.0;  ///< see VoronoiOptions
  bool certify = false;    ///< fill VoronoiResult::certificate
  std::function<bool(int placed, int total)> placing;  ///< see PlacingProgress; false: the diagram of those placed
  std::function<bool(int done, int total)> progress;   ///< see VoronoiOptions
  bool raster = false;  ///< fill VoronoiResult::raster and the paths of the dual, for a picture
};

struct VoronoiResult {
  VoronoiDiagram diagram;
  DualGraph dual;
  SurfacePtr surface;
  UvBox parameters;  ///< the rectangle around the face
  double face_area = 0.0;
  double deflection = 0.0;  ///< of the face's border, as the diagram was built on it
  CellRaster raster;        ///< for pictures
  std::optional<Certificate> certificate;
};

/// Throws SiteError (an Error(Usage) that knows the site's index) for a site off the face or two equal ones,
/// Error(Usage) where the request asks for no sites, Error(FaceRejected) where the face can't be used. What the diagram
/// could not resolve is no error but a warning in it.
VoronoiResult voronoi_face(const CadModel& model, const CadFace& face, const VoronoiRequest& request);

}  // namespace geovor
