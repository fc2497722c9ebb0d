// Where the nearest generator changes along a path: the points from which edges of the diagram are traced.
#pragma once

#include <functional>
#include <vector>

#include "voronoi/labels.h"

namespace geovor {

/// A path of the parameter plane, continuous on the surface.
using UvPath = std::function<Uv(double)>;

/// The nearest generator changes from `before` to `after`; both rays end at path(at) and are equally long, to
/// kDistanceNoise of their length.
struct LabelChange {
  double at = 0.0;
  SiteRay before, after;
};

/// The generators around path(at), by length.
struct LabelledPlace {
  double at = 0.0;
  std::vector<SiteRay> candidates;
};

/// The changes between two places of a path, in order. Finds every change that is left when one knows the nearest
/// generators at both places and at each place where two of those are equally near; a generator that is nearest only
/// somewhere in between is not noticed.
std::vector<LabelChange> label_changes(const CandidateLabels& labels, const UvPath& path, const LabelledPlace& from,
                                       const LabelledPlace& to);

/// Whether two nodes (a and b at distance `step`) have the same nearest generator, told from their labels alone.
bool same_label(const SiteRay& a, const SiteRay& b, double step);

}  // namespace geovor
