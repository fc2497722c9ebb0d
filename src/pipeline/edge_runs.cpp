#include "pipeline/edge_runs.h"

#include <algorithm>
#include <cmath>

namespace geovor {
namespace {

double whole_periods(double difference, const std::optional<double>& period) {
  return period ? *period * std::round(difference / *period) : 0.0;
}

enum class Spot { Free, Seam, Pole };

class EdgeCutter {
 public:
  EdgeCutter(const FaceOutline& outline, const VoronoiDiagram& diagram, double snap, double reach)
      : outline_(outline), diagram_(diagram), snap_(snap), reach_(reach) {}

  void cut(int e) {
    edge_ = e;
    const DiagramEdge& edge = diagram_.edges[e];
    const std::vector<Place> line = with_poles(edge);
    const Spot first = spot(line.front().uv);
    begin(line.front().uv, end_of(edge.from, line.front().uv, first), first);
    for (size_t i = 1; i < line.size(); ++i) {
      const Spot at = spot(line[i].uv);
      const bool last = i + 1 == line.size();
      go_on(line[i], at, last, last ? end_of(edge.to, line[i].uv, at) : RunEnd{});
      before_ = at;
    }
  }

  EdgeRuns take() { return std::move(out_); }

 private:
  struct Place {
    Uv uv;
    Xyz xyz;
  };

  /// The edge's points, and the poles that it runs through between two of them: beside a pole the parameters of two
  /// neighbours do not tell on which side it lies.
  std::vector<Place> with_poles(const DiagramEdge& edge) const {
    std::vector<Place> line;
    for (const EdgePoint& p : edge.points) {
      if (!line.empty()) {
        for (const OutlineSide& side : outline_.sides()) {
          if (side.pole && runs_through(line.back().xyz, p.xyz, outline_.surface().position(side.uv.front()))) {
            line.push_back({side.uv.front(), outline_.surface().position(side.uv.front())});
          }
        }
      }
      line.push_back({p.uv, p.xyz});
    }
    return line;
  }

  bool runs_through(const Xyz& a, const Xyz& b, const Xyz& pole) const {
    const Xyz way = b - a;
    const double k = (pole - a).dot(way) / way.squaredNorm();
    const double near = std::min((pole - a).norm(), (pole - b).norm());
    return k > 0.0 && k < 1.0 && near > snap_ && (a + k * way - pole).norm() <= diagram_.tolerance;
  }

  void go_on(const Place& p, Spot at, bool last, RunEnd end) {
    if (at != Spot::Free && before_ != Spot::Free && in_seam(here_, p.uv)) {
      follow_seam(p.uv, end, at);
    } else if (at == Spot::Pole) {
      // The parameter along the pole means nothing: the run arrives on the meridian on which it came.
      step_to(arrival(here_, p.uv), p.xyz, at);
      finish({end.vertex, -1, 0.0}, SideKind::Pole);
      begin(p.uv, {end.vertex, -1, 0.0}, at);
    } else {
      step_to(p.uv, p.xyz, at);
      if (at == Spot::Seam) {
        finish(end, SideKind::Seam);
        begin(p.uv, end, at);
      } else if (last) {
        finish(end, SideKind::Border);
      }
    }
  }

  RunEnd end_of(int vertex, Uv p, Spot at) const {
    RunEnd end{vertex, -1, 0.0};
    if (vertex < 0 || at != Spot::Free || !diagram_.vertices[vertex].on_boundary) return end;
    const OutlinePlace place = outline_.nearest(p, SideKind::Border, reach_);
    end.side = place.side, end.t = place.t;
    return end;
  }

  Spot spot(Uv p) const {
    if (outline_.nearest(p, SideKind::Pole, snap_).side >= 0) return Spot::Pole;
    return outline_.nearest(p, SideKind::Seam, snap_).side >= 0 ? Spot::Seam : Spot::Free;
  }

  /// The copy of b that is near a.
  Uv near(Uv a, Uv b) const {
    const Surface& s = outline_.surface();
    return {b.u - whole_periods(b.u - a.u, s.u_period()), b.v - whole_periods(b.v - a.v, s.v_period())};
  }

  bool in_seam(Uv a, Uv b) const { return outline_.nearest(lerp(a, near(a, b), 0.5), SideKind::Seam, snap_).side >= 0; }

  void begin(Uv p, RunEnd end, Spot at) {
    run_ = {edge_, end, {}, {}, {}};
    here_ = p, before_ = at, open_ = end;
    if (at == Spot::Free) add(end.side >= 0 ? outline_.sides()[end.side].at(end.t) : p);
  }

  void add(Uv p) { add(p, outline_.surface().position(p)); }
  void add(Uv p, const Xyz& x) {
    run_.uv.push_back(p);
    run_.xyz.push_back(x);
    here_ = p;
  }

