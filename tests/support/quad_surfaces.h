// Surfaces over 113 bits, written anew from their definitions: nothing of the library's own evaluation is in them.
#pragma once

#include <array>
#include <vector>

#include "support/quad.h"
#include "support/splines.h"
#include "support/vec3.h"

namespace geovor::testing {

using QuadVec = Vec3<Float128>;

struct QuadJet {
  QuadVec S, Su, Sv, Suu, Suv, Svv;
};

/// A surface in analytic pieces, which lie between `lines`: piece k of an axis lies between lines k - 1 and k, and is
/// evaluated on its own function also beyond them.
class QuadSurface {
 public:
  virtual ~QuadSurface() = default;
  virtual QuadJet jet(const Float128& u, const Float128& v, std::array<int, 2> piece) const = 0;
  const std::vector<double>& lines(int axis) const { return lines_[axis]; }

 protected:
  std::array<std::vector<double>, 2> lines_;
};

/// (u, v, sin u cos v).
class QuadWave final : public QuadSurface {
 public:
  QuadJet jet(const Float128& u, const Float128& v, std::array<int, 2>) const override;
};

/// (u, v, u^2 + v^2).
class QuadParaboloid final : public QuadSurface {
 public:
  QuadJet jet(const Float128& u, const Float128& v, std::array<int, 2>) const override;
};

/// (cos u, sin u, v).
class QuadCylinder final : public QuadSurface {
 public:
  QuadJet jet(const Float128& u, const Float128& v, std::array<int, 2>) const override;
};

/// (a cos u cos v, b sin u cos v, c sin v).
class QuadEllipsoid final : public QuadSurface {
 public:
  QuadEllipsoid(double a, double b, double c) : a_(a), b_(b), c_(c) {}
  QuadJet jet(const Float128& u, const Float128& v, std::array<int, 2>) const override;

 private:
  Float128 a_, b_, c_;
};

/// ((R + r cos v) cos u, (R + r cos v) sin u, r sin v).
class QuadTorus final : public QuadSurface {
 public:
  QuadTorus(double R, double r) : R_(R), r_(r) {}
  QuadJet jet(const Float128& u, const Float128& v, std::array<int, 2>) const override;

 private:
  Float128 R_, r_;
};

/// (u, v, A exp(-(u^2 + v^2) / (2 s^2))).
class QuadBump final : public QuadSurface {
 public:
  QuadBump(double height, double width) : A_(height), s_(width) {}
  QuadJet jet(const Float128& u, const Float128& v, std::array<int, 2>) const override;

 private:
  Float128 A_, s_;
};

/// A B-spline as one polynomial a span, in powers of the distance from the span's middle. Their coefficients come from
/// the Cox-de Boor recurrence carried out on polynomials.
class QuadSpline final : public QuadSurface {
 public:
  explicit QuadSpline(const SplineData& data);
  QuadJet jet(const Float128& u, const Float128& v, std::array<int, 2> piece) const override;

 private:
  struct Axis {
    int degree;
    std::vector<Float128> middles;                          // by piece
    std::vector<int> spans;                                 // flat index, by piece
    std::vector<std::vector<std::vector<Float128>>> basis;  // [piece][function][power]
  };
  static Axis make_axis(const std::vector<double>& knots, int degree);
  std::array<Axis, 2> axes_;
  bool rational_;
  // Homogeneous (wx, wy, wz, w): [u piece * v pieces + v piece][power of u * (v degree + 1) + power of v].
  std::vector<std::vector<std::array<Float128, 4>>> patches_;
};

}  // namespace geovor::testing
