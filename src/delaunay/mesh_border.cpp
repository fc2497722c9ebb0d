#include "delaunay/mesh_border.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "surface/pole_chart.h"
#include "surface/project.h"

namespace geovor {
namespace {

// Where the normals of both sides of a seam agree this well the surface goes on smoothly.
constexpr double kSmoothCosine = 0.9999;
// Places of a seam, or of a pole's side, at which the normals are looked at.
constexpr int kLooks = 9;
// A mean of unit normals that is shorter says nothing.
constexpr double kLeastMean = 1e-6;
// A nose turns the normal by more than this angle over the size; it is left by so many steps of this part of the size.
constexpr double kNose = 0.6, kStepInside = 0.15;
constexpr int kStepsInside = 3;
// Places that are nearer, in parts of the coordinates, are one; the first step across a strip, in parts of the way to
// the middle of the box; halvings that find its end.
constexpr double kOnePlace = 1e-12, kStripStep = 1e-3;
constexpr int kHalvings = 40;
// A direction that is nearer to that of the border, in radians, runs along it.
constexpr double kAlong = 1e-6;

Uv parameters_at(const Coedge& c, double t) {
  const auto p = c.pcurve->position(t);
  return {p.x(), p.y()};
}

// A strip of the parameters beside p may be one line of space, such as a trailing edge without thickness: where the
// surface begins behind it, straight across the strip; p itself where there is none.
Uv across_strip(const SurfaceProbe& probe, Uv p) {
  if (probe.at(p).regular) return p;
  const Xyz x = probe.position(p);
  const double near = kOnePlace * (1.0 + x.norm());
  for (const UvVec way : {UvVec{0.0, probe.box().v.middle() - p.v}, UvVec{probe.box().u.middle() - p.u, 0.0}}) {
    double flat = 0.0, beyond = kStripStep;
    while (beyond < 1.0 && (probe.position(p + beyond * way) - x).norm() < near) flat = beyond, beyond *= 2.0;
    if (flat == 0.0) continue;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (flat + beyond);
      ((probe.position(p + middle * way) - x).norm() < near ? flat : beyond) = middle;
    }
    if (probe.at(p + beyond * way).regular) return p + beyond * way;
  }
  return p;
}

// The points of one use of an edge, in the direction of the loop.
struct Run {
  std::vector<int> points;  ///< numbers among BorderPoints
  std::vector<Uv> uv;
  int loop = 0;
  int first = -1;        ///< the number of its first vertex
  int followed_by = -1;  ///< the run that goes on
};

class Collector {
 public:
  Collector(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border)
      : face_(face), probe_(probe), border_(border) {}

  MeshBorder run() {
    for (const TrimLoop& loop : face_.loops) {
      for (const Coedge& c : loop.coedges) uses_[c.edge].push_back(&c);
    }
    for (size_t i = 0; i < face_.loops.size(); ++i) {
      for (const Coedge& c : face_.loops[i].coedges) {
        if (border_.edges[c.edge].points.size() == 1) {
          look_at_pole(c);
        } else if (!is_smooth_seam(c)) {
          add_run(c, static_cast<int>(i));
        }
      }
    }
    if (link_runs()) {
      place_points();
      look_past_noses();
      add_tips();
    } else {
      result_.why = "its border is open";
    }
    check();
    return std::move(result_);
  }

 private:
  // Used twice, in opposite directions, at two places of the parameter plane that are a period apart.
  bool is_smooth_seam(const Coedge& c) const {
    const auto& both = uses_.at(c.edge);
    if (both.size() != 2 || both[0]->reversed == both[1]->reversed) return false;
    for (int i = 0; i < kLooks; ++i) {
      const double t = both[0]->range.lo + (i + 0.5) / kLooks * both[0]->range.length();
      const Uv p = parameters_at(*both[0], t), q = parameters_at(*both[1], t);
      if (p == q || !(probe_.at(p).n.dot(probe_.at(q).n) > kSmoothCosine)) return false;
    }
    return true;
  }

  void look_at_pole(const Coedge& c) {
    const Uv middle = parameters_at(c, c.range.lo + 0.5 * c.range.length());
    for (const auto& chart : probe_.surface().poles()) {
      if (chart->holds(middle)) return;
    }
    Xyz mean = Xyz::Zero();
    for (int i = 0; i < kLooks; ++i)
      mean += probe_.at(parameters_at(c, c.range.lo + (i + 0.5) / kLooks * c.range.length())).n;
    Tip& tip = tips_[border_.edges[c.edge].points[0]];
    tip.normals += mean;
    tip.uv = middle;
    (std::abs(parameters_at(c, c.range.lo).u - middle.u) > std::abs(parameters_at(c, c.range.lo).v - middle.v)
         ? tip.free_u
         : tip.free_v) = true;
  }

  void add_run(const Coedge& c, int loop) {
    const BorderPoints::Edge& e = border_.edges[c.edge];
    Run run;
    run.loop = loop;
    run.points = e.points;
    for (const double t : e.t) run.uv.push_back(parameters_at(c, t));
    if (c.reversed) {
      std::reverse(run.points.begin(), run.points.end());
      std::reverse(run.uv.begin(), run.uv.end());
    }
    runs_.push_back(std::move(run));
  }

