// Tensor-product B-spline surfaces, polynomial or rational, open or periodic, of any degree up to kMaxDegree.
#pragma once

#include <vector>

#include "surface/bspline_kernels.h"
#include "surface/knot_vector.h"
#include "surface/surface.h"

namespace geovor {

class BSplineSurface final : public Surface {
 public:
  /// `poles` run along v first: pole (i, j) is poles[i * v_knots.pole_count() + j]; `weights` likewise, empty for a
  /// polynomial surface. Equal weights are dropped. Throws Error(FaceRejected) if the counts do not fit the knots, a
  /// coordinate is not finite or a weight is not positive.
  /// Sums run over the poles relative to `centre`, the middle of their box unless given: there the surface keeps its
  /// relative accuracy.
  BSplineSurface(KnotVector u_knots, KnotVector v_knots, const std::vector<Xyz>& poles,
                 const std::vector<double>& weights = {}, const std::optional<Xyz>& centre = std::nullopt);

  SurfaceKind kind() const override { return SurfaceKind::BSpline; }
  UvBox domain() const override { return {u_knots_.domain(), v_knots_.domain()}; }
  /// Also where the knots are not periodic but the first and the last row of poles are the same, to rounding, and no
  /// pole: the surface is closed then, the seam a line between spans, and across it continuous or better as measured.
  std::optional<double> u_period() const override;
  std::optional<double> v_period() const override;

  SurfaceJet jet(Uv p) const override;
  SurfaceJet jet(Uv p, const Span& span) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  Xyz position(Uv p) const override;

  /// Span::box is infinite on the outer side of the outermost spans of a direction that is not periodic, since those
  /// are continued there; in a periodic direction it is the copy that holds p.
  Span span(Uv p, UvVec towards) const override;
  int continuity() const override;

  const KnotVector& u_knots() const { return u_knots_; }
  const KnotVector& v_knots() const { return v_knots_; }
  bool rational() const { return net_.rational; }
  /// The pole (i, j) relative to centre(), and its weight. REQUIRES: i < u_knots().unrolled_count(), j likewise
  Xyz pole(int i, int j) const;
  double weight(int i, int j) const;
  const Xyz& centre() const { return net_.centre; }

  /// Distinct knots strictly inside the domain: the lines across which the surface is not analytic.
  struct KnotLines {
    std::vector<double> u, v;
  };
  KnotLines knot_lines() const;

 private:
  PoleCharts make_poles() const override;
  void join_seams();

  int seam_continuity_ = kSmooth;  // across the seams that join_seams has found

  KnotVector u_knots_, v_knots_;
  BSplineNet net_;
  BSplineKernels kernels_;
};

}  // namespace geovor
