#include "surface/polar_map.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace geovor {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kPi = std::numbers::pi;

// Poles equal within this part of the largest coordinate are one point: what text with 15 digits leaves.
constexpr double kCollapsed = 1e-14;

// The tangents at the pole span a plane if their second singular value is not lost in the rounding of the third.
constexpr double kSpan = 1e-6;

// Depth, as a part of the first span, at which the second form at the pole is taken: the map is exact that close, and
// third derivatives add no more than this part.
constexpr double kTiny = 1e-20;

// Second derivatives that agree this well from all sides are those of one surface; a smooth surface approximated by a
// file's 15 digits does better, a lofted cap whose curvature depends on the direction does much worse.
constexpr double kAgreement = 1e-9;

// The poles of one side: row 0 is the side itself, row 1 the next one inside, at w = 0, 1, …
struct Rows {
  const BSplineSurface& surface;
  PoleSide side;

  const KnotVector& across() const { return side.along_u ? surface.v_knots() : surface.u_knots(); }
  const KnotVector& along() const { return side.along_u ? surface.u_knots() : surface.v_knots(); }
  int count() const { return across().pole_count(); }
  int length() const { return along().pole_count(); }
  // Row k from the side, place i along it.
  template <class Get>
  auto at(const Get& get, int k, int i) const {
    const int inner = side.low ? k : count() - 1 - k;
    return side.along_u ? get(i, inner) : get(inner, i);
  }
  Xyz pole(int k, int i) const {
    return at([this](int a, int b) { return surface.pole(a, b); }, k, i);
  }
  double weight(int k, int i) const {
    return at([this](int a, int b) { return surface.weight(a, b); }, k, i);
  }
  double largest_coordinate() const {
    double size = 0.0;
    for (int k = 0; k < count(); ++k)
      for (int i = 0; i < length(); ++i) size = std::max(size, (surface.centre() + pole(k, i)).cwiseAbs().maxCoeff());
    return size;
  }
};

// The knots across the side as depths from it.
KnotVector depth_knots(const KnotVector& knots, const PoleSide& side) {
  std::vector<double> depths;
  for (const double t : knots.flat()) depths.push_back(side.low ? t - side.at : side.at - t);
  if (!side.low) std::reverse(depths.begin(), depths.end());
  return KnotVector::from_flat(depths, knots.degree());
}

// The plane through the pole nearest to row 1; nothing if that spans no plane, or does not lie in it to rounding.
std::optional<Xyz> normal_of(const Rows& rows, const Xyz& pole, double rounding) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (int i = 0; i < rows.length(); ++i) {
    const Xyz d = rows.pole(1, i) - pole;
    moments += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  if (!(solver.eigenvalues()[1] > kSpan * kSpan * solver.eigenvalues()[2])) return std::nullopt;
  const Xyz n = solver.eigenvectors().col(0);
  for (int i = 0; i < rows.length(); ++i)
    if (!(std::abs(n.dot(rows.pole(1, i) - pole)) <= rounding)) return std::nullopt;
  return n;
}

}  // namespace

PolarMap::PolarMap(BSplineSurface map, const Frame& frame, double rounding)
    : map_(std::move(map)), frame_(frame), rounding_(rounding) {
  depth_ = map_.v_knots().lines()[1];
}

std::optional<PolarMap> PolarMap::make(const BSplineSurface& surface, const PoleSide& side) {
  const Rows rows{surface, side};
  if (!rows.across().clamped(side.low)) return std::nullopt;
  const double rounding = kCollapsed * rows.largest_coordinate();
  const Xyz pole = rows.pole(0, 0);
  for (int i = 0; i < rows.length(); ++i)
    if (!((rows.pole(0, i) - pole).cwiseAbs().maxCoeff() <= rounding)) return std::nullopt;
  const std::optional<Xyz> n = normal_of(rows, pole, rounding);
  if (!n) return std::nullopt;

  Frame frame;
  frame.origin = surface.centre() + pole;
  const Xyz first = rows.pole(1, 0) - pole;
  frame.x = (first - n->dot(first) * *n).normalized();
  // Su x Sv at the low side v = const is a positive multiple of m' x m, m(w) the tangents at the pole, here taken from
  // the rows' polygon; each change of end or of axes turns it round.
  Xyz turn = Xyz::Zero();
  for (int i = 0; i + 1 < rows.length(); ++i) turn += (rows.pole(1, i) - pole).cross(rows.pole(1, i + 1) - pole);
  const bool with_m = side.along_u != side.low;
  frame.z = (turn.dot(*n) > 0.0) == with_m ? *n : Xyz(-*n);
  frame.y = frame.z.cross(frame.x);

  std::vector<Xyz> poles;
  std::vector<double> weights;
  for (int i = 0; i < rows.length(); ++i)
    for (int k = 0; k < rows.count(); ++k) {
      const Xyz d = rows.pole(k, i) - pole;
      Xyz local(d.dot(frame.x), d.dot(frame.y), d.dot(frame.z));
      if (k == 0) local.setZero();
      if (k == 1) local.z() = 0.0;
      poles.push_back(local);
      weights.push_back(rows.weight(k, i));
    }
  PolarMap map(BSplineSurface(rows.along(), depth_knots(rows.across(), side), poles, weights, Xyz(Xyz::Zero())), frame,
               rounding);
  if (!map.tabulate_rays()) return std::nullopt;
  return map;
}

