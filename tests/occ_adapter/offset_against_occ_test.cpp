// Third derivatives of B-splines, and the second ones of their offsets, against OpenCASCADE's D3 and D2.
#include <gtest/gtest.h>
#include <Geom_BSplineSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Ax3.hxx>

#include <algorithm>
#include <memory>

#include "support/splines.h"
#include "surface/elementary_surfaces.h"
#include "surface/offset_surface.h"

namespace geovor {
namespace {

using testing::SplineData;

Xyz xyz(const gp_Vec& v) { return {v.X(), v.Y(), v.Z()}; }
Xyz xyz(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

struct OccKnots {
  TColStd_Array1OfReal knots;
  TColStd_Array1OfInteger multiplicities;
  explicit OccKnots(const KnotVector& k)
      : knots(1, static_cast<int>(k.lines().size())), multiplicities(1, static_cast<int>(k.lines().size())) {
    for (int i = 1; i <= knots.Length(); ++i) {
      knots(i) = k.lines()[i - 1];
      multiplicities(i) = static_cast<int>(std::count(k.flat().begin(), k.flat().end(), knots(i)));
    }
  }
};

Handle(Geom_BSplineSurface) occ_surface(const SplineData& d) {
  const OccKnots u(KnotVector::from_flat(d.u_knots, d.u_degree)), v(KnotVector::from_flat(d.v_knots, d.v_degree));
  TColgp_Array2OfPnt poles(1, d.u_count(), 1, d.v_count());
  TColStd_Array2OfReal weights(1, d.u_count(), 1, d.v_count());
  for (int i = 0; i < d.u_count(); ++i) {
    for (int j = 0; j < d.v_count(); ++j) {
      const Xyz& p = d.poles[i * d.v_count() + j];
      poles(i + 1, j + 1) = gp_Pnt(p.x(), p.y(), p.z());
      weights(i + 1, j + 1) = d.weights.empty() ? 1.0 : d.weights[i * d.v_count() + j];
    }
  }
  return new Geom_BSplineSurface(poles, weights, u.knots, v.knots, u.multiplicities, v.multiplicities, d.u_degree,
                                 d.v_degree);
}

/// A sum of poles rounds by a few eps of their size; a derivative multiplies that by 2 degree / span, about 10 here.
constexpr double kRounding = 1e-15, kDerivative = 10.0;

/// Calls visit(surface, occ, p) for splines of several degrees, at seeded points of their domains.
template <class Visit>
void for_splines(const Visit& visit) {
  for (const bool rational : {false, true}) {
    for (const auto& [p, q] : {std::pair{3, 3}, {2, 2}, {5, 4}, {1, 6}}) {
      const SplineData d = testing::random_spline(p, q, 3, rational, 10 * p + q);
      const auto surface = std::make_shared<BSplineSurface>(d.surface());
      const Handle(Geom_BSplineSurface) occ = occ_surface(d);
      std::mt19937 random(p);
      for (int i = 0; i < 200; ++i) visit(surface, occ, testing::random_point(random, surface->domain()));
    }
  }
}

TEST(ThirdDerivatives, OfSplinesAreThoseOfOpenCascade) {
  for_splines([](const SurfacePtr& surface, const Handle(Geom_BSplineSurface) & occ, Uv p) {
    gp_Pnt S;
    gp_Vec u, v, uu, vv, uv, uuu, vvv, uuv, uvv;
    occ->D3(p.u, p.v, S, u, v, uu, vv, uv, uuu, vvv, uuv, uvv);
    const SurfaceThirds t = surface->third(p, surface->span(p, {}));
    const double size = std::max({uuu.Magnitude(), uuv.Magnitude(), uvv.Magnitude(), vvv.Magnitude()});
    const double bound = kRounding * (size + 5.0 * kDerivative * kDerivative * kDerivative);
    EXPECT_LT((t.uuu - xyz(uuu)).norm(), bound);
    EXPECT_LT((t.uuv - xyz(uuv)).norm(), bound);
    EXPECT_LT((t.uvv - xyz(uvv)).norm(), bound);
    EXPECT_LT((t.vvv - xyz(vvv)).norm(), bound);
  });
}

TEST(OffsetSurface, OfSplinesIsThatOfOpenCascade) {
  double worst = 0.0;
  for_splines([&worst](const SurfacePtr& surface, const Handle(Geom_BSplineSurface) & basis, Uv p) {
    const double distance = 0.05;
    const OffsetSurface offset(surface, distance);
    const Handle(Geom_OffsetSurface) occ = new Geom_OffsetSurface(basis, distance, true);
    gp_Pnt S;
    gp_Vec u, v, uu, vv, uv;
    occ->D2(p.u, p.v, S, u, v, uu, vv, uv);
    const SurfaceJet j = offset.jet(p);
    const SurfaceThirds t = surface->third(p, surface->span(p, {}));
    const double first = std::max(u.Magnitude(), v.Magnitude());
    const double second = std::max({uu.Magnitude(), vv.Magnitude(), uv.Magnitude(), t.uuu.norm(), t.vvv.norm()});
    EXPECT_LT((j.S - xyz(S)).norm(), 5e-14);
    EXPECT_LT(std::max((j.Su - xyz(u)).norm(), (j.Sv - xyz(v)).norm()), 1e-13 * first);
    const double off =
        std::max({(j.Suu - xyz(uu)).norm(), (j.Suv - xyz(uv)).norm(), (j.Svv - xyz(vv)).norm()}) / second;
    worst = std::max(worst, off);
  });
  EXPECT_LT(worst, 1e-12);
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

}  // namespace
}  // namespace geovor
