// B-spline curves, polynomial or rational, open or periodic, of any degree up to kMaxDegree.
#pragma once

#include <algorithm>
#include <vector>

#include "surface/curve.h"
#include "surface/knot_vector.h"

namespace geovor {

template <int Dim>
class BSplineCurve final : public Curve<Dim> {
 public:
  using Point = typename Curve<Dim>::Point;

  /// Throws Error(FaceRejected) if the number of poles (or weights, empty for a polynomial curve) does not fit the
  /// knots, a coordinate is not finite or a weight is not positive.
  BSplineCurve(KnotVector knots, const std::vector<Point>& poles, const std::vector<double>& weights = {});

  Interval domain() const override { return knots_.domain(); }
  /// Also where the knots are not periodic but the first and the last pole are the same, to rounding, and not all are:
  /// the ends are a line between pieces then, continuous or better as measured.
  std::optional<double> period() const override;
  CurveJet<Dim> jet(double t) const override;
  CurveJet<Dim> jet(double t, const CurvePiece& piece) const override;
  std::vector<double> breaks(Interval range) const override;

  /// The box of an outermost piece of a curve that is not periodic is infinite outwards: the piece is continued there.
  CurvePiece piece(double t, double towards) const override;
  int continuity() const override { return std::min(knots_.continuity(Curve<Dim>::kSmooth), seam_continuity_); }

  const KnotVector& knots() const { return knots_; }
  bool rational() const { return !weights_.empty(); }

 private:
  CurveJet<Dim> evaluate(int span, double t) const;
  bool closed(const std::vector<Point>& poles, double rounding) const;
  void join_seam(const std::vector<Point>& poles);

  int seam_continuity_ = Curve<Dim>::kSmooth;  // across the seam that join_seam has found
  KnotVector knots_;
  std::vector<Point> poles_;     // unrolled; times their weight if rational
  std::vector<double> weights_;  // unrolled; empty if polynomial
};

extern template class BSplineCurve<2>;
extern template class BSplineCurve<3>;

}  // namespace geovor
