#include "delaunay/edge_stations.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "delaunay/border_curvature.h"

namespace geovor {
namespace {

// Equal steps: so many a size, within these bounds.
constexpr double kStepsPerSize = 2.0;
constexpr int kFewestSteps = 24;
constexpr int kMostSteps = 4000;
// The ends of an edge are looked at these parts of a step inside, since there the speed of a parameter may vanish: the
// second derivatives need more room than the first.
constexpr double kInside = 0.25;
constexpr double kTangentInside = 1e-3;
// The faces' curvature is looked at beside the edge, at this part of the size or of the edge's length.
constexpr double kBeside = 0.1;
// Sizes that curvature asks for are taken in steps of this many an octave, far above the noise of second derivatives,
// so that they are the same under every parameterization; the shift keeps round ratios away from the steps' ends.
constexpr double kStepsPerOctave = 512.0;
constexpr double kShiftOfSteps = 0.3819660112501051;
// A number of steps is rounded up, but not by rounding alone.
constexpr double kRounding = 1e-9;
// A step is halved while it is longer than this part of the size, and the size in its middle differs by more than this
// from the mean of its ends, or a place between the curve's knots asks for less than this part of both.
constexpr double kResolved = 0.25;
constexpr double kUneven = 0.1;
constexpr double kSpike = 0.75;
constexpr int kMostHalvings = 12;

double curve_curvature(const CurveJet<3>& j) {
  const double speed = j.d1.norm();
  const double k = j.d1.cross(j.d2).norm() / (speed * speed * speed);
  return std::isfinite(k) ? k : 0.0;
}

class Looker {
 public:
  Looker(const CadEdge& edge, const std::vector<FaceUse>& uses)
      : edge_(edge), uses_(uses), stations_{ArcLength(*edge.curve, edge.range), {}, {}, {}, 0.0} {
    for (const FaceUse& use : uses) size_ = std::min(size_, use.rule->size);
  }
  EdgeStations run();

 private:
  double length() const { return stations_.way.length(); }
  double parameter(double s, double margin) const {
    return stations_.way.parameter(std::clamp(s, margin * step_, length() - margin * step_));
  }
  double size_at(double t) const;
  void between(double s0, double h0, double s1, double h1, int depth);
  double least_between(double s0, double s1) const;
  void add(double s, double h) {
    stations_.s.push_back(s);
    stations_.h.push_back(h);
    stations_.x.push_back(edge_.curve->position(stations_.way.parameter(s)));
  }

  const CadEdge& edge_;
  const std::vector<FaceUse>& uses_;
  EdgeStations stations_;
  struct Span {
    double s, h;
  };
  std::vector<Span> spans_;  // the places half way between the curve's knots
  double size_ = std::numeric_limits<double>::infinity();
  double step_ = 0.0;
};

double Looker::size_at(double t) const {
  const CurveJet<3> j = edge_.curve->jet(t);
  const double along = curve_curvature(j), beside = kBeside * std::min(size_, length());
  double h = size_;
  for (const FaceUse& use : uses_) {
    double curvature = along;
    if (use.probe) {
      const CurveJet<2> p = use.coedge->pcurve->jet(t);
      const double left = use.coedge->reversed ? -1.0 : 1.0;
      const UvVec inward = left * UvVec{-p.d1.y(), p.d1.x()};
      const BesidePlace place{{p.C.x(), p.C.y()}, inward, j.C, j.d1.normalized()};
      curvature = std::max(curvature, curvature_beside(*use.probe, place, beside));
    }
    h = std::min(h, use.rule->at(curvature));
  }
  return in_steps(h, size_);
}

// The smallest size between the curve's knots within the step.
double Looker::least_between(double s0, double s1) const {
  double least = size_;
  const auto first =
      std::upper_bound(spans_.begin(), spans_.end(), s0, [](double s, const Span& p) { return s < p.s; });
  for (auto span = first; span != spans_.end() && span->s < s1; ++span) least = std::min(least, span->h);
  return least;
}

// The stations inside a step.
void Looker::between(double s0, double h0, double s1, double h1, int depth) {
  const double spike = least_between(s0, s1), least = std::min({h0, h1, spike});
  if (depth == kMostHalvings || !(s1 - s0 > kResolved * least)) return;
  const double s = 0.5 * (s0 + s1), h = size_at(parameter(s, kInside));
  const bool even = !(std::abs(h - 0.5 * (h0 + h1)) > kUneven * h);
  if (even && !(spike < kSpike * std::min(h0, h1))) return;
  between(s0, h0, s, h, depth + 1);
  add(s, h);
  between(s, h, s1, h1, depth + 1);
}

EdgeStations Looker::run() {
  const double wanted = std::ceil((1.0 - kRounding) * kStepsPerSize * length() / size_);
  const int steps = static_cast<int>(std::clamp<double>(wanted, kFewestSteps, kMostSteps));
  step_ = length() / steps;
  std::vector<double> ends = edge_.curve->breaks(edge_.range);
  ends.push_back(edge_.range.hi);
  double last = edge_.range.lo;
  for (double end : ends) {
    const double t = 0.5 * (last + end);
    if (ends.size() > 1) spans_.push_back({stations_.way.at(t), size_at(t)});
    last = end;
  }
  Xyz last_tangent = Xyz::Zero();
  for (int k = 0; k <= steps; ++k) {
    const double s = length() * k / steps, t = parameter(s, kInside), h = size_at(t);
    const double t_end = k == 0 || k == steps ? parameter(s, kTangentInside) : t;
    const Xyz tangent = edge_.curve->jet(t_end).d1.normalized();
    if (k > 0) {
      stations_.turn += std::atan2(last_tangent.cross(tangent).norm(), last_tangent.dot(tangent));
      between(stations_.s.back(), stations_.h.back(), s, h, 0);
    }
    last_tangent = tangent;
    add(s, h);
  }
  return std::move(stations_);
}

}  // namespace

double in_steps(double h, double size) {
  const double steps = std::ceil(kStepsPerOctave * std::log2(size / h) - kShiftOfSteps);
  return steps > 0.0 ? size * std::exp2(-steps / kStepsPerOctave) : size;
}

EdgeStations look_along(const CadEdge& edge, const std::vector<FaceUse>& uses) { return Looker(edge, uses).run(); }

}  // namespace geovor
