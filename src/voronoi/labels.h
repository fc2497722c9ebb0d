// Which sites can own the points around each node of a lattice, with their geodesics: the candidates of the diagram.
#pragma once

#include <vector>

#include "voronoi/lattice.h"
#include "voronoi/site_ray.h"

namespace geovor {

/// Candidate lists of all nodes of a lattice. Promises: the list of the corners of a lattice cell, taken together, hold
/// every site that owns a point of the cell, as far as connect() follows the geodesics: d(., q) is 1-Lipschitz, so that
/// q owns a point within reach of node x only if d(x, q) <= d(x, P) + 2 reach. A site whose geodesics reach a node in
/// two ways is listed twice. Distances are those of the surface, trims left out of account.
class CandidateLabels {
 public:
  CandidateLabels(const FaceLattice& lattice, const SiteRays& rays);

  /// By length, to kRoughly; the first is the nearest site. Empty only where no geodesic could be computed.
  const std::vector<SiteRay>& at(int node) const { return lists_[node]; }

  /// The geodesics of all candidates of the cell around m to m itself, by length; each geodesic once. `roughly`: to
  /// kRoughly of their length.
  std::vector<SiteRay> around(Uv m, bool roughly = false) const;

  const FaceLattice& lattice() const { return lattice_; }
  const SiteRays& rays() const { return rays_; }

 private:
  const FaceLattice& lattice_;
  const SiteRays& rays_;
  std::vector<std::vector<SiteRay>> lists_;
};

}  // namespace geovor
