// The points that a diagram is made of, and what they must fulfil.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor {

/// A site can't be used. The message calls sites by their index, from 0; a caller that knows where a site came from can
/// say it better with site(), other() and reason().
class SiteError : public Error {
 public:
  /// "site 3 " + reason, or "sites 3 and 7 " + reason. `other`: -1 where one site alone is at fault.
  SiteError(int site, int other, const std::string& reason);
  int site() const { return site_; }
  int other() const { return other_; }
  const std::string& reason() const { return reason_; }

 private:
  int site_, other_;
  std::string reason_;
};

/// Throws SiteError where a site is not finite, lies outside the face by more than `tolerance`, or lies nearer than
/// `tolerance` to another one; of several faults the one with the smallest index.
void check_sites(const FaceDomain& domain, const std::vector<Uv>& sites, double tolerance);

/// Where the sites of a diagram lie, in its order.
std::vector<Uv> places_of_sites(const VoronoiDiagram& diagram);

}  // namespace geovor