  /// On from here_ to p, across the seams between them.
  void step_to(Uv p, const Xyz& x, Spot at) {
    if (before_ != Spot::Free && run_.uv.empty()) leave_seam(p);
    for (int crossings = 0; crossings < kMostCrossings; ++crossings) {
      const Uv ahead = near(here_, p);
      const UvVec shift = ahead - p;
      OutlinePlace place;
      for (UvVec part : {UvVec{shift.u, 0.0}, UvVec{0.0, shift.v}}) {
        if (part.u == 0.0 && part.v == 0.0) continue;
        const OutlinePlace found = outline_.crossing(here_, ahead, part);
        if (found.side >= 0 && (place.side < 0 || nearer(here_, found, place))) place = found;
      }
      if (place.side < 0) break;
      const OutlineSide& side = outline_.sides()[place.side];
      const Xyz meets = outline_.surface().position(side.at(place.t));
      if (at == Spot::Seam && (meets - x).norm() <= kSideReach * snap_) {  // it ends there
        add(side.at(place.t), x);
        return;
      }
      finish({-1, place.side, place.t}, SideKind::Seam);
      run_ = {edge_, {-1, side.partner, place.t}, {}, {}, {}};
      add(outline_.sides()[side.partner].at(place.t));
    }
    add(p, x);
  }

  bool nearer(Uv from, const OutlinePlace& a, const OutlinePlace& b) const {
    const auto far = [&](const OutlinePlace& p) {
      const UvVec way = outline_.sides()[p.side].at(p.t) - from;
      return std::hypot(way.u / outline_.box().u.length(), way.v / outline_.box().v.length());
    };
    return far(a) < far(b);
  }

  /// The run starts on the side of the seam (or on the meridian through the pole) that faces p.
  void leave_seam(Uv p) {
    RunEnd start = open_;
    const SideKind kind = before_ == Spot::Pole ? SideKind::Pole : SideKind::Seam;
    const Uv from = kind == SideKind::Pole ? arrival(p, here_) : near(p, here_);
    const OutlinePlace place = outline_.nearest(from, kind, kSideReach * snap_);
    start.side = place.side, start.t = place.t;
    run_.from = start;
    add(place.side >= 0 ? outline_.sides()[place.side].at(place.t) : from);
  }

  Uv arrival(Uv from, Uv pole) const {
    const OutlinePlace place = outline_.nearest(pole, SideKind::Pole, snap_);
    const OutlineSide& side = outline_.sides()[place.side];
    const bool along_u =
        std::abs(side.uv.back().u - side.uv.front().u) > std::abs(side.uv.back().v - side.uv.front().v);
    return along_u ? Uv{from.u, side.uv.front().v} : Uv{side.uv.front().u, from.v};
  }

  /// Ends the run; on the outline where its end lies there.
  void finish(RunEnd end, SideKind kind) {
    if (kind != SideKind::Border && end.side < 0) {
      const OutlinePlace place = outline_.nearest(here_, kind, kSideReach * snap_);
      end.side = place.side, end.t = place.t;
    }
    if (end.side >= 0) {
      const Uv p = outline_.sides()[end.side].at(end.t);
      // The last point gives way to the place on the outline, unless the run has only its first.
      if (run_.uv.size() > 1 && kind_is_here(p)) run_.uv.pop_back(), run_.xyz.pop_back();
      add(p);
    }
    run_.to = end;
    if (run_.uv.size() > 1) out_.runs.push_back(std::move(run_));
    run_ = {};
  }

  bool kind_is_here(Uv p) const { return (outline_.surface().position(p) - run_.xyz.back()).norm() <= reach_; }

  void follow_seam(Uv p, RunEnd end, Spot at) {
    const Uv middle = lerp(here_, near(here_, p), 0.5);
    const OutlinePlace seam = outline_.nearest(middle, SideKind::Seam, snap_);
    const auto on = [&](Uv q, RunEnd e) {
      const OutlineSide& s = outline_.sides()[seam.side];
      const OutlinePlace place = outline_.nearest(near(middle, q), SideKind::Seam, kSideReach * snap_);
      e.side = seam.side;
      e.t = place.side == seam.side ? place.t : middle_end(s, q);
      return e;
    };
    out_.in_seams.push_back({edge_, on(here_, open_), on(p, end)});
    begin(p, end, at);
  }

  /// The end of the side that is nearer to q.
  double middle_end(const OutlineSide& s, Uv q) const {
    const Xyz x = outline_.surface().position(q);
    const auto far = [&](Uv p) { return (outline_.surface().position(p) - x).norm(); };
    return far(s.uv.front()) < far(s.uv.back()) ? s.t.front() : s.t.back();
  }

  // A seam's other side is reached from a copy that is off by rounding.
  static constexpr double kSideReach = 10.0;
  static constexpr int kMostCrossings = 4;  // a corner of the two seams of a torus gives two

  const FaceOutline& outline_;
  const VoronoiDiagram& diagram_;
  double snap_, reach_;
  EdgeRuns out_;
  int edge_ = -1;
  EdgeRun run_;
  RunEnd open_;  ///< where the run in hand starts
  Uv here_;
  Spot before_ = Spot::Free;  ///< of here_
};

}  // namespace

EdgeRuns cut_edges(const FaceOutline& outline, const VoronoiDiagram& diagram, double snap, double reach) {
  EdgeCutter cutter(outline, diagram, snap, reach);
  for (int e = 0; e < static_cast<int>(diagram.edges.size()); ++e) {
    const DiagramEdge& edge = diagram.edges[e];
    if (edge.kind != EdgeKind::CutLocus && edge.points.size() > 1) cutter.cut(e);
  }
  return cutter.take();
}

}  // namespace geovor
