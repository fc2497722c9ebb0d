// Where an edge of a diagram meets the face's border.
#pragma once

#include <optional>

#include "voronoi/edge_piece.h"
#include "voronoi/face_border.h"

namespace geovor {

class EdgeOnBorder {
 public:
  /// Both outlive it. `sag`: how far a chord may lie from the edge where the border is near, model units.
  EdgeOnBorder(const FaceBorder& border, const SiteRays& rays, double sag)
      : domain_(border.domain()), border_(border), rays_(rays), sag_(sag) {}

  struct Crossing {
    BisectorPoint from, to;  ///< a chord that meets the border
    FaceBorder::Crossing at;
  };
  /// Where the piece of the edge from a to b first leaves the face. `starts_on_border`: a lies on the border, and the
  /// piece goes in.
  std::optional<Crossing> first_crossing(const BisectorPoint& a, const BisectorPoint& b, bool starts_on_border) const;

  /// The border straight on, for a step of length h that has no end: where parameters lose the tangent plane on the
  /// border no ray can be followed beyond it.
  std::optional<Crossing> straight_on(const BisectorPoint& a, double h, bool starts_on_border) const;

  /// The point of the edge on the border near the crossing, by Newton's method for d_left = d_right along the border.
  std::optional<BisectorPoint> point(const Crossing& crossing, BorderPlace& place) const;

 private:
  std::optional<Crossing> leaves_face(const BisectorPoint& a, const BisectorPoint& b, double skip, int depth) const;
  std::optional<FaceBorder::Crossing> chord_leaves_face(Uv from, Uv to, double skip) const;
  std::optional<Crossing> cubic_leaves_face(const BisectorPoint& a, const BisectorPoint& b, double skip) const;

  const FaceDomain& domain_;
  const FaceBorder& border_;
  const SiteRays& rays_;
  double sag_;
};

/// A point of an edge on the border, known to the digits of the place's parameter, moved along the border to where its
/// two rays are as long as each other: the parameter counts segments, and that of the two hundredth has two digits less
/// than places have. Unchanged where the rays do not tell a place so near.
BisectorPoint settled_on_border(const SiteRays& rays, const FaceBorder& border, BorderPlace place, BisectorPoint m);

}  // namespace geovor