// Angles of the tangents m(w) = dS/dt at t = 0, made to ascend; on both sides of a wedge the table goes on for a part
// of the domain, as long as the angles do.
bool PolarMap::tabulate_rays() {
  constexpr int kRays = 64, kBeyond = 16;
  const Interval w = along();
  auto at = [&](int i) {
    const double x = i == kRays ? w.hi : w.lo + w.length() * i / kRays;
    const SurfaceJet j = map_.jet({x, 0.0});
    return Ray{std::atan2(j.Sv.y(), j.Sv.x()), x, std::hypot(j.Sv.x(), j.Sv.y())};
  };
  auto follow = [](const Ray& from, Ray to) {
    to.angle = from.angle + std::remainder(to.angle - from.angle, 2.0 * kPi);
    return to;
  };
  std::vector<Ray> table{at(0)};
  for (int i = 1; i <= kRays; ++i) table.push_back(follow(table.back(), at(i)));
  const double sign = table.back().angle > table.front().angle ? 1.0 : -1.0;
  auto ascends = [sign](const Ray& a, const Ray& b) { return sign * (b.angle - a.angle) > 0.0 && b.speed > 0.0; };
  speed_ = {table.front().speed, table.front().speed};
  for (int i = 0; i <= kRays; ++i) {
    if (!(table[i].speed > 0.0) || (i > 0 && !ascends(table[i - 1], table[i]))) return false;
    speed_ = {std::min(speed_.lo, table[i].speed), std::max(speed_.hi, table[i].speed)};
  }
  const double turn = std::abs(table.back().angle - table.front().angle);
  constexpr double kWhole = 1e-9;  // a wedge that leaves a slit finer than this is a full turn
  if (turn > 2.0 * kPi + kWhole) return false;
  full_turn_ = turn > 2.0 * kPi - kWhole;
  if (full_turn_ && !map_.u_knots().wraps()) return false;
  wedge_ = {table.front().angle, table.back().angle};
  for (int i = 1; !full_turn_ && i <= kBeyond; ++i) {
    const Ray next = follow(table.back(), at(kRays + i));
    if (!ascends(table.back(), next) || !(std::abs(next.angle - wedge_.hi) < 0.5 * (2.0 * kPi - turn))) break;
    table.push_back(next);
  }
  for (int i = 1; !full_turn_ && i <= kBeyond; ++i) {
    const Ray before = follow(table.front(), at(-i));
    if (!ascends(before, table.front()) || !(std::abs(before.angle - wedge_.lo) < 0.5 * (2.0 * kPi - turn))) break;
    table.insert(table.begin(), before);
  }
  if (sign < 0.0) {
    std::reverse(table.begin(), table.end());
    std::swap(wedge_.lo, wedge_.hi);
  }
  rays_ = std::move(table);
  return true;
}

// Between two rays of the table, linearly; the angle is first brought next to the middle of the wedge.
std::optional<PolarMap::Ray> PolarMap::ray(double angle) const {
  angle = wedge_.middle() + std::remainder(angle - wedge_.middle(), 2.0 * kPi);
  if (full_turn_) angle = std::clamp(angle, rays_.front().angle, rays_.back().angle);
  if (!(rays_.front().angle <= angle && angle <= rays_.back().angle)) return std::nullopt;
  auto after =
      std::lower_bound(rays_.begin() + 1, rays_.end() - 1, angle, [](const Ray& r, double x) { return r.angle < x; });
  const Ray &a = *(after - 1), &b = *after;
  const double k = (angle - a.angle) / (b.angle - a.angle);
  return Ray{angle, a.w + k * (b.w - a.w), a.speed + k * (b.speed - a.speed)};
}

