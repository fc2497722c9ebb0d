#include "pipeline/edge_spline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

namespace geovor {
namespace {

constexpr int kDegree = 3;
// Halvings of a piece between two points of the polyline, at most; each divides the error by 16.
constexpr int kMostHalvings = 8;

/// A place of a curve with its derivative, before and after it where the curve has a corner.
template <class Point>
struct Knot {
  double t = 0.0;
  Point at, before, after;
};

template <class Point>
Point hermite(const Knot<Point>& a, const Knot<Point>& b, double t) {
  const double h = b.t - a.t, k = (t - a.t) / h, l = 1.0 - k;
  return l * l * (1.0 + 2.0 * k) * a.at + k * k * (1.0 + 2.0 * l) * b.at + h * k * l * (l * a.after - k * b.before);
}

template <class Point>
Point hermite_slope(const Knot<Point>& a, const Knot<Point>& b, double t) {
  const double h = b.t - a.t, k = (t - a.t) / h, l = 1.0 - k;
  return 6.0 * k * l / h * (b.at - a.at) + l * (1.0 - 3.0 * k) * a.after + k * (3.0 * k - 2.0) * b.before;
}

template <class Point>
bool smooth(const Knot<Point>& k) {
  constexpr double kCorner = 1e-9;  // tangents that differ by less differ by rounding
  return (k.after - k.before).norm() <= kCorner * (k.after.norm() + k.before.norm());
}

/// The knots as a B-spline: within a piece the two inner poles; the place itself at the ends and at corners.
template <class Point, class Spline, class Convert>
Spline spline_of(const std::vector<Knot<Point>>& knots, const Convert& convert) {
  Spline spline;
  spline.degree = kDegree;
  for (size_t i = 0; i < knots.size(); ++i) {
    const bool end = i == 0 || i + 1 == knots.size(), corner = end || !smooth(knots[i]);
    if (i > 0) spline.poles.push_back(convert(knots[i].at - (knots[i].t - knots[i - 1].t) / kDegree * knots[i].before));
    if (corner) spline.poles.push_back(convert(knots[i].at));
    if (!end || i == 0) {
      spline.poles.push_back(convert(knots[i].at + (knots[i + 1].t - knots[i].t) / kDegree * knots[i].after));
    }
    spline.knots.push_back(knots[i].t);
    spline.multiplicities.push_back(end ? kDegree + 1 : corner ? kDegree : kDegree - 1);
  }
  return spline;
}

Eigen::Vector2d vec(Uv p) { return {p.u, p.v}; }
Uv uv_of(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

class SurfaceSpline {
 public:
  using Plane = Knot<Eigen::Vector2d>;
  using Space = Knot<Xyz>;

  SurfaceSpline(const Surface& surface, const std::vector<Uv>& uv, const std::vector<Xyz>& xyz, const SplineFit& fit)
      : surface_(surface), uv_(uv), fit_(fit) {
    double s = 0.0;
    for (size_t i = 0; i < xyz.size(); ++i) {
      if (i > 0) s += (xyz[i] - xyz[i - 1]).norm();
      line_.push_back({s, xyz[i], Xyz::Zero(), Xyz::Zero()});
    }
    give_tangents();
  }

  SurfaceCurve run() {
    const int last = static_cast<int>(line_.size()) - 1;
    Plane start = plane_knot(0, line_.front().t, vec(uv_.front())),
          end = plane_knot(last - 1, line_.back().t, vec(uv_.back()));
    end.after = end.before;
    plane_.push_back(start);
    add_points(0, last, start, end);
    for (size_t i = 0; i + 1 < plane_.size(); ++i) add_space(plane_[i], plane_[i + 1], 0);
    Space closing = space_knot(plane_.back());
    space_.push_back(closing);
    SurfaceCurve result;
    result.pcurve = spline_of<Eigen::Vector2d, CadPcurve>(plane_, uv_of);
    result.curve = spline_of<Xyz, CadCurve>(space_, [](const Xyz& x) { return x; });
    return result;
  }

 private:
  /// Parabolas through three neighbours; where the cubic leaves the chord too far, the chord.
  void give_tangents() {
    const int n = static_cast<int>(line_.size());
    const auto slope = [&](int i) { return Xyz((line_[i + 1].at - line_[i].at) / (line_[i + 1].t - line_[i].t)); };
    for (int i = 0; i < n; ++i) {
      Xyz tangent = slope(std::min(i, n - 2));
      if (n > 2) {
        const int m = std::clamp(i, 1, n - 2);
        const double h0 = line_[m].t - line_[m - 1].t, h1 = line_[m + 1].t - line_[m].t;
        const Xyz bend = (slope(m) - slope(m - 1)) / (h0 + h1);
        tangent = slope(m - 1) + bend * (h0 + 2.0 * (line_[i].t - line_[m].t));
      }
      line_[i].before = line_[i].after = tangent;
    }
    const std::vector<Space> curved = line_;
    for (int i = 0; i + 1 < n; ++i) {
      const Xyz middle = hermite(curved[i], curved[i + 1], 0.5 * (line_[i].t + line_[i + 1].t));
      if ((middle - 0.5 * (line_[i].at + line_[i + 1].at)).norm() <= fit_.deviation * kChordShare) continue;
      line_[i].after = line_[i + 1].before = slope(i);
    }
  }

  int piece_at(double t) const {
    const auto above =
        std::upper_bound(line_.begin(), line_.end(), t, [](double x, const Space& k) { return x < k.t; });
    return std::clamp(static_cast<int>(above - line_.begin()) - 1, 0, static_cast<int>(line_.size()) - 2);
  }

  Xyz line_at(double t) const {
    const int i = piece_at(t);
    return hermite(line_[i], line_[i + 1], t);
  }

  /// Gauss-Newton steps to the point of the surface at the line's point. What lies beside the surface stays beside it.
  Eigen::Vector2d plane_at(double t) const {
    const int i = piece_at(t);
    const double k = (t - line_[i].t) / (line_[i + 1].t - line_[i].t);
    Eigen::Vector2d p = (1.0 - k) * vec(uv_[i]) + k * vec(uv_[i + 1]);
    Eigen::Vector2d first = p;
    const Xyz x = line_at(t);
    const double reach = (vec(uv_[i + 1]) - vec(uv_[i])).norm();
    for (int step = 0; step < kNewtonSteps; ++step) {
      const SurfaceJet j = surface_.jet(uv_of(p));
      const Eigen::Vector2d move = pull_back(j, x - j.S);
      if (!(move.norm() <= reach)) return first;  // near a pole: the straight way
      p += move;
    }
    return (p - first).norm() <= reach ? p : first;
  }

  static Eigen::Vector2d pull_back(const SurfaceJet& j, const Xyz& x) {
    const double E = j.Su.dot(j.Su), F = j.Su.dot(j.Sv), G = j.Sv.dot(j.Sv), det = E * G - F * F;
    const double a = j.Su.dot(x), b = j.Sv.dot(x);
    return {(G * a - F * b) / det, (E * b - F * a) / det};
  }

  /// The derivative of the p-curve from that of the line, or from the straight way where the surface has none.
  Eigen::Vector2d derivative(int piece, const Eigen::Vector2d& p, const Xyz& tangent) const {
    const Eigen::Vector2d chord = (vec(uv_[piece + 1]) - vec(uv_[piece])) / (line_[piece + 1].t - line_[piece].t);
    const Eigen::Vector2d d = pull_back(surface_.jet(uv_of(p)), tangent);
    constexpr double kWildest = 8.0;  // near a pole the parameters run away from their chord
    return (d - chord).norm() <= kWildest * chord.norm() ? d : chord;
  }

  Plane plane_knot(int piece, double t, const Eigen::Vector2d& at) const {
    const Space &a = line_[piece], &b = line_[piece + 1];
    if (t > a.t && t < b.t) {
      const Eigen::Vector2d d = derivative(piece, at, hermite_slope(a, b, t));
      return {t, at, d, d};
    }
    const bool end = t >= b.t;
    const Space& k = end ? b : a;
    const int before = end ? piece : std::max(piece - 1, 0);
    const int after = std::min(before + 1, static_cast<int>(line_.size()) - 2);
    Plane knot{t, at, derivative(before, at, k.before), derivative(end ? after : piece, at, k.after)};
    if (smooth(k)) knot.before = knot.after = derivative(piece, at, k.after);
    return knot;
  }

  bool close(const Plane& a, const Plane& b, double t) const {
    return (surface_.position(uv_of(hermite(a, b, t))) - line_at(t)).norm() <= fit_.deviation;
  }

  /// Adds the knots after plane point i up to k, as few as the deviation allows.
  void add_points(int i, int k, const Plane& a, const Plane& b) {
    bool good = true;
    for (int m = i + 1; m < k && good; ++m) {
      good = smooth(line_[m]) &&
             (surface_.position(uv_of(hermite(a, b, line_[m].t))) - line_[m].at).norm() <= fit_.deviation;
    }
    for (double f : {0.25, 0.5, 0.75}) good = good && close(a, b, a.t + f * (b.t - a.t));
    if (good) {
      plane_.push_back(b);
    } else if (k - i > 1) {
      const int m = (i + k) / 2;
      const Plane middle = plane_knot(m, line_[m].t, vec(uv_[m]));
      add_points(i, m, a, middle);
      add_points(m, k, middle, b);
    } else {
      halve(i, a, b, 0);
    }
  }

  void halve(int piece, const Plane& a, const Plane& b, int depth) {
    const double t = 0.5 * (a.t + b.t);
    const bool good = close(a, b, t) && close(a, b, 0.5 * (a.t + t)) && close(a, b, 0.5 * (t + b.t));
    if (good || depth == kMostHalvings) {
      plane_.push_back(b);
      return;
    }
    const Plane middle = plane_knot(piece, t, plane_at(t));
    halve(piece, a, middle, depth + 1);
    halve(piece, middle, b, depth + 1);
  }

  Space space_knot(const Plane& p) const {
    const SurfaceJet j = surface_.jet(uv_of(p.at));
    return {p.t, j.S, j.Su * p.before.x() + j.Sv * p.before.y(), j.Su * p.after.x() + j.Sv * p.after.y()};
  }

  /// Adds the curve's knots from a (included) to b (excluded): the image of the p-curve.
  void add_space(const Plane& a, const Plane& b, int depth) {
    const Space A = space_knot(a), B = space_knot(b);
    bool good = true;
    for (double f : {0.25, 0.5, 0.75}) {
      const double t = a.t + f * (b.t - a.t);
      good = good && (hermite(A, B, t) - surface_.position(uv_of(hermite(a, b, t)))).norm() <= fit_.gap;
    }
    if (good || depth == kMostHalvings) {
      space_.push_back(A);
      return;
    }
    const double t = 0.5 * (a.t + b.t);
    const Eigen::Vector2d slope = hermite_slope(a, b, t);
    const Plane middle{t, hermite(a, b, t), slope, slope};
    add_space(a, middle, depth + 1);
    add_space(middle, b, depth + 1);
  }

  static constexpr int kNewtonSteps = 4;
  // The polyline lies within the diagram's tolerance of the edge, the cubic may leave it as far.
  static constexpr double kChordShare = 20.0;

  const Surface& surface_;
  const std::vector<Uv>& uv_;
  SplineFit fit_;
  std::vector<Space> line_;  ///< the curve through the points
  std::vector<Plane> plane_;
  std::vector<Space> space_;
};

}  // namespace

SurfaceCurve spline_on_surface(const Surface& surface, const std::vector<Uv>& uv, const std::vector<Xyz>& xyz,
                               const SplineFit& fit) {
  return SurfaceSpline(surface, uv, xyz, fit).run();
}

}  // namespace geovor
