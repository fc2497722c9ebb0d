// The lower envelope of linear distances. Private to near_ties.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "voronoi/site_ray.h"

namespace geovor {

/// Vertices and edges of the envelope of d_k + <T_k, p>, p in the tangent plane at the rays' common end, in the frame
/// (T, N) of the first ray.
class TieTree {
 public:
  struct Node {
    Eigen::Vector2d p;
    std::vector<int> corners;  ///< the generators that meet, counter-clockwise
  };
  /// An edge on the bisector base + a tangent of two generators, travelled from node `from` to node `to`; -1: it comes
  /// from far, goes on for ever.
  struct Branch {
    int right, left;
    int from, to;
    Eigen::Vector2d base, tangent;
  };

  /// `generators`: two or more, counter-clockwise. `tie`: distances that differ by less are equal, model units.
  TieTree(const std::vector<SiteRay>& generators, double tie);

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Branch>& branches() const { return branches_; }

 private:
  void grow(int i, int j, int parent);
  std::vector<int> next_polygon(const Branch& branch) const;
  Eigen::Vector2d meeting_point(const std::vector<int>& corners) const;
  double distance(int k, const Eigen::Vector2d& p) const { return s_[k] + T_[k].dot(p); }

  std::vector<double> s_;
  std::vector<Eigen::Vector2d> T_;
  double tie_;
  std::vector<Node> nodes_;
  std::vector<Branch> branches_;
};

}  // namespace geovor
