// The border of a face in its parameter plane, coedge by coedge, seams and poles included.
#pragma once

#include <vector>

#include "base/interval.h"
#include "brep/model.h"

namespace geovor {

/// A coedge as a polyline that knows its parameters.
struct OutlineSide {
  int loop = -1, index = -1;  ///< coedge `index` of loop `loop`
  int edge = -1;              ///< of the model
  int partner = -1;           ///< the other side of a seam
  bool pole = false;
  bool reversed = false;
  int next = -1;          ///< the side that follows in the loop
  std::vector<double> t;  ///< ascending
  std::vector<Uv> uv;
  std::vector<Xyz> xyz;     ///< of the points
  std::vector<double> arc;  ///< length of the polyline in space up to each
  double deviation = 0.0;   ///< of the curve's middles from those of the polyline's segments, at most
  Curve2Ptr pcurve;
  Uv at(double parameter) const;
};

struct OutlinePlace {
  int side = -1;
  double t = 0.0;
  double off = 0.0;  ///< distance in space
};

/// Which sides of an outline a question is about.
enum class SideKind { Border, Seam, Pole };

class FaceOutline {
 public:
  /// Polylines that lie within `deflection` of the border, in space. Throws Error(FaceRejected) where a p-curve is
  /// missing.
  FaceOutline(const CadModel& model, const CadFace& face, double deflection);

  const std::vector<OutlineSide>& sides() const { return sides_; }
  const Surface& surface() const { return *surface_; }
  const UvBox& box() const { return box_; }
  static SideKind kind(const OutlineSide& side);
  bool has(SideKind kind) const;

  /// The nearest place of the sides of a kind, by the way to it in the parameter plane; side -1 where nothing lies
  /// within `reach` (space).
  OutlinePlace nearest(Uv p, SideKind kind, double reach) const;

  /// The place where the segment from a to b first meets a seam whose other side is moved by -shift; side -1: nowhere.
  OutlinePlace crossing(Uv a, Uv b, UvVec shift) const;

  /// The points of a side strictly between two parameters.
  std::vector<Uv> between(int side, double t0, double t1) const;

 private:
  void sample(OutlineSide& side, double t0, double t1, double deflection, int depth) const;
  OutlinePlace nearest_pole(Uv p, double reach) const;
  /// The parameter at which a segment of a side passes x.
  double foot(const OutlineSide& side, size_t segment, const Xyz& x) const;

  SurfacePtr surface_;
  std::vector<OutlineSide> sides_;
  UvBox box_;
};

}  // namespace geovor
