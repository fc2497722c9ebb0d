// The region of the parameter plane that a face covers, and what can be asked of it.
#pragma once

#include <optional>
#include <vector>

#include "brep/border_chord.h"
#include "brep/border_index.h"
#include "brep/chord_box.h"
#include "brep/face_area.h"
#include "brep/model.h"
#include "brep/nested_boxes.h"
#include "brep/parameter_stretch.h"

namespace geovor {

/// The trimmed region of a face, with its border flattened to polylines in the parameter plane. A face without loops
/// covers its surface's whole domain. Immutable, so that any number of threads may ask.
class FaceDomain {
 public:
  /// `deflection`: how far, in space, the flattened border may lie from the true one; the bound is of first order, and
  /// the surface's own curvature doesn't count.
  /// Throws Error(FaceRejected) where the face has no surface, a p-curve is missing or not finite, or the region is
  /// unbounded; Error(Usage) where the deflection is not positive.
  FaceDomain(const CadModel& model, const CadFace& face, double deflection);

  /// Whether p lies in the face, its border included (to rounding). In a periodic direction every copy of p counts.
  bool contains(Uv p) const;

  /// The copy of p (shifted by whole periods) that lies in the face, or p itself where none does. Where p does, it
  /// stays.
  Uv to_principal(Uv p) const;

  /// Distance in space, to first order through the metric at p, from p to the flattened border. Seams and poles are no
  /// border; infinity where there is none. In a periodic direction the nearest copy counts.
  double distance_to_border(Uv p) const;

  /// A place on a polyline, path[segment] + k (path[segment + 1] - path[segment]).
  struct PathPlace {
    int segment = 0;
    double k = 0.0;
    Uv uv;
  };
  /// Where a polyline (with values that run on across seams) leaves the face, and where it comes back.
  struct Exit {
    PathPlace out;                  ///< the last place inside, on the border
    std::optional<PathPlace> back;  ///< the next place inside, on the border; nothing where the path stays outside
  };
  /// The first excursion of the path from the face, or nothing where it stays inside; `out` is path[0] where it starts
  /// outside. An excursion that stays within `slack` (space) of the border, by default the deflection of the
  /// flattening, is none: a path along a curved border stays inside.
  std::optional<Exit> first_exit(const std::vector<Uv>& path, double slack) const;
  std::optional<Exit> first_exit(const std::vector<Uv>& path) const { return first_exit(path, deflection_); }

  /// The stretches of the line of this v that lie inside, ascending.
  std::vector<Interval> inside_at(double v) const;

  /// The smallest rectangle around the region.
  const UvBox& box() const { return index_.box(); }
  /// Closed polylines, first point not repeated; outer loops counter-clockwise, holes clockwise.
  const std::vector<std::vector<Uv>>& loops() const { return loops_; }
  /// chords()[i][k] runs from loops()[i][k] to the next point of that polyline.
  const std::vector<std::vector<BorderChord>>& chords() const { return chords_; }
  const Surface& surface() const { return *surface_; }
  double deflection() const { return deflection_; }

 private:
  void add_loop(std::vector<BorderChord> chords);
  std::vector<double> border_crossings(Uv a, Uv b) const;

  SurfacePtr surface_;
  double deflection_;
  std::vector<Curve2Ptr> curves_;  ///< kept alive for the chords
  std::vector<std::vector<Uv>> loops_;
  std::vector<std::vector<BorderChord>> chords_;
  std::vector<BorderSegment> border_;  ///< the segments that are neither seam nor pole
  NestedBoxes<ChordBox> border_tree_;
  BorderIndex index_;
};

}  // namespace geovor