  // The run after it in the loop, or, where a seam lay between, the first one that begins at its end.
  bool link_runs() {
    const int n = static_cast<int>(runs_.size());
    std::vector<char> is_taken(n, 0);
    const auto link = [&](int i, int k) {
      if (runs_[i].followed_by >= 0 || is_taken[k] || runs_[i].points.back() != runs_[k].points.front()) return;
      runs_[i].followed_by = k;
      is_taken[k] = 1;
    };
    for (int i = 0; i < n; ++i) {
      int k = (i + 1) % n;
      if (runs_[k].loop != runs_[i].loop)
        k = static_cast<int>(
            std::find_if(runs_.begin(), runs_.end(), [&](const Run& r) { return r.loop == runs_[i].loop; }) -
            runs_.begin());
      link(i, k);
    }
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) link(i, k);
    }
    return std::all_of(runs_.begin(), runs_.end(), [](const Run& r) { return r.followed_by >= 0; });
  }

  void place_points() {
    for (Run& run : runs_) {
      run.first = static_cast<int>(result_.points.size());
      for (size_t i = 0; i + 1 < run.points.size(); ++i) add_point(run.points[i], across_strip(probe_, run.uv[i]));
    }
    for (const Run& run : runs_) {
      const int last = run.first + static_cast<int>(run.points.size()) - 2;
      for (int v = run.first; v <= last; ++v) {
        const int w = v < last ? v + 1 : runs_[run.followed_by].first;
        result_.next[v] = w;
        result_.before[w] = v;
      }
    }
  }

  // Where the border runs along a nose that is much sharper than the mesh is fine, such as a leading edge, the normal
  // there is not that of the triangles beside it: it is taken a few short steps inside.
  void look_past_noses() {
    std::vector<Xyz> normals;
    for (size_t i = 0; i < result_.points.size(); ++i) {
      const MeshVertex& v = result_.points[i];
      SurfaceSample s = probe_.at(v.uv[0]);
      if (s.curvature * v.h > kNose) {
        const Xyz along = (result_.points[result_.next[i]].x - result_.points[result_.before[i]].x).normalized();
        Uv uv = v.uv[0];
        for (int k = 0; k < kStepsInside; ++k) {
          const Projection foot =
              project_near(probe_.surface(), s.x + kStepInside * v.h * s.n.cross(along), uv, probe_.box());
          if (!foot.converged) break;
          uv = foot.uv;
          s = probe_.at(uv);
        }
      }
      normals.push_back(s.n);
    }
    for (size_t i = 0; i < result_.points.size(); ++i) result_.points[i].n = normals[i];
  }

  // A tip on the border takes its mean normal; one in the middle of the face stands alone.
  void add_tips() {
    for (const auto& [point, tip] : tips_) {
      const bool says_something = tip.normals.norm() > kLeastMean;
      bool is_on_border = false;
      for (size_t i = 0; i < result_.points.size(); ++i) {
        if (result_.points[i].border != point) continue;
        is_on_border = true;
        result_.is_tip[i] = 1;
        if (says_something) result_.points[i].n = tip.normals.normalized();
      }
      if (is_on_border) continue;
      add_point(point, tip.uv);
      result_.is_tip.back() = 1;
      result_.points.back().n = tip.normals.normalized();
      result_.points.back().free_u = tip.free_u;
      result_.points.back().free_v = tip.free_v;
    }
  }

  void add_point(int point, Uv uv) {
    MeshVertex v;
    v.x = border_.points[point];
    v.n = probe_.at(uv).n;
    v.h = border_.size[point];
    v.border = point;
    v.uv = {uv};
    result_.points.push_back(v);
    result_.next.push_back(-1);
    result_.before.push_back(-1);
    result_.is_tip.push_back(0);
  }

  void check() {
    std::map<int, int> passes;
    for (const MeshVertex& v : result_.points) {
      ++passes[v.border];
      if (!(v.n.squaredNorm() > 0.5)) result_.why = "it has no normal at its border";
    }
    for (const MeshVertex& v : result_.points) result_.is_one_of_many.push_back(passes[v.border] > 1 ? 1 : 0);
    for (size_t i = 0; i < result_.points.size(); ++i) {
      if (result_.next[i] == static_cast<int>(i) || (result_.next[i] >= 0 && result_.next[i] == result_.before[i])) {
        result_.why = "its border has too few points";
      }
    }
  }

  struct Tip {
    Xyz normals = Xyz::Zero();
    Uv uv;
    bool free_u = false, free_v = false;
  };

  const CadFace& face_;
  const SurfaceProbe& probe_;
  const BorderPoints& border_;
  MeshBorder result_;
  std::map<int, std::vector<const Coedge*>> uses_;  ///< of an edge
  std::vector<Run> runs_;
  std::map<int, Tip> tips_;  ///< of a border point
};

// The angle about n by which b lies counter-clockwise of a, in (0, 2 pi].
double turn(const Xyz& n, const Xyz& a, const Xyz& b) {
  const double angle = std::atan2(n.dot(a.cross(b)), a.dot(b) - n.dot(a) * n.dot(b));
  return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
}

}  // namespace

bool MeshBorder::sees(int i, const Xyz& x) const {
  if (next[i] < 0) return true;
  const MeshVertex& v = points[i];
  const Xyz ahead = points[next[i]].x - v.x;
  const double at = turn(v.n, ahead, x - v.x), whole = turn(v.n, ahead, points[before[i]].x - v.x);
  return at > kAlong && at < whole - kAlong;
}

MeshBorder mesh_border(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border) {
  return Collector(face, probe, border).run();
}

}  // namespace geovor
