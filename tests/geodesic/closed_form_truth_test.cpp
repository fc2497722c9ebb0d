// Geodesics in closed form held against the same geometry written in other formulas and in 113 bits: vectors on the
// sphere, complex numbers on the unrolled cylinder and cone. Truth is a function of the parameters as the doubles that
// they are, so that digits lost next to a seam, a pole, a tip or an antipode show.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "geodesic/closed_forms.h"
#include "geodesic/distance.h"
#include "support/differences.h"
#include "support/quad.h"
#include "support/vec3.h"
#include "surface/elementary_surfaces.h"

namespace geovor {
namespace {

using namespace testing;
using V = Vec3<Float128>;

constexpr double kBar = 1e-14;
constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr int kPairs = 100000;
constexpr double kPiDouble = std::numbers::pi;

const Float128& pi() {
  static const Float128 value = boost::math::constants::pi<Float128>();
  return value;
}

/// In the surface's own frame: a place with the tangents along the parameter lines (of unit length, where there is
/// one) and the lengths of Su and Sv.
struct Place {
  V x, e_u, e_v;
  Float128 u_speed, v_speed;
  V push(UvVec d) const { return Float128(d.u) * u_speed * e_u + Float128(d.v) * v_speed * e_v; }
  V at_angle(double t) const { return cos(Float128(t)) * e_u + sin(Float128(t)) * e_v; }
};

/// What a connection or a trace is to give; directions in space.
struct Truth {
  Float128 length;
  V start, end;
  Float128 y;
};
struct Arrival {
  V x, direction;
  Float128 y;
};

/// The turn from a to b of at most half a circle.
Float128 short_turn(double a, double b) {
  const Float128 d = Float128(b) - Float128(a);
  return d - 2 * pi() * round(d / (2 * pi()));
}

/// Opposite to rounding: on what unrolls, the two ways round are equally long, and either is right.
bool ties(Uv p, Uv q) { return abs(abs(short_turn(p.u, q.u)) - pi()) < kBar; }

struct QuadSphere {
  static constexpr bool kTwoWays = false;
  double R;
  Place place(Uv p) const {
    const Float128 cu = cos(Float128(p.u)), su = sin(Float128(p.u)), cv = cos(Float128(p.v)), sv = sin(Float128(p.v));
    return {{R * cv * cu, R * cv * su, R * sv}, {-su, cu, 0}, {-sv * cu, -sv * su, cv}, R * cv, R};
  }
  Truth between(Uv from, Uv to) const {
    const V p = normalized(place(from).x), q = normalized(place(to).x);
    const Float128 c = dot(p, q), s = norm(cross(p, q));
    return {R * atan2(s, c), (1 / s) * (q - c * p), (1 / s) * (c * q - p), R * s};
  }
  Arrival follow(Uv from, UvVec d, double length) const {
    const Place at = place(from);
    const V p = normalized(at.x), h = normalized(at.push(d));
    const Float128 c = cos(Float128(length) / R), s = sin(Float128(length) / R);
    return {Float128(R) * (c * p + s * h), c * h - s * p, R * s};
  }
};

/// Unrolls to the plane: x = u_speed * u along the parallels where that is constant.
struct QuadCylinder {
  static constexpr bool kTwoWays = true;
  double R;
  Place place(Uv p) const {
    const Float128 cu = cos(Float128(p.u)), su = sin(Float128(p.u));
    return {{R * cu, R * su, p.v}, {-su, cu, 0}, {0, 0, 1}, R, 1};
  }
  Truth between(Uv from, Uv to) const {
    const Float128 x = R * short_turn(from.u, to.u), y = Float128(to.v) - Float128(from.v),
                   length = sqrt(x * x + y * y);
    const Place a = place(from), b = place(to);
    return {length, (x / length) * a.e_u + (y / length) * a.e_v, (x / length) * b.e_u + (y / length) * b.e_v, length};
  }
  Arrival follow(Uv from, UvVec d, double length) const {
    const Float128 x = R * Float128(d.u), y = d.v, size = sqrt(x * x + y * y), turn = from.u + length * x / size / R;
    const V round{-sin(turn), cos(turn), 0};
    return {{R * cos(turn), R * sin(turn), from.v + length * y / size},
            (x / size) * round + (y / size) * V(0, 0, 1),
            length};
  }
};

struct QuadPlane {
  static constexpr bool kTwoWays = false;
  static Place place(Uv p) { return {{p.u, p.v, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1}; }
  static Truth between(Uv from, Uv to) {
    const V way = place(to).x - place(from).x, d = normalized(way);
    return {norm(way), d, d, norm(way)};
  }
  static Arrival follow(Uv from, UvVec d, double length) {
    const V way = normalized(V(d.u, d.v, 0));
    return {place(from).x + Float128(length) * way, way, length};
  }
};

/// Unrolls to a sector, as complex numbers rho exp(i u sin(alpha)); here x is the real part. The nappe that opens with
/// growing v is meant.
struct QuadCone {
  static constexpr bool kTwoWays = true;
  double R, angle;
  Float128 sine() const { return sin(abs(Float128(angle))); }
  Float128 side() const { return angle > 0 ? 1 : -1; }
  Float128 rho(Uv p) const { return side() * (Float128(p.v) + Float128(R) / sin(Float128(angle))); }
  Place place(Uv p) const {
    const Float128 cu = cos(Float128(p.u)), su = sin(Float128(p.u)), r = rho(p) * sine(), sa = sin(Float128(angle)),
                   ca = cos(Float128(angle));
    return {{r * cu, r * su, p.v * ca}, {-su, cu, 0}, {sa * cu, sa * su, ca}, r, 1};
  }
  Truth between(Uv from, Uv to) const {
    const Float128 theta = short_turn(from.u, to.u) * sine(), a = rho(from), b = rho(to);
    const Float128 x = b * cos(theta) - a, y = b * sin(theta), length = sqrt(x * x + y * y);
    const Float128 c = x / length, s = y / length;
    const Place p = place(from), q = place(to);
    return {length, s * p.e_u + (side() * c) * p.e_v,
            (s * cos(theta) - c * sin(theta)) * q.e_u + (side() * (c * cos(theta) + s * sin(theta))) * q.e_v, length};
  }
  Arrival follow(Uv from, UvVec d, double length) const {
    const Float128 a = rho(from), out = side() * Float128(d.v), round = Float128(d.u) * a * sine();
    const Float128 size = sqrt(out * out + round * round), x = a + length * out / size, y = length * round / size;
    const Float128 turn = from.u + atan2(y, x) / sine(), far = sqrt(x * x + y * y), ca = cos(Float128(angle));
    const V e_u{-sin(turn), cos(turn), 0}, out_u{sine() * cos(turn), sine() * sin(turn), side() * ca};
    const Float128 c = (out * x + round * y) / size / far, s = (round * x - out * y) / size / far;
    const V apex{0, 0, -Float128(R) / sin(Float128(angle)) * ca};
    return {apex + far * out_u, s * e_u + c * out_u, length};
  }
};

struct NoSlack {
  double operator()(Uv, Uv) const { return 0.0; }
};

/// The worst of many errors, with where it was.
struct Worst {
  double value = 0.0;
  Uv p, q;
  void add(const Float128& error, Uv a, Uv b) {
    const double e = static_cast<double>(abs(error));
    if (!(e <= value)) value = e, p = a, q = b;
  }
};
#define EXPECT_WITHIN(worst, bar)                                                                          \
  EXPECT_LE((worst).value, bar) << std::hexfloat << "(" << (worst).p.u << ", " << (worst).p.v << ") and (" \
                                << (worst).q.u << ", " << (worst).q.v << ")"

/// `slack(p, q)`: what the parameters' own rounding may cost besides kBar.
template <class Flat, class Pairs, class Slack = NoSlack>
void expect_connections(const Surface& surface, const Flat& truth, Pairs pair, const Slack& slack = {}) {
  Worst length, start, end, angle, y;
  for (int i = 0; i < kPairs; ++i) {
    const auto [p, q] = pair(i);
    if (p == q) continue;
    const Truth t = truth.between(p, q);
    const Connection c = i % 2 == 0 ? connect(surface, p, q) : distance(surface, p, q).shortest;
    ASSERT_EQ(c.status, ConnectStatus::Converged);
    const Place a = truth.place(p), b = truth.place(q);
    const Float128 allowed = kBar + slack(p, q);
    length.add((c.length - t.length) / t.length / allowed, p, q);
    y.add((c.y - t.y) / t.length / allowed, p, q);
    if (Flat::kTwoWays && ties(p, q)) continue;
    start.add(norm(a.push(c.start_direction) - t.start) / allowed, p, q);
    angle.add(norm(a.at_angle(c.angle) - t.start) / allowed, p, q);
    end.add(norm(b.push(c.end_direction) - t.end) / allowed, p, q);
  }
  EXPECT_WITHIN(length, 1.0);
  EXPECT_WITHIN(start, 1.0);
  EXPECT_WITHIN(end, 1.0);
  EXPECT_WITHIN(angle, 1.0);
  EXPECT_WITHIN(y, 1.0);
}

/// The end point is given in parameters, whose rounding costs `rounding(end)` in space beside kBar of the length;
/// directions turn by kBar a radian of the way, of which there is one every `radius`. `slack` as above.
template <class Flat, class Starts, class Rounding, class Slack = NoSlack>
void expect_traces(const Surface& surface, const Flat& truth, double radius, Starts start, const Rounding& rounding,
                   const Slack& slack = {}) {
  Worst place, direction, y;
  std::mt19937 random(77);
  for (int i = 0; i < kPairs; ++i) {
    const Uv p = start(i).first;
    const double t = uniform(random, -kPiDouble, kPiDouble);
    const double length = std::pow(10.0, uniform(random, -12.0, 3.0)) * radius;
    const Place at = truth.place(p);
    const UvVec d{static_cast<double>(cos(Float128(t)) / at.u_speed),
                  static_cast<double>(sin(Float128(t)) / at.v_speed)};
    const Arrival a = truth.follow(p, d, length);
    const TraceResult r = trace_geodesic(surface, p, d, length);
    ASSERT_EQ(r.status, TraceStatus::Converged);
    const Place end = truth.place(r.end.p);
    const double bar = kBar + slack(p, r.end.p), allowed = bar * length + rounding(p, r.end.p);
    place.add(norm(end.x - a.x) / allowed, p, {t, length});
    direction.add(norm(end.push(r.end.d) - a.direction) / (bar * (1.0 + length / radius)), p, {t, length});
    y.add((r.end.y - a.y) / (bar * length), p, {t, length});
  }
  EXPECT_WITHIN(place, 1.0);
  EXPECT_WITHIN(direction, 1.0);
  EXPECT_WITHIN(y, 1.0);
}

double log_uniform(std::mt19937& random, double lo, double hi) {
  return std::exp(uniform(random, std::log(lo), std::log(hi)));
}

double either_sign(std::mt19937& random) { return uniform(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0; }

/// Pairs of the parameters of a surface with period 2 pi: anywhere, near each other, across the seam, many turns
/// apart, and opposite.
class TurningPairs {
 public:
  TurningPairs(Interval v, unsigned seed) : v_(v), random_(seed) {}
  std::pair<Uv, Uv> operator()(int i) {
    const Uv p{uniform(random_, 0.0, 2.0 * kPiDouble), uniform(random_, v_.lo, v_.hi)};
    Uv q{uniform(random_, 0.0, 2.0 * kPiDouble), uniform(random_, v_.lo, v_.hi)};
    const double small = log_uniform(random_, 1e-12, 1e-1);
    switch (i % 5) {
      case 0:
        return {p, q};
      case 1:
        return {p, {p.u + small * uniform(random_, -1, 1), near(p.v, small)}};
      case 2:
        return {{small * uniform(random_, 0, 1), p.v},
                {2.0 * kPiDouble - small * uniform(random_, 0, 1), near(p.v, small)}};
      case 3:
        return {p, {q.u + 2.0 * kPiDouble * std::floor(uniform(random_, -9, 9)), q.v}};
      default:
        return {p, {p.u + either_sign(random_) * kPiDouble + small * uniform(random_, -1, 1), q.v}};
    }
  }

 private:
  double near(double v, double small) { return v_.clamp(v + v_.length() * small * uniform(random_, -1, 1)); }
  Interval v_;
  std::mt19937 random_;
};

/// The same on a sphere, where there are poles, neighbours across them, and antipodes.
class SpherePairs {
 public:
  explicit SpherePairs(unsigned seed) : random_(seed), turning_({-0.5 * kPiDouble, 0.5 * kPiDouble}, seed) {}
  std::pair<Uv, Uv> operator()(int i) {
    const double small = log_uniform(random_, 1e-15, 1e-1), other = log_uniform(random_, 1e-15, 1e-1);
    const Uv p{uniform(random_, 0.0, 2.0 * kPiDouble), uniform(random_, -1.57, 1.57)};
    const double u = uniform(random_, 0.0, 2.0 * kPiDouble), pole = either_sign(random_) * 0.5 * kPiDouble;
    switch (i % 6) {
      case 0:
        return {{p.u, pole}, {u, p.v}};
      case 1:
        return {{p.u, pole - std::copysign(small, pole)}, {u, pole - std::copysign(other, pole)}};
      case 2:
        return {p, {p.u + either_sign(random_) * kPiDouble + small, -p.v + other * either_sign(random_)}};
      case 3:
        return {{p.u, pole - std::copysign(small, pole)}, {u, std::copysign(other, pole) - pole}};
      default:
        return turning_(i / 6);
    }
  }

 private:
  std::mt19937 random_;
  TurningPairs turning_;
};

Frame far_away() {
  Frame f;
  f.origin = {1e6, -2e6, 3e6};
  f.x = {0.6, 0.8, 0.0};
  f.y = {-0.8, 0.6, 0.0};
  return f;
}

class ClosedFormsOfRadius : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Radii, ClosedFormsOfRadius, ::testing::Values(1e-9, 1.0, 1e9));

TEST_P(ClosedFormsOfRadius, SphereConnectionsAreExact) {
  const double R = GetParam();
  expect_connections(Sphere(far_away(), R), QuadSphere{R}, SpherePairs(1));
}

TEST_P(ClosedFormsOfRadius, SphereTracesAreExact) {
  const double R = GetParam();
  expect_traces(Sphere(far_away(), R), QuadSphere{R}, R, SpherePairs(2),
                [R](Uv p, Uv q) { return kEps * R * (4.0 + std::abs(p.u) + std::abs(q.u)); });
}

TEST_P(ClosedFormsOfRadius, CylinderConnectionsAreExact) {
  const double R = GetParam();
  expect_connections(Cylinder(far_away(), R), QuadCylinder{R}, TurningPairs({-3.0 * R, 5.0 * R}, 3));
}

TEST_P(ClosedFormsOfRadius, CylinderTracesAreExact) {
  const double R = GetParam();
  expect_traces(Cylinder(far_away(), R), QuadCylinder{R}, R, TurningPairs({-3.0 * R, 5.0 * R}, 4),
                [R](Uv p, Uv q) { return kEps * (R * (1.0 + std::abs(q.u)) + std::abs(p.v) + std::abs(q.v)); });
}

TEST_P(ClosedFormsOfRadius, PlaneConnectionsAndTracesAreExact) {
  const double size = GetParam();
  const Plane plane(far_away());
  expect_connections(plane, QuadPlane{}, TurningPairs({-3.0 * size, 5.0 * size}, 5));
  expect_traces(plane, QuadPlane{}, size, TurningPairs({-3.0 * size, 5.0 * size}, 6),
                [](Uv p, Uv q) { return kEps * (std::abs(p.u) + std::abs(p.v) + std::abs(q.u) + std::abs(q.v)); });
}

struct ConeCase {
  double R, angle;
};
void PrintTo(const ConeCase& c, std::ostream* out) { *out << "R " << c.R << ", half-angle " << c.angle; }

// The distance from the tip is v - v_tip; a tip that is not at v = 0 rounds, which points near it feel.
class ClosedFormsOfCone : public ::testing::TestWithParam<ConeCase> {
 protected:
  const QuadCone truth_{GetParam().R, GetParam().angle};
  const Cone cone_{far_away(), GetParam().R, GetParam().angle};
  double tip_ = cone_.apex_v(), side_ = GetParam().angle > 0.0 ? 1.0 : -1.0;
  double from_tip(Uv p) const { return std::abs(p.v - tip_); }
  // On a slender cone u turns through many circles, and rounds accordingly; `turns` of them for one about the tip in
  // the development.
  auto tip_slack(double turns = 1.0) const {
    return [this, turns](Uv p, Uv q) {
      const double near = 2.0 * kEps * std::abs(tip_) * turns * (1.0 / from_tip(p) + 1.0 / from_tip(q));
      return near + kEps * (std::abs(p.u) + std::abs(q.u));
    };
  }
  Interval heights() const {
    const double far = tip_ == 0.0 ? 2.0 : std::abs(tip_);
    return side_ > 0.0 ? Interval{tip_ + 1e-3 * far, tip_ + 3.0 * far} : Interval{tip_ - 3.0 * far, tip_ - 1e-3 * far};
  }
};
INSTANTIATE_TEST_SUITE_P(Cones, ClosedFormsOfCone,
                         ::testing::Values(ConeCase{0.0, 0.5}, ConeCase{0.0, -1.3}, ConeCase{2.0, 0.7},
                                           ConeCase{2.0, -0.01}, ConeCase{1e-6, 1.5}));

TEST_P(ClosedFormsOfCone, ConnectionsAreExact) {
  expect_connections(cone_, truth_, TurningPairs(heights(), 7), tip_slack());
}

TEST_P(ClosedFormsOfCone, TracesAreExact) {
  const double far = tip_ == 0.0 ? 1.0 : std::abs(tip_);
  expect_traces(
      cone_, truth_, 1e-3 * far, TurningPairs(heights(), 8),
      [this](Uv p, Uv q) {
        const double across = from_tip(q) * std::sin(std::abs(GetParam().angle));
        return kEps * (across * (1.0 + std::abs(p.u) + std::abs(q.u)) +
                       2.0 * (std::abs(p.v) + std::abs(q.v) + std::abs(tip_)));
      },
      tip_slack(1.0 / std::abs(std::sin(GetParam().angle))));
}

// Ever nearer to the tip, on either side of it and on opposite sides: there only where the tip is at v = 0 do the
// parameters say how near.
class ClosedFormsNextToATip : public ClosedFormsOfCone {};
INSTANTIATE_TEST_SUITE_P(TipsAtZero, ClosedFormsNextToATip, ::testing::Values(ConeCase{0.0, 0.5}, ConeCase{0.0, -1.3}));

TEST_P(ClosedFormsNextToATip, ConnectionsAreExact) {
  std::mt19937 random(9);
  const auto pair = [&](int i) {
    const double small = log_uniform(random, 1e-12, 1.0), other = i % 2 == 0 ? small : log_uniform(random, 1e-12, 1.0);
    const double u = uniform(random, 0.0, 2.0 * kPiDouble), shift = i % 3 == 0 ? kPiDouble : uniform(random, -9.0, 9.0);
    return std::pair<Uv, Uv>{{u, side_ * small}, {u + shift, side_ * other}};
  };
  expect_connections(cone_, truth_, pair);
}

TEST_P(ClosedFormsOfCone, TheTipIsReachedStraight) {
  std::mt19937 random(10);
  for (int i = 0; i < 1000; ++i) {
    const Uv p{uniform(random, -9.0, 9.0), uniform(random, heights().lo, heights().hi)};
    const Uv tip{uniform(random, -9.0, 9.0), tip_};
    const double d = static_cast<double>(truth_.rho(p)), allowed = kBar * d + 2.0 * kEps * std::abs(tip_);
    const Connection out = distance(cone_, tip, p).shortest, in = distance(cone_, p, tip).shortest;
    for (const Connection& c : {out, in}) {
      ASSERT_EQ(c.status, ConnectStatus::Converged);
      ASSERT_NEAR(c.length, d, allowed);
      ASSERT_NEAR(c.y, d, allowed);
    }
    for (const UvVec end : {out.start_direction, out.end_direction}) ASSERT_TRUE(end.u == 0.0 && end.v == side_);
    for (const UvVec end : {in.start_direction, in.end_direction}) ASSERT_TRUE(end.u == 0.0 && end.v == -side_);
    const TraceResult from_tip = trace_geodesic(cone_, {p.u, tip_}, out.start_direction, out.length);
    ASSERT_EQ(from_tip.end.p.u, p.u);
    ASSERT_NEAR(from_tip.end.p.v, p.v, allowed);
  }
}

// Between opposite points of cylinder and cone two geodesics are shortest, on the sphere all half circles are.
TEST(ClosedForms, GiveBothWaysRoundBetweenOppositePoints) {
  const Cylinder cylinder({}, 2.0);
  const Cone cone({}, 1.0, 0.4);
  const Sphere sphere({}, 2.0);
  const std::pair<const Surface*, Uv> cases[] = {
      {&cylinder, {kPiDouble, 1.5}}, {&cone, {kPiDouble, 1.5}}, {&sphere, {kPiDouble, -0.25}}};
  for (const auto& [surface, to] : cases) {
    const auto both = connections_closed_form(*surface, {0.0, 0.25}, to);
    ASSERT_TRUE(both && both->size() == 2u);
    EXPECT_NEAR((*both)[0].length, (*both)[1].length, kBar);
    EXPECT_NEAR(std::cos((*both)[0].angle), -std::cos((*both)[1].angle), kBar);
  }
}

TEST(ClosedForms, NoDirectionIsNoNumberPassedOn) {
  const Plane plane({});
  const Cylinder cylinder({}, 1.0);
  const Sphere sphere({}, 1.0);
  const Cone cone({}, 1.0, 0.5);
  for (const Surface* surface : std::initializer_list<const Surface*>{&plane, &cylinder, &sphere, &cone}) {
    EXPECT_EQ(trace_geodesic(*surface, {0.1, 0.2}, {0.0, 0.0}, 1.0).status, TraceStatus::DegenerateMetric);
    EXPECT_EQ(trace_geodesic(*surface, {0.1, 0.2}, {std::nan(""), 1.0}, 1.0).status, TraceStatus::DegenerateMetric);
  }
}

}  // namespace
}  // namespace geovor
