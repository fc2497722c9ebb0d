// Keeps an eye on the sites that may come nearer while a bisector is being traced.
#pragma once

#include <vector>

#include "voronoi/bisector.h"
#include "voronoi/labels.h"

namespace geovor {

/// What a look at the next point of a chain found.
struct RivalVerdict {
  enum Kind {
    Clear,   ///< no other generator owns a point up to here, as far as values and slopes tell
    Unsure,  ///< one may have come and gone in between: look again after a shorter step
    Nearer,  ///< `rival` is nearer at the next point; it became so at about `fraction` of the step
  } kind = Clear;
  SiteRay rival;  ///< at the next point
  double fraction = 0.0;
};

/// The gap of a rival is its distance to the point less the chain's radius. It changes by at most twice the way
/// travelled, so that a rival with a wide gap needn't be looked at again soon.
class RivalWatch {
 public:
  RivalWatch(const CandidateLabels& labels, const BisectorPoint& start);

  /// Looks at `next`, a step after the last accepted point.
  RivalVerdict look(const BisectorPoint& next);
  /// The chain goes on from the point that was looked at last.
  void accept(const BisectorPoint& next);

 private:
  struct Rival {
    SiteRay ray;
    double gap, slope;
    double at;  ///< way travelled when it was looked at
  };
  void enlist(const BisectorPoint& m);
  bool known(const SiteRay& candidate, double slack) const;
  std::optional<SiteRay> ray_to(int site, const BisectorPoint& m, const Polar& guess) const;
  Rival measure(const SiteRay& ray, const BisectorPoint& m, double at) const;

  const CandidateLabels& labels_;
  BisectorPoint last_;
  double travelled_ = 0.0;
  std::vector<Rival> rivals_, looked_at_;
  std::vector<int> corners_seen_;
};

/// Smallest value, at sampled interior points, of the cubic with values g0, g1 and slopes s0, s1 at the ends of a step
/// h.
double cubic_minimum(double g0, double s0, double g1, double s1, double h);

/// Differences of distances below this part of the radius are rounding: a few times kBisectorTolerance.
inline constexpr double kDistanceNoise = 2e-11;

}  // namespace geovor
