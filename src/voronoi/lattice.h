// A lattice of points over the parameter rectangle of a face, fine enough in space to carry labels.
#pragma once

#include <array>
#include <vector>

#include "brep/face_domain.h"

namespace geovor {

/// Nodes on lines u = const and v = const over FaceDomain::box(), the lines placed by length in space: neighbours are
/// about `spacing` apart at most, and closer where the surface bends. Around a full period the lattice closes; a line
/// on which the metric vanishes (a pole) is moved half a cell inwards, and a node that would coincide with one of the
/// points `avoid` (where polar coordinates about that point mean nothing) a little aside. Nodes outside the trims are
/// kept: geodesics of the surface run through there.
class FaceLattice {
 public:
  FaceLattice(const FaceDomain& domain, double spacing, const std::vector<Uv>& avoid);

  int count() const { return static_cast<int>(uv_.size()); }
  Uv uv(int node) const { return uv_[node]; }
  const Xyz& xyz(int node) const { return xyz_[node]; }
  bool inside(int node) const { return inside_[node]; }  ///< in the face
  double reach(int node) const { return reach_[node]; }  ///< length in space of the longest edge at the node

  struct Neighbour {
    int node = -1;
    Uv uv;  ///< its copy next to the node asked for
  };
  /// Up to eight: along the lines and across the cells.
  std::vector<Neighbour> neighbours(int node) const;

  /// The nodes of the cell that holds p.
  std::array<int, 4> corners(Uv p) const;

 private:
  struct Axis {
    std::vector<double> lines;
    double period = 0.0;  ///< 0: does not close
    int count() const { return static_cast<int>(lines.size()); }
    /// The line left of x and the one right of it.
    std::array<int, 2> around(double x) const;
  };
  int index(int i, int j) const { return j * u_.count() + i; }
  void place_lines(const FaceDomain& domain, double spacing);
  void fill_nodes(const FaceDomain& domain);
  void step_aside(const FaceDomain& domain, const std::vector<Uv>& avoid);

  Axis u_, v_;
  std::vector<Uv> uv_;
  std::vector<Xyz> xyz_;
  std::vector<char> inside_;
  std::vector<double> reach_;
};

/// Area of the face to a few percent, from a coarse grid: what spacings are chosen by.
double rough_area(const FaceDomain& domain);

}  // namespace geovor