std::optional<PolarMap::Foot> PolarMap::foot(Uv ab) const {
  constexpr int kSteps = 30;
  constexpr double kSettled = 4.0 * kEps;
  const double r = std::hypot(ab.u, ab.v);
  const std::optional<Ray> start = ray(std::atan2(ab.v, ab.u));
  if (!start) return std::nullopt;
  Foot f{start->w, r / start->speed, {}};
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSteps; ++i) {
    f.j = jet(f.w, f.t);
    const double x = ab.u - f.j.S.x(), y = ab.v - f.j.S.y(), miss = std::hypot(x, y);
    // The second condition: rounding keeps it from going lower.
    if (miss <= kSettled * r || (miss < 1e3 * kSettled * r && !(miss < 0.5 * last))) return f;
    last = miss;
    const double det = f.j.Su.x() * f.j.Sv.y() - f.j.Su.y() * f.j.Sv.x();
    const double dw = (x * f.j.Sv.y() - y * f.j.Sv.x()) / det, dt = (f.j.Su.x() * y - f.j.Su.y() * x) / det;
    if (!std::isfinite(dw) || !std::isfinite(dt)) break;
    f.w += dw;
    f.t = std::max(f.t + dt, 0.5 * f.t);  // stays on its side of the pole
  }
  return std::nullopt;
}

// height(a(w,t), b(w,t)) = z(w,t): the first derivatives solve J^T (h_a, h_b) = (z_w, z_t); the second ones are
// J^-T (z_ij - h_a a_ij - h_b b_ij) J^-1. Column w of J and row w of the equations are O(t): divided by t first.
HeightJet PolarMap::graph(const Foot& foot, Uv ab) {
  const SurfaceJet& j = foot.j;
  const double k = 1.0 / foot.t;
  Eigen::Matrix2d J;
  J << k * j.Su.x(), j.Sv.x(), k * j.Su.y(), j.Sv.y();
  const Eigen::Matrix2d inverse = J.inverse();
  const Eigen::Vector2d slope = inverse.transpose() * Eigen::Vector2d(k * j.Su.z(), j.Sv.z());
  auto bend = [&slope](const Xyz& d) { return d.z() - slope.x() * d.x() - slope.y() * d.y(); };
  Eigen::Matrix2d second;
  const double mixed = k * bend(j.Suv);
  second << k * k * bend(j.Suu), mixed, mixed, bend(j.Svv);
  second = inverse.transpose() * second * inverse;
  const double height = j.S.z() + slope.x() * (ab.u - j.S.x()) + slope.y() * (ab.v - j.S.y());
  return {height, slope.x(), slope.y(), second(0, 0), second(0, 1), second(1, 1)};
}

// The piece before the line runs on a quarter of a span beyond it: far enough to tell other functions apart.
double PolarMap::mismatch(double r) const {
  constexpr double kBeyond = 0.25;
  const std::vector<double>& lines = map_.u_knots().lines();
  double worst = 0.0;
  for (size_t k = full_turn_ ? 0 : 1; k + 1 < lines.size(); ++k) {
    const double before = k > 0 ? lines[k] - lines[k - 1] : lines.back() - lines[lines.size() - 2];
    const double w = lines[k] + kBeyond * std::min(before, lines[k + 1] - lines[k]);
    const Span piece = map_.span({lines[k], 0.0}, {-1.0, 1.0});
    const SurfaceJet m = map_.jet({w, 0.0}, piece);
    const Xyz S = map_.jet({w, r / std::hypot(m.Sv.x(), m.Sv.y())}, piece).S;
    const std::optional<Foot> other = foot({S.x(), S.y()});
    if (!other) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::abs(S.z() - graph(*other, {S.x(), S.y()}).f));
  }
  return worst;
}

bool PolarMap::second_form(HeightJet& h) const {
  constexpr int kDirections = 16;
  std::vector<HeightJet> seen;
  const double t = kTiny * depth_;
  h = {};
  for (int i = 0; i < kDirections; ++i) {
    const double w = along().lo + along().length() * (i + 0.5) / kDirections;
    const Foot f{w, t, jet(w, t)};
    seen.push_back(graph(f, {f.j.S.x(), f.j.S.y()}));
    h.fuu += seen.back().fuu / kDirections;
    h.fuv += seen.back().fuv / kDirections;
    h.fvv += seen.back().fvv / kDirections;
  }
  const double size = std::max({std::abs(h.fuu), std::abs(h.fuv), std::abs(h.fvv)});
  // Heights are known to the rounding of coordinates, at distances of about the first span.
  const double arm = speed_.lo * depth_;
  const double bound = kAgreement * size + 16.0 * rounding_ / (arm * arm);
  return std::all_of(seen.begin(), seen.end(), [&](const HeightJet& s) {
    return std::abs(s.fuu - h.fuu) <= bound && std::abs(s.fuv - h.fuv) <= bound && std::abs(s.fvv - h.fvv) <= bound;
  });
}

}  // namespace geovor
