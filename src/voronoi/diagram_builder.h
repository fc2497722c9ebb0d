// From sites on a face to the vertices and edges of their geodesic Voronoi diagram.
#pragma once

#include <string>

#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor {

struct VoronoiOptions {
  /// How far the polylines of the edges may lie from the edges, model units; 0: kDefaultTolerance of the face's size.
  double tolerance = 0.0;
  /// Spacing of the lattice that carries the candidates, model units; 0: chosen from the sites and the curvature.
  double spacing = 0.0;
};

/// Part of the face's diagonal in space.
inline constexpr double kDefaultTolerance = 1e-5;

/// The geodesic Voronoi diagram of the sites on the face (sections 2 and 3 of the paper), with cells, areas and
/// residuals. Distances are those of the surface: where a shortest path leaves the face a warning says so.
///
/// Complete by the argument of the design: a lattice that has the sites among its nodes is labelled with nearest sites,
/// and every edge of the diagram separates two labels of the lattice, of the face's border, or of an edge found before.
/// What could not be resolved is named by a warning "unresolved", never left out in silence.
/// REQUIRES: sites pass check_sites() (voronoi/sites.h).
VoronoiDiagram build_diagram(const FaceDomain& domain, const std::vector<Uv>& sites,
                             const VoronoiOptions& options = {});

/// The diagonal in space of a box around the face: what tolerances are parts of.
double face_size(const FaceDomain& domain);

}  // namespace geovor
