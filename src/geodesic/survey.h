// What is known of a surface everywhere, from samples on a grid of cells: how far a path of some length gets in the
// parameters, and how much the surface is curved where it gets to.
#pragma once

#include <optional>
#include <vector>

#include "surface/surface.h"

namespace geovor {

class SurfaceSurvey {
 public:
  /// `most_cells` in each direction, where the surface is curved so much that fewer are too wide to tell anything.
  explicit SurfaceSurvey(const Surface& surface, int most_cells);

  /// The same of a box of the domain alone, as of one that is infinite. Nothing is known of what reaches a side of the
  /// box that is not the domain's.
  SurfaceSurvey(const Surface& surface, const UvBox& box, int most_cells);

  /// A rectangle of the parameter plane that holds every path of a length from a point, with bounds of what is in it.
  struct Region {
    UvBox box;
    double gauss = 0.0;  ///< the Gaussian curvature is nowhere larger
    double total = 0.0;  ///< the integral of the curvature, where it is positive, is no larger
  };

  /// Nothing where the rectangle would wrap a period, reaches a place without tangent plane (a pole) or holds a
  /// total of 2 pi, or the surface has creases, which hold curvature of their own. The bounds are those of samples,
  /// with an allowance for what lies between them; they are no proof for a surface that changes from one sample to the
  /// next beyond recognition.
  std::optional<Region> ball(Uv centre, double radius) const;

 private:
  struct Sample {
    double rate_u, rate_v, gauss, density;  // density: of the area
    double bend_u, bend_v;                  // what a unit of u, of v turns at most
  };
  struct Cell {
    double rate_u = 0.0, rate_v = 0.0;  ///< |du/ds|, |dv/ds| of a path are no larger
    double gauss = 0.0, total = 0.0;
  };
  /// Of one direction: the cells, by index, and whether they go on periodically.
  struct Axis {
    Interval range;
    bool periodic = false;
    int cells = 0;
    bool cut_low = false, cut_high = false;  ///< the domain goes on there
    static Axis of(Interval range, Interval domain, bool periodic);
    bool leaves(double x, double r) const { return (cut_low && x - r < range.lo) || (cut_high && x + r > range.hi); }
    double cell() const;
    int wrapped(int i) const { return (i % cells + cells) % cells; }
    Interval reached(double x, double r) const;
    bool wraps(double r) const { return periodic && 2.0 * r >= range.length(); }
    int first(Interval reach) const;
    int last(Interval reach) const;
  };
  static Sample sample(const Surface& surface, Uv p);
  static Sample where_parameters_end(const UvBox& domain, Uv p, const SurfaceJet& j);
  std::vector<Sample> take(const Surface& surface) const;
  template <class Value>
  double bound(const std::vector<Sample>& samples, int i, int j, Value value) const;
  void add_cell(const std::vector<Sample>& samples, int i, int j);

  bool usable_ = false;
  Axis u_, v_;
  std::vector<Cell> cells_;
};

/// No other geodesic from the region's centre, inside the region, ends where one of length `length` ends and is shorter
/// than this; negative or zero where nothing is known.
///
/// Why. Two geodesics between the same points, or a part of them, bound a disk D in the parameter plane, which is in
/// the region since that is a rectangle. With its inner metric D is a surface of curvature <= k with a border that is
/// geodesic but for corners, hence locally CAT(k). If the two together are shorter than 2 pi / sqrt(k), D is not CAT(k)
/// globally, and then holds a closed geodesic of its inner metric that is no longer (Bridson and Haefliger, Metric
/// Spaces of Non-Positive Curvature, II.4.16). That bends, if at all, round corners that lie outside of it, so that by
/// Gauss and Bonnet the disk that it bounds has a total curvature of at least 2 pi. Where the region's is less there
/// are no two such geodesics. A path along the domain's border is a geodesic of the inner metric too: the argument
/// holds for the border's neighbourhood as it stands.
double second_geodesic_at_least(const SurfaceSurvey::Region& region, double length);

}  // namespace geovor
