// From sites on a face to the vertices and edges of their geodesic Voronoi diagram.
#pragma once

#include <functional>
#include <string>

#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor {

struct VoronoiOptions {
  /// How far the polylines of the edges may lie from the edges, model units; 0: kDefaultTolerance of the face's size.
  double tolerance = 0.0;
  /// Whether to measure the finished diagram: areas, residuals, paths that leave the face.
  bool measure = true;
  /// Called with the number of cells that the edges have reached, and that of the sites. Returning false stops the
  /// work: what is missing is named by warnings "unresolved", and nothing is measured.
  std::function<bool(int done, int total)> progress;
};

/// Part of the face's diagonal in space.
inline constexpr double kDefaultTolerance = 1e-5;

/// The geodesic Voronoi diagram of the sites on the face (sections 2 and 3 of the paper), with cells. Distances are
/// those of the surface: where a shortest path leaves the face a warning says so.
///
/// Complete, islands included: a shortest path from a point of a cell to its site stays in the cell, so that a cell is
/// a star in its site's polar chart, and its border there one closed curve (which runs along both sides of a cut
/// locus). Edges are traced from one point of each of these curves, and from every place where the nearest site changes
/// along the border of the face; what these do not reach does not exist.
/// What could not be resolved is named by a warning "unresolved", never left out in silence.
/// REQUIRES: sites pass check_sites() (voronoi/sites.h).
VoronoiDiagram build_diagram(const FaceDomain& domain, const std::vector<Uv>& sites,
                             const VoronoiOptions& options = {});

/// A diagram of some of the sites.
struct PartDiagram {
  VoronoiDiagram diagram;
  std::vector<int> which;  ///< its site i is site which[i] of all
};

/// The diagram of all sites from diagrams of parts of them (merge_subdiagrams in section 3.2 of the paper). Vertices
/// and edges of the parts stay where no site of another part is nearer; from what is left open there the edges are
/// traced again up to where they are cut, and the chains between the parts from vertex to vertex. Starting points of
/// chains that meet neither are those of build_diagram(), so that none is missed, closed or not.
/// REQUIRES: every site is in one part
VoronoiDiagram merge_diagrams(const FaceDomain& domain, const std::vector<Uv>& sites,
                              const std::vector<PartDiagram>& parts, const VoronoiOptions& options = {});

/// The diagonal in space of a box around the face: what tolerances are parts of.
double face_size(const FaceDomain& domain);

}  // namespace geovor
