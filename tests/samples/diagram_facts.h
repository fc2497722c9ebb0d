// Checks of a geodesic Voronoi diagram that compute every distance anew.
#pragma once

#include <vector>

#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor::testing {

/// `count` places inside the face, spread by Halton's sequence and kept off the border; the same ones in every run.
std::vector<Uv> spread_sites(const FaceDomain& face, int count);

/// The face of the model with the largest area.
const CadFace& largest_face(const CadModel& model);

/// Whether the loops of the cell wind around p in the parameter plane. REQUIRES: no periodic direction.
bool cell_holds(const VoronoiDiagram& diagram, const DiagramCell& cell, Uv p);

/// Length of the shortest path on the surface; infinite where none was found.
double measured_distance(const Surface& surface, Uv from, Uv to);

}  // namespace geovor::testing
