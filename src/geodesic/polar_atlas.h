// The geodesics that leave a point in all directions, followed roughly and kept, to be asked which of them pass by a
// target: the safe way to all the geodesics, and so to the shortest, between two points.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "geodesic/box_tree.h"
#include "geodesic/connect.h"
#include "geodesic/integrator.h"

namespace geovor {

/// Where a geodesic seems to end at the target.
struct AtlasHit {
  Polar at;
  double off = 0.0;    ///< the target lies so far beside the ray
  double error = 0.0;  ///< of at.s, as a rule
  double turn = 0.0;   ///< to the next geodesic that was followed, or more where places are not that exact
  bool plain = true;   ///< far from conjugate points, and not on another sheet: one geodesic must be meant
};

/// Least error of a hit, in parts of its length.
inline constexpr double kHitError = 0.03;

/// Whether the geodesic with these polar coordinates may be the one that the hit stands for.
bool is_meant(const AtlasHit& hit, const Polar& geodesic);

struct AtlasOptions {
  double length = 0.0;
  /// How far rays may run beyond the border of the surface's domain, in parts of its extents, on the outermost pieces
  /// continued (not more than the width of those). What lies beyond the border is not searched for gaps.
  double beyond = 0.0;
  /// If the only target is known, rays are given up where it is out of reach.
  std::optional<Xyz> target;
};

class PolarAtlas {
 public:
  /// Follows geodesics from `from` as far as kReach lengths, their first conjugate point (none is a shortest path
  /// beyond) or the rim, as many as are needed to leave no gap. REQUIRES: the surface outlives the atlas
  PolarAtlas(const Surface& surface, Uv from, const AtlasOptions& options);

  /// Where geodesics that may be not longer than `limit` seem to end at x, those that pass it by nearest first.
  /// Neighbours often hit with the same geodesic in mind.
  std::vector<AtlasHit> hits(const Xyz& x, double limit) const;

  /// The length that was asked for.
  double length() const { return options_.length; }

  /// Every point that a shorter geodesic reaches on the domain lies between two neighbouring rays that are close to
  /// each other for the curvature thereabouts. Infinite where no ray was lost and none spread too fast.
  double complete_to() const { return complete_to_; }

  int evaluations() const { return evaluations_; }

  static constexpr double kReach = 1.05;

 private:
  struct Sample {
    double s;
    Xyz X, T, n;
    double y, dy;
    double step;
    bool inside;  // the surface's domain
  };
  struct Ray {
    double t = 0.0;
    double from = 0.0;  ///< where it is needed: before, the rays that it came between are close to each other
    bool lost = true;
    std::vector<Sample> samples;
    double y_at(double s) const;
  };
  /// A part of a ray, from the sample before `sample` to that, and the rays beside it that are needed there.
  struct Part {
    int ray, sample;
    int before, after;
    double turn;  ///< to the farther of the two
  };

  class Builder;
  int neighbour(int ray, double s, int way) const;
  Part part(int ray, int sample) const;
  double change(const Part& part, double s, double y) const;
  std::optional<AtlasHit> look(const Part& part, const Xyz& x) const;
  BoxTree::Box box(const Part& part) const;
  void index_parts();

  AtlasOptions options_;
  std::vector<Ray> rays_;  // by angle
  std::vector<Part> parts_;
  BoxTree tree_;  // of parts_
  double complete_to_ = std::numeric_limits<double>::infinity();
  int evaluations_ = 0;
};

}  // namespace geovor
