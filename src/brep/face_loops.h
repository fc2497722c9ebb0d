// What the loops of a face say, before anything is sampled. Private to the room.
#pragma once

#include <vector>

#include "brep/model.h"

namespace geovor {

/// A straight segment of the parameter plane, t from 0 to 1.
class UvLine final : public Curve2 {
 public:
  UvLine(Uv a, Uv b) : a_(a), b_(b) {}
  Interval domain() const override { return {0.0, 1.0}; }
  CurveJet<2> jet(double t) const override {
    const Uv p = lerp(a_, b_, t);
    return {{p.u, p.v}, {b_.u - a_.u, b_.v - a_.v}, {0.0, 0.0}, {0.0, 0.0}};
  }

 private:
  Uv a_, b_;
};

/// The face's loops or, where it has none, one counter-clockwise loop around its surface's domain.
/// Throws Error(FaceRejected) where there is no surface, or no loop and an unbounded domain.
std::vector<TrimLoop> loops_or_whole_domain(const CadFace& face);

/// How often the face uses each edge of the model: entry i for edge i.
std::vector<int> edge_uses(const std::vector<TrimLoop>& loops);

/// Whether the face ends at the coedge: false for a pole and for a seam (an edge that the face uses twice), and for the
/// sides of a whole domain that a period joins or that are poles.
bool is_border(const CadModel& model, const Surface& surface, const Coedge& coedge, const std::vector<int>& uses);

}  // namespace geovor
