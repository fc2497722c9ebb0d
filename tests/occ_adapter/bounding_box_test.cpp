// The model's box holds the faces and touches them.
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepTools.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Face.hxx>

#include <filesystem>
#include <limits>
#include <map>

#include "brep/face_domain.h"
#include "occ_adapter/corpus.h"
#include "occ_adapter/read_cad.h"

namespace geovor {
namespace {

constexpr double kNear = 2e-8;  // of the diagonal: what the adapter promises for splines, once for each side

CadModel model_of(const TopoDS_Shape& shape) {
  const std::string file = test::scratch_folder("box") + "/shape.brep";
  BRepTools::Write(shape, file.c_str());
  return read_cad(file);
}

/// z = h(x) + h(y) over the unit square, as a spline through sums of its poles.
Handle(Geom_BSplineSurface) sum_surface(const std::vector<double>& h, int degree, const std::vector<double>& knots,
                                        const std::vector<int>& multiplicities) {
  const int n = static_cast<int>(h.size()), m = static_cast<int>(knots.size());
  TColStd_Array1OfReal t(1, m);
  TColStd_Array1OfInteger times(1, m);
  std::vector<double> flat;
  for (int i = 0; i < m; ++i) {
    t(i + 1) = knots[i];
    times(i + 1) = multiplicities[i];
    flat.insert(flat.end(), multiplicities[i], knots[i]);
  }
  // Greville's abscissae make x and y the parameters themselves.
  const auto greville = [&](int i) {
    double sum = 0.0;
    for (int k = 1; k <= degree; ++k) sum += flat[i + k];
    return sum / degree;
  };
  TColgp_Array2OfPnt poles(1, n, 1, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) poles(i + 1, j + 1) = gp_Pnt(greville(i), greville(j), h[i] + h[j]);
  }
  return new Geom_BSplineSurface(poles, t, t, times, times, degree, degree);
}

TEST(BoundingBox, TopOfAParaboloidInsideTheFaceIsFound) {
  // h = 4 s (1 - s): poles 0, 2, 0.
  const CadModel model = model_of(BRepBuilderAPI_MakeFace(sum_surface({0, 2, 0}, 2, {0, 1}, {3, 3}), 1e-7).Face());
  EXPECT_LT((model.lower - Xyz(0, 0, 0)).norm(), kNear);
  EXPECT_LT((model.upper - Xyz(1, 1, 2)).norm(), kNear);
}

TEST(BoundingBox, TopOfARoofWhoseRidgesAreCreasesIsFound) {
  // A hat of degree 1 and the same hat as a cubic with a threefold knot: no derivative vanishes at the top.
  for (const auto& surface : {sum_surface({0, 1, 0}, 1, {0, 0.3, 1}, {2, 1, 2}),
                              sum_surface({0, 1.0 / 3, 2.0 / 3, 1, 2.0 / 3, 1.0 / 3, 0}, 3, {0, 0.3, 1}, {4, 3, 4})}) {
    const CadModel model = model_of(BRepBuilderAPI_MakeFace(surface, 1e-7).Face());
    EXPECT_LT((model.lower - Xyz(0, 0, 0)).norm(), kNear);
    EXPECT_LT((model.upper - Xyz(1, 1, 2)).norm(), kNear);
  }
}

TEST(BoundingBox, WhatIsCutAwayFromASplineDoesNotCount) {
  // The paraboloid's quarter x, y < 0.25: its top is the corner, 2 * 4 * 0.25 * 0.75.
  const auto surface = sum_surface({0, 2, 0}, 2, {0, 1}, {3, 3});
  const CadModel model = model_of(BRepBuilderAPI_MakeFace(surface, 0.0, 0.25, 0.0, 0.25, 1e-7).Face());
  EXPECT_LT((model.upper - Xyz(0.25, 0.25, 1.5)).norm(), kNear);
}

/// No sample of the faces lies outside, and on each side one is near.
void expect_box_of_samples(const CadModel& model) {
  constexpr int kSteps = 300;  // which come within 1e-5 of the true extremes
  Xyz lower = Xyz::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  const auto add = [&](const Xyz& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  };
  for (const CadEdge& edge : model.edges) {
    if (edge.degenerate()) continue;
    for (int i = 0; i <= kSteps; ++i) add(edge.curve->position(edge.range.lo + edge.range.length() * i / kSteps));
  }
  for (const CadFace& face : model.faces) {
    const FaceDomain domain(model, face, 1e-5 * model.diagonal());
    const UvBox box = domain.box();
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        const Uv p{box.u.lo + box.u.length() * i / kSteps, box.v.lo + box.v.length() * j / kSteps};
        if (domain.contains(p)) add(face.surface->position(p));
      }
    }
  }
  EXPECT_GT((lower - model.lower).minCoeff(), -kNear * model.diagonal());
  EXPECT_GT((model.upper - upper).minCoeff(), -kNear * model.diagonal());
  EXPECT_LT((lower - model.lower).maxCoeff(), 1e-4 * model.diagonal());
  EXPECT_LT((model.upper - upper).maxCoeff(), 1e-4 * model.diagonal());
}

TEST(BoundingBox, HoldsEachSharedFaceTouchesItAndIsTheSameUnderEveryParameterization) {
  const std::string folder = test::shared_file("faces");
  SKIP_WITHOUT(folder);
  std::map<std::string, CadModel> originals;
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".step") continue;
    SCOPED_TRACE(entry.path().filename().string());
    const std::string name = entry.path().stem().string(), family = name.substr(0, name.find('_'));
    if (originals.count(family) == 0) originals[family] = read_cad(folder + "/" + family + "_orig.step");
    const CadModel& original = originals[family];
    const CadModel model = read_cad(entry.path().string());
    const double near = kNear * original.diagonal();
    EXPECT_LT((model.lower - original.lower).norm(), near);
    EXPECT_LT((model.upper - original.upper).norm(), near);
    ++compared;
  }
  EXPECT_GE(compared, 61);
  for (const auto& [family, model] : originals) expect_box_of_samples(model);
}

}  // namespace
}  // namespace geovor
