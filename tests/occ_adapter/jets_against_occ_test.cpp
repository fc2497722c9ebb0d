// Every jet of a surface from CAD, held against OpenCASCADE's D2 of the Geom_Surface that it was made from.
#include <gtest/gtest.h>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_OffsetSurface.hxx>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "occ_adapter/occ_private.h"
#include "occ_adapter/occ_surfaces.h"
#include "surface/bspline_surface.h"

namespace geovor {
namespace {

using test::OccSurface;

constexpr int kPoints = 100;

// Roundings that two sound evaluations may differ by, in parts of the largest derivative of the same order.
constexpr double kClosedForm = 16;
constexpr double kSwept = 64;             // the meridian's own, turned
constexpr double kOffsetOfSpline = 4096;  // OpenCASCADE's third derivatives at degree 9; see spline_roundings

using Jet = std::array<Xyz, 6>;  // S, Su, Sv, Suu, Suv, Svv
const char* const kNames[] = {"S", "Su", "Sv", "Suu", "Suv", "Svv"};

Jet array_of(const SurfaceJet& j) { return {j.S, j.Su, j.Sv, j.Suu, j.Suv, j.Svv}; }

template <class D2>
Jet by_occ(D2 d2) {
  gp_Pnt S;
  gp_Vec Su, Sv, Suu, Svv, Suv;
  d2(S, Su, Sv, Suu, Svv, Suv);
  auto xyz = [](const gp_Vec& v) { return occ::to_xyz(v.XYZ()); };
  return {occ::to_xyz(S), xyz(Su), xyz(Sv), xyz(Suu), xyz(Suv), xyz(Svv)};
}

Jet by_occ(const Handle(Geom_Surface) & s, Uv p) {
  return by_occ([&](auto&... jet) { s->D2(p.u, p.v, jet...); });
}

/// OpenCASCADE expands the polynomial of a span in powers about one of its ends, which loses more than a bit a degree
/// at the other: little at the degrees of CAD, nearly everything at degree 25. (tests/surface holds ours against
/// extended precision, to a few roundings at every degree.)
double spline_roundings(const OccSurface& s) {
  const Handle(Geom_Surface) untrimmed = occ::unwrapped(s.surface);
  const auto bezier = Handle(Geom_BezierSurface)::DownCast(untrimmed);
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(untrimmed);
  int degree = 0;
  if (!bezier.IsNull()) degree = std::max(bezier->UDegree(), bezier->VDegree());
  if (!spline.IsNull()) degree = std::max(spline->UDegree(), spline->VDegree());
  constexpr double kLossPerDegree = 2.7;
  return kClosedForm * std::pow(kLossPerDegree, degree);
}

std::vector<Uv> random_points(const UvBox& box) {
  std::mt19937 random(20240607);
  std::uniform_real_distribution<double> u(box.u.lo, box.u.hi), v(box.v.lo, box.v.hi);
  std::vector<Uv> points;
  for (int i = 0; i < kPoints; ++i) {
    const double first = u(random);
    points.push_back({first, v(random)});
  }
  return points;
}

/// The largest of each derivative anywhere: what rounding is measured by. A derivative that vanishes everywhere is
/// measured by those of lower order.
std::array<double, 6> sizes(const OccSurface& s) {
  std::array<double, 6> size{};
  for (const Uv p : random_points(s.box)) {
    const Jet j = by_occ(s.surface, p);
    for (int o = 0; o < 6; ++o) size[o] = std::max(size[o], j[o].norm());
  }
  for (int o = 1; o < 6; ++o) size[o] = std::max(size[o], size[o < 3 ? 0 : o < 5 ? 1 : 2]);
  return size;
}

/// Holds jets of one surface against OpenCASCADE's.
class Comparison {
 public:
  Comparison(const OccSurface& s, double roundings) : name_(s.name), size_(sizes(s)), roundings_(roundings) {}

  void expect(const Jet& ours, const Jet& theirs, Uv p) const {
    for (int o = 0; o < 6; ++o) {
      const double size = std::max(size_[o], theirs[o].norm());
      EXPECT_LE((ours[o] - theirs[o]).norm(), roundings_ * std::numeric_limits<double>::epsilon() * size)
          << name_ << ": " << kNames[o] << " at " << p.u << ", " << p.v;
    }
  }

 private:
  std::string name_;
  std::array<double, 6> size_;
  double roundings_;
};

void expect_same_jets(const OccSurface& s, double roundings) {
  const SurfacePtr surface = occ::convert_surface(s.surface);
  const Comparison comparison(s, roundings);
  std::vector<Uv> points = random_points(s.box);
  points.insert(points.end(), s.places.begin(), s.places.end());
  for (const Uv p : points) {
    comparison.expect(array_of(surface->jet(p)), by_occ(s.surface, p), p);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(JetsAgainstOcc, ElementarySurfaces) {
  for (const OccSurface& s : test::elementary_surfaces()) expect_same_jets(s, kClosedForm);
}

TEST(JetsAgainstOcc, SplinesAtRandomPoints) {
  for (const OccSurface& s : test::spline_surfaces()) expect_same_jets(s, spline_roundings(s));
}

// On a knot the surface has two jets, or four, one a piece; OpenCASCADE gives that of the piece asked for.
TEST(JetsAgainstOcc, SplinesOnTheirKnotsFromEverySide) {
  for (const OccSurface& s : test::spline_surfaces()) {
    const auto spline = Handle(Geom_BSplineSurface)::DownCast(s.surface);
    if (spline.IsNull()) continue;
    const SurfacePtr surface = occ::convert_surface(s.surface);
    const Comparison comparison(s, spline_roundings(s));
    for (int i = 1; i < spline->NbUKnots(); ++i) {
      for (int k = 1; k < spline->NbVKnots(); ++k) {
        for (int corner = 0; corner < 4; ++corner) {
          const bool right = corner & 1, top = corner & 2;
          const Uv p{spline->UKnot(i + right), spline->VKnot(k + top)};
          const Jet theirs = by_occ([&](auto&... jet) { spline->LocalD2(p.u, p.v, i, i + 1, k, k + 1, jet...); });
          const Span span = surface->span(p, {right ? -1.0 : 1.0, top ? -1.0 : 1.0});
          comparison.expect(array_of(surface->jet(p, span)), theirs, p);
        }
      }
    }
  }
}

TEST(JetsAgainstOcc, SweptSurfaces) {
  for (const OccSurface& s : test::swept_surfaces()) expect_same_jets(s, kSwept);
}

TEST(JetsAgainstOcc, Offsets) {
  for (const OccSurface& s : test::offset_surfaces()) {
    const auto basis = Handle(Geom_OffsetSurface)::DownCast(s.surface)->BasisSurface();
    const bool spline = basis->IsKind(STANDARD_TYPE(Geom_BSplineSurface));
    expect_same_jets(s, spline ? kOffsetOfSpline : kSwept);
  }
}

TEST(JetsAgainstOcc, RectangularTrims) {
  for (const OccSurface& s : test::trimmed_surfaces()) expect_same_jets(s, std::max(kSwept, spline_roundings(s)));
}

}  // namespace
}  // namespace geovor
