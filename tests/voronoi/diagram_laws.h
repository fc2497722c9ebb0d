// Laws that every diagram obeys, checked with other means than those that made it.
#pragma once

#include <string>

#include "brep/face_domain.h"
#include "test_faces.h"
#include "voronoi/diagram.h"

namespace geovor::testing {

/// Every spoke belongs to an edge that says the same; every edge is walked once in each direction by the loops of the
/// right cells; loops hold together. Says the first broken law.
std::string broken_topology(const VoronoiDiagram& diagram);

/// What the certificate of the diagram says, unless it holds.
std::string unproved(const TestFace& face, const VoronoiDiagram& diagram);

/// V - E + F, the stretches of the border between vertices being edges, and a cell counting as what it is: a disk for
/// each loop that goes around a piece of it, less one for each hole.
int euler_number(const FaceDomain& domain, const VoronoiDiagram& diagram);

/// The largest relative difference of the geodesic distances from a vertex or edge point to its sites, by connect()
/// without a guess where that finds a geodesic as long as the stored one; infinite where none is found. Free ends of
/// cut loci are left out.
double worst_mismatch(const Surface& surface, const VoronoiDiagram& diagram);

/// Of `count` random points of the face, how many lie in a cell other than that of the nearest site (connect() to all
/// sites decides), points within the polylines' tolerance of an edge left out. For faces without seam.
int wrong_labels(const FaceDomain& domain, const VoronoiDiagram& diagram, int count, unsigned seed);

/// The same for closed surfaces: each cell is drawn in the polar coordinates about its site.
int wrong_labels_in_polar_charts(const FaceDomain& domain, const VoronoiDiagram& diagram, int count, unsigned seed);

}  // namespace geovor::testing
