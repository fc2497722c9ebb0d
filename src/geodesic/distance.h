// The distance between two points of a surface: the shortest of the geodesics that join them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geodesic/connect.h"
#include "geodesic/survey.h"

namespace geovor {

struct Ends;

struct DistanceOptions {
  ConnectOptions connect;
  /// Cells of the coarse grid, in each direction, whose graph path is a second start beside the straight line; zero:
  /// none.
  int grid = 24;
  /// Whether far points are searched for all round by a fan of geodesics. Without it a distance that the curvature does
  /// not make certain stays uncertain.
  bool fan = true;
  /// Most cells, in each direction, of the survey of the surface's curvature that a finder makes: on a surface of many
  /// bumps more cells make more distances certain without a fan.
  int survey = 96;
};

/// Why the shortest path that was found is the shortest.
enum class Certainty {
  ClosedForm,  ///< the surface's geodesics are known in closed form
  Curvature,   ///< the points are too near to each other, for the curvature thereabouts, to have a second geodesic
  Fan,         ///< the geodesics that leave `from` were searched all round as far as the shortest path is long
  None,        ///< it is not certain; `doubt` says why
};

/// Why a distance is not certain.
enum class Doubt {
  None,
  NotConverged,  ///< no geodesic was found
  Degenerate,    ///< an end, or what lies between the two, has no tangent plane
  LeavesDomain,  ///< the path that was found leaves the domain: a shorter one within it would touch the border
  NotSearched,   ///< the points are far from each other and no fan was asked for
  FanLost,       ///< a part of the fan could not be followed
};

/// The first place at which a path leaves the surface's domain.
struct DomainExit {
  Uv at;
  double s = 0.0;  ///< arc length from the path's start
};

struct DistanceResult {
  ConnectStatus status = ConnectStatus::NotConverged;
  Connection shortest;
  /// All shortest paths where several tie within the accuracy (`from` and `to` are on each other's cut locus);
  /// else `shortest` alone. Empty unless converged.
  std::vector<Connection> shortest_paths;
  /// The shortest paths are a one-parameter family (antipodes of a sphere): every direction works, and
  /// `shortest_paths` holds one of them.
  bool family = false;
  std::vector<Connection> candidates;  ///< every different geodesic that was found, by length; the first is `shortest`
  Certainty certainty = Certainty::None;
  Doubt doubt = Doubt::NotConverged;
  /// With Certainty::Curvature: any other geodesic between the two is at least as long as this.
  double second_at_least = 0.0;
  /// Of `shortest`: it is then a geodesic of the surface continued, not of the domain.
  std::optional<DomainExit> leaves_at;
  int evaluations = 0;
};

/// One line in words: whether the distance is certain, and why (not).
std::string explain(const DistanceResult& result);

/// What is known of one surface once, so that a near query costs one connect(). Immutable: any number of threads may
/// ask it.
class DistanceFinder {
 public:
  explicit DistanceFinder(SurfacePtr surface, const DistanceOptions& options = {});
  /// REQUIRES: the surface outlives the finder.
  explicit DistanceFinder(const Surface& surface, const DistanceOptions& options = {});

  /// The shortest geodesic between two points of the surface's domain. `guess` saves time where it is good and costs
  /// nothing in safety where it is not.
  DistanceResult distance(Uv from, Uv to, std::optional<Polar> guess = std::nullopt) const;

  const Surface& surface() const { return *surface_; }

 private:
  bool settled_by_curvature(Uv from, DistanceResult& result) const;
  void search_far(Uv from, Uv to, DistanceResult& result) const;
  bool search_fan_of(const Ends& ends, double bound, DistanceResult& result) const;

  SurfacePtr surface_;
  DistanceOptions options_;
  std::optional<SurfaceSurvey> survey_;
};

/// The same for a single question: makes a finder for it.
DistanceResult distance(const Surface& surface, Uv from, Uv to, const DistanceOptions& options = {});

}  // namespace geovor
