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

/// The border of a FaceDomain, cut at seams and poles and linked again in space, the face to the left. Places lie on
/// the true p-curves; the segments are the chords of the domain's polyline, cut further into short parts of the
/// rectangle around the face, so that a polyline that jumps by a period has crossed a seam. Within a segment the border
/// is analytic. The domain outlives it.
class FaceBorder {
 public:
  explicit FaceBorder(const FaceDomain& domain);

  int cycle_count() const { return static_cast<int>(cycles_.size()); }
  int segment_count(int cycle) const { return static_cast<int>(cycles_[cycle].size()); }
  const FaceDomain& domain() const { return domain_; }

  Uv uv(BorderPlace place) const;
  Xyz xyz(BorderPlace place) const { return xyz_of(uv(place)); }
  Xyz xyz_of(Uv p) const { return domain_.surface().position(p); }
  /// The k-th segment at fraction f; at f = 1 its own end, where the next segment may start beyond a seam.
  Uv uv_in_segment(int cycle, int k, double f) const { return cycles_[cycle][k].at(f); }
  /// Length in space of the k-th segment, to a percent or so.
  double segment_length(int cycle, int k) const;
  /// The derivative of uv() with respect to the place's parameter, with the face to the left.
  UvVec direction(BorderPlace place) const;

  struct Crossing {
    BorderPlace place;
    double fraction = 0.0;  ///< of the chord
  };
  /// The first place where the straight segment from a to b, in any periodic copy, meets the border at a fraction of at
  /// least `from`. What decides that they meet is the domain's polyline, as for FaceDomain::contains(); the place is
  /// the one on the true border. A positive `from` is for a segment that starts on the border: what lies before it on
  /// the true border is left out.
  std::optional<Crossing> first_crossing(Uv a, Uv b, double from) const;

  /// The place of the border nearest to p, measured with the metric at p; nothing where there is no border.
  std::optional<BorderPlace> nearest(Uv p) const;

  /// Whether the border may come nearer to the point x of space than `distance`: false is certain, so that no path of
  /// that length which starts at x meets the border; true may be wrong by a part of a segment.
  bool near_border(const Xyz& x, double distance) const;

  /// The polyline from one place on to another of the same cycle, both included; its points lie on the true border.
  /// From a place to itself: once around.
  std::vector<Uv> stretch(BorderPlace from, BorderPlace to) const;

 private:
  /// A box of space around a segment or a run of them.
  struct SpaceBox {
    Xyz lower, upper;
    void include(const SpaceBox& other);
    double least_distance(const Xyz& x) const;
  };
  struct SegmentId {
    int cycle, k;
  };
  void split_long_segments();
  void link(const std::vector<std::vector<BorderChord>>& open_chains);
  void build_trees();
  SpaceBox space_box(const BorderChord& s) const;
  std::optional<Crossing> refined(SegmentId id, Uv a, Uv b, double across, double along, double from) const;
  void refine_nearest(Uv p, const FirstForm& I, BorderPlace& place) const;

  const FaceDomain& domain_;
  std::vector<std::vector<BorderChord>> cycles_;
  std::vector<SegmentId> order_;  ///< of the leaves of the trees
  NestedBoxes<ChordBox> tree_;
  NestedBoxes<SpaceBox> space_tree_;
  std::vector<UvVec> shifts_;  ///< the copies of a chord that may meet the border
};

}  // namespace geovor
