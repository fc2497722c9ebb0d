#include "delaunay/face_border.h"

#include <algorithm>
#include <map>

#include "surface/pole_chart.h"

namespace geovor {
namespace {

// Where the normals of both sides of a seam agree this well the surface goes on smoothly.
constexpr double kSmoothCosine = 0.9999;
// Points of a seam at which the normals are compared.
constexpr int kLooks = 9;

Uv parameters_at(const Coedge& c, double t) {
  const auto p = c.pcurve->position(t);
  return {p.x(), p.y()};
}

class Collector {
 public:
  Collector(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border)
      : face_(face), probe_(probe), border_(border) {}

  FaceBorder run() {
    for (const TrimLoop& loop : face_.loops) {
      for (const Coedge& c : loop.coedges) uses_[c.edge].push_back(&c);
    }
    for (const TrimLoop& loop : face_.loops) {
      for (const Coedge& c : loop.coedges) {
        if (!result_.why.empty()) return result_;
        if (border_.edges[c.edge].points.size() == 1) {
          pole(c);
        } else if (!is_seam(c)) {
          add(c);
        }
      }
    }
    if (result_.why.empty()) check();
    return result_;
  }

 private:
  bool is_seam(const Coedge& c) {
    const auto& both = uses_[c.edge];
    if (both.size() < 2) return false;
    if (both.size() > 2 || both[0]->reversed == both[1]->reversed || !smooth(*both[0], *both[1])) {
      result_.why = "it meets itself along an edge, but not smoothly";
    }
    return true;
  }

  // Both sides are elsewhere in the parameter plane, a period apart: an edge inside the face has one place.
  bool smooth(const Coedge& a, const Coedge& b) const {
    for (int i = 0; i < kLooks; ++i) {
      const double t = a.range.lo + (i + 0.5) / kLooks * a.range.length();
      const Uv p = parameters_at(a, t), q = parameters_at(b, t);
      if (p == q || !(probe_.at(p).n.dot(probe_.at(q).n) > kSmoothCosine)) return false;
    }
    return true;
  }

  void pole(const Coedge& c) {
    const Uv middle = parameters_at(c, c.range.lo + 0.5 * c.range.length());
    const auto& charts = probe_.surface().poles();
    const bool is_smooth =
        std::any_of(charts.begin(), charts.end(), [&](const auto& chart) { return chart->holds(middle); });
    const int point = border_.edges[c.edge].points[0];
    if (!is_smooth) tips_.push_back(point);
  }

  void add(const Coedge& c) {
    const BorderPoints::Edge& e = border_.edges[c.edge];
    const int n = static_cast<int>(e.points.size());
    for (int i = 0; i + 1 < n; ++i) {
      const int k = c.reversed ? n - 1 - i : i, after = c.reversed ? k - 1 : k + 1;
      const int a = vertex(e.points[k], parameters_at(c, e.t[k])),
                b = vertex(e.points[after], parameters_at(c, e.t[after]));
      if (a == b || result_.next[a] >= 0 || result_.before[b] >= 0) {
        result_.why = "its border passes a point twice";
        return;
      }
      result_.next[a] = b;
      result_.before[b] = a;
    }
  }

  int vertex(int point, Uv uv) {
    const auto [place, is_new] = number_.try_emplace(point, static_cast<int>(result_.points.size()));
    if (is_new) {
      MeshVertex v;
      v.x = border_.points[point];
      v.n = probe_.at(uv).n;
      v.h = border_.size[point];
      v.border = point;
      v.uv = {uv};
      result_.points.push_back(v);
      result_.next.push_back(-1);
      result_.before.push_back(-1);
    }
    return place->second;
  }

  void check() {
    for (size_t i = 0; i < result_.points.size(); ++i) {
      if (result_.next[i] < 0 || result_.before[i] < 0) result_.why = "its border is open";
      if (!(result_.points[i].n.squaredNorm() > 0.5)) result_.why = "it has no normal at its border";
    }
    for (const int tip : tips_) {
      if (number_.count(tip) == 0) result_.why = "it has a tip";
    }
  }

  const CadFace& face_;
  const SurfaceProbe& probe_;
  const BorderPoints& border_;
  FaceBorder result_;
  std::map<int, std::vector<const Coedge*>> uses_;  ///< of an edge
  std::map<int, int> number_;                       ///< of a border point
  std::vector<int> tips_;
};

}  // namespace

FaceBorder face_border(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border) {
  return Collector(face, probe, border).run();
}

}  // namespace geovor
