// The border of a face as closed cycles that a walk around a cell can follow. Seams and poles are no border.
#pragma once

#include <optional>
#include <vector>

#include "brep/face_domain.h"

namespace geovor {

/// A place on the border: segment k of a cycle at fraction f is parameter k + f.
struct BorderPlace {
  int cycle = -1;
  double parameter = 0.0;
};

/// The border of a FaceDomain, cut at seams and poles and linked again in space, the face to the left. Its segments are
/// short parts of the rectangle around the face, so that a polyline that jumps by a period has crossed a seam.
class FaceBorder {
 public:
  explicit FaceBorder(const FaceDomain& domain);

  int cycle_count() const { return static_cast<int>(cycles_.size()); }
  int segment_count(int cycle) const { return static_cast<int>(cycles_[cycle].size()); }

  Uv uv(BorderPlace place) const;
  Xyz xyz(BorderPlace place) const { return xyz_of(uv(place)); }
  Xyz xyz_of(Uv p) const { return domain_.surface().position(p); }
  /// Length in space of the k-th segment, to a percent or so.
  double segment_length(int cycle, int k) const;
  /// Direction of the segment at the place, with the face to the left.
  UvVec direction(BorderPlace place) const;

  struct Crossing {
    BorderPlace place;
    double fraction = 0.0;  ///< of the chord
  };
  /// The first place where the straight segment from a to b, in any periodic copy, meets the border at a fraction of at
  /// least `from`.
  std::optional<Crossing> first_crossing(Uv a, Uv b, double from) const;

  /// The place of the border nearest to p, measured with the metric at p; nothing where there is no border.
  std::optional<BorderPlace> nearest(Uv p) const;

  /// The polyline from one place on to another of the same cycle, both included. From a place to itself: once around.
  std::vector<Uv> stretch(BorderPlace from, BorderPlace to) const;

 private:
  struct Segment {
    Uv a, b;
  };
  struct Block {
    int cycle, first, last;
    UvBox box;
  };
  void split_long_segments();
  void link(const std::vector<std::vector<Segment>>& open_chains);
  void build_blocks();

  const FaceDomain& domain_;
  std::vector<std::vector<Segment>> cycles_;
  std::vector<Block> blocks_;  ///< runs of segments with their bounding boxes
  std::vector<UvVec> shifts_;  ///< the copies of a chord that may meet the border
};

}  // namespace geovor
