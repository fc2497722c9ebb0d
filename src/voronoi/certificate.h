// The proof that a finished diagram is the Voronoi diagram of its sites.
//
// Theorem. Let the cells tile the face; let each be, in the polar chart (s, t) of its site, the inside of its border,
// with y > 0 on every ray up to there, wherever the border is made of edges a star: t grows along it; and let the
// radial lengths of the two cells agree along every edge. Then rho(x) = the radial length of x in the cell that holds
// it is the distance of x to the nearest site, as far as rays stay in the face. Proof. rho is continuous: within a cell
// because the chart is one (y > 0), across an edge because the lengths agree. It is zero at the sites. Inside a cell
// its gradient is the ray's unit tangent, so that along any path within the face it changes by no more than the path's
// length: rho(x) <= d(x, p) for every site p, with d by paths in the face. And the ray in the chart is a path of length
// rho(x), so that rho(x) >= d(x, its site) where it stays in the face. So the site of the cell that holds x is nearest
// to x. No single geodesic was tested for being shortest. Where the lengths differ by e on the edges, a path collects
// an error of e for every edge that it crosses.
//
// What is checked is the finished data, with every ray traced anew from its polar coordinates (voronoi/ray_end.h); what
// lies between two places that were looked at is inferred: the places are the stored points and the middles between
// them, and along the face's border a fraction of the distance to the site apart. Every number is looked at, or made
// anew and compared, but the slopes of edges' points and the residuals, which must only be finite (a residual: a
// number). Warnings are not believed: which rays leave the face is told by the walks along the border.
#pragma once

#include <string>
#include <vector>

#include "brep/face_area.h"
#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor {

/// One thing that the proof needs.
struct CertificateClaim {
  std::string name;       ///< a word or two, the same in every certificate
  std::string statement;  ///< what is claimed, in one line
  bool holds = false;
  double measured = 0.0, bound = 0.0;  ///< measured <= bound; NaN never holds
  /// Where it does not hold: the first offender.
  enum class Offender { None, Vertex, Edge, Cell, Diagram } offender = Offender::None;
  int id = -1;
  Uv uv;
  std::string why;  ///< empty where it holds
};

struct Certificate {
  std::vector<CertificateClaim> claims;
  /// Sites with rays that leave the face by more than its border's deflection to the side, or of which the diagram says
  /// so ("path_leaves_face"): in their cells, and in those that compete with them, distances are those of the surface
  /// continued, not of the face.
  std::vector<int> not_covered;
  std::string result;  ///< one line: what is proved, and what is not
  bool holds() const;
};

/// Checks the diagram. `face_area`: of the same face, by quadrature over its parameters (brep/face_area.h), which must
/// have come to kAreasAddUp. A diagram without areas was not measured: what measuring finds is not asked of it.
Certificate certify(const FaceDomain& domain, const VoronoiDiagram& diagram, const Area& face_area);

/// Radial lengths on both sides of an edge, relative.
inline constexpr double kEquidistance = 1e-12;
/// The areas of the cells together against that of the face, relative; the error of the face's own area is added.
inline constexpr double kAreasAddUp = 1e-6;

}  // namespace geovor
