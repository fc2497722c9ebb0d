// The empty-ball test: which sites are nearer to a point than a given length, and by which geodesics.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "geodesic/polar_atlas.h"
#include "geodesic/survey.h"
#include "surface/tangent_frame.h"
#include "voronoi/site_ray.h"
#include "voronoi/site_tree.h"

namespace geovor {

/// Complete because a chord is no longer than a geodesic: only sites in the ball of radius `limit` about a point count,
/// and of these every geodesic is found, by closed form, by the curvature survey (which says that there is one only),
/// or by a search all round the site. They are those of the surface continued a little beyond its domain (kBeyond);
/// where the curvature of the domain allows one geodesic in it only, others through what lies beyond are not looked
/// for. Geodesics beyond their first conjugate point are never shortest and left out.
///
/// What is found out about a site is kept (mutable): one thread at a time.
class NearbySites {
 public:
  /// REQUIRES: `rays`, its surface and its sites outlive the object
  explicit NearbySites(const SiteRays& rays);

  /// Every geodesic from a site to m that is shorter than `limit`, but those of `known` (same_generator), by length;
  /// each as exact as SiteRays::to(). A site at m itself has no direction there: its ray has the length 0 and y = 0.
  std::vector<SiteRay> nearer_than(double limit, Uv m, const std::vector<SiteRay>& known) const;

  /// The same to kRoughly.
  std::vector<SiteRay> roughly_nearer_than(double limit, Uv m, const std::vector<SiteRay>& known) const;

  /// The shortest geodesic from any site to m, and after it those that tie with it to kTie. Empty where none can be
  /// computed.
  std::vector<SiteRay> nearest(Uv m) const;

  /// Sites within r of x in a straight line, nearest first.
  std::vector<int> in_ball(const Xyz& x, double r) const { return tree_.in_ball(x, r); }

  /// The site nearest to a site in a straight line; -1 if it is alone.
  int nearest_other(int site) const { return tree_.nearest(tree_.point(site), site); }

  const Xyz& position(int site) const { return tree_.point(site); }

  /// Whether no geodesic of `site` shorter than `limit` can have been missed: false where a part of the search all
  /// round the site was lost, or where from something that was found no geodesic could be computed.
  bool complete_to(int site, double limit) const;

  /// The same, of lost parts of the search alone, for what was asked so far: of queries about greater lengths than
  /// `limit` only that part counts. Searches nothing anew.
  bool complete_as_asked(int site, double limit) const;

  /// Whether the curvature is known to allow no two geodesics shorter than `limit` from the site to one point.
  bool unique_to(int site, double limit) const;

  static constexpr double kTie = 1e-10;
  /// In parts of the domain's extents.
  static constexpr double kBeyond = 0.25;

 private:
  /// Up to `certain` the curvature allows one geodesic to a point only; from `open` on it does not say so.
  struct Knowledge {
    double certain = 0.0, open = std::numeric_limits<double>::infinity();
    double doubtful = std::numeric_limits<double>::infinity();  ///< from here on something may be missing
    double searched = 0.0;                                      ///< the longest limit of a search all round
  };
  struct Query {
    Uv m;
    Xyz x;
    double limit;
    bool roughly = false;
  };
  std::vector<SiteRay> nearer_than(const Query& q, const std::vector<SiteRay>& known) const;
  void add(const Query& q, int site, const std::vector<SiteRay>& known, std::vector<SiteRay>& found) const;
  bool add_unique(const Query& q, int site, std::vector<SiteRay>& found) const;
  void add_closed_form(const Query& q, int site, const std::vector<SiteRay>& known, std::vector<SiteRay>& found) const;
  void add_searched(const Query& q, int site, const std::vector<SiteRay>& known, std::vector<SiteRay>& found) const;
  std::vector<SiteRay> tied_within(double limit, Uv m) const;
  double some_way(Uv m, const Xyz& x) const;
  SiteRay no_way(const Query& q, int site) const;
  std::optional<SiteRay> settle(const Query& q, int site, const AtlasHit& hit) const;
  const PolarAtlas& atlas(int site, double limit) const;

  const SiteRays& rays_;
  bool closed_form_;
  SiteTree tree_;
  double extent_ = 0.0;  ///< of the sites, in space, to a factor of two
  std::optional<SurfaceSurvey> survey_;
  std::vector<TangentFrame> frames_;
  mutable std::vector<Knowledge> known_;
  mutable std::vector<std::unique_ptr<PolarAtlas>> atlases_;
};

}  // namespace geovor
