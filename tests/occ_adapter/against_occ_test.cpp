// The model's surfaces, p-curves and regions against OpenCASCADE's own evaluation of the same file.
#include <gtest/gtest.h>
#include <BRepClass_FaceClassifier.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "occ_adapter/corpus.h"
#include "occ_adapter/read_cad.h"

namespace geovor {
namespace {

/// A file as the adapter reads it and as OpenCASCADE does; read once for all tests of this program.
struct Pair {
  CadModel model;
  std::vector<TopoDS_Face> faces;
};

const Pair& pair_of(const std::string& path) {
  static std::map<std::string, Pair> read;
  const auto found = read.find(path);
  if (found != read.end()) return found->second;
  return read[path] = {read_cad(path), test::faces_of(test::read_by_occ(path))};
}

class AgainstOcc : public testing::TestWithParam<std::string> {};

Xyz xyz(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }
Uv uv(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

UvBox box_of(const CadFace& face) {
  UvBox box{{1e300, -1e300}, {1e300, -1e300}};
  for (const TrimLoop& loop : face.loops) {
    for (const Coedge& coedge : loop.coedges) {
      for (int i = 0; i <= 16; ++i) {
        const Uv p = uv(coedge.pcurve->position(coedge.range.lo + coedge.range.length() * i / 16));
        box.u = {std::min(box.u.lo, p.u), std::max(box.u.hi, p.u)};
        box.v = {std::min(box.v.lo, p.v), std::max(box.v.hi, p.v)};
      }
    }
  }
  return box;
}

/// Length over which the surface changes by about its size: the span, or the face where there are no spans.
double step(const Interval& span, const Interval& face) {
  return std::isfinite(span.length()) ? std::min(span.length(), face.length()) : face.length();
}

/// Points on which OpenCASCADE and the model surely mean the same piece: not on a knot.
bool near_knot(const Span& span, Uv p) {
  const double margin = 1e-9;
  const auto close = [margin](const Interval& i, double x) {
    const double scale = std::isfinite(i.length()) ? margin * i.length() : 0.0;
    return x - i.lo <= scale || i.hi - x <= scale;
  };
  return close(span.box.u, p.u) || close(span.box.v, p.v);
}

void expect_same_jet(const Surface& surface, const Handle(Geom_Surface) & occ, Uv p, const UvBox& box, double size) {
  const Span span = surface.span(p, {});
  if (near_knot(span, p)) return;
  const double hu = step(span.box.u, box.u), hv = step(span.box.v, box.v);
  const SurfaceJet jet = surface.jet(p);
  gp_Pnt S;
  gp_Vec Su, Sv, Suu, Svv, Suv;
  occ->D2(p.u, p.v, S, Su, Sv, Suu, Svv, Suv);
  const double scale = std::max(size, xyz(S.XYZ()).norm());
  constexpr double kRounding = 1e-12;
  // Differences of poles over a span amplify rounding by (degree / h) a derivative, on either side of the comparison.
  constexpr double kDerivative = 300 * kRounding;
  EXPECT_LE((jet.S - xyz(S.XYZ())).norm(), kRounding * scale);
  EXPECT_LE((jet.Su - xyz(Su.XYZ())).norm(), kDerivative * std::max(scale / hu, jet.Su.norm()));
  EXPECT_LE((jet.Sv - xyz(Sv.XYZ())).norm(), kDerivative * std::max(scale / hv, jet.Sv.norm()));
  EXPECT_LE((jet.Suu - xyz(Suu.XYZ())).norm(), kDerivative * std::max(scale / (hu * hu), jet.Suu.norm()));
  EXPECT_LE((jet.Svv - xyz(Svv.XYZ())).norm(), kDerivative * std::max(scale / (hv * hv), jet.Svv.norm()));
  EXPECT_LE((jet.Suv - xyz(Suv.XYZ())).norm(), kDerivative * std::max(scale / (hu * hv), jet.Suv.norm()));
}

TEST_P(AgainstOcc, JetsAreThoseOfTheFileAtRandomPoints) {
  const std::string path = test::shared_file(GetParam());
  SKIP_WITHOUT(path);
  const auto& [model, faces] = pair_of(path);
  ASSERT_EQ(model.faces.size(), faces.size());
  std::mt19937 random(20240607);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    SCOPED_TRACE("Face" + std::to_string(i + 1));
    ASSERT_NE(model.faces[i].surface, nullptr);
    const Handle(Geom_Surface) occ = BRep_Tool::Surface(faces[i]);
    const UvBox box = box_of(model.faces[i]);
    std::uniform_real_distribution<double> u(box.u.lo, box.u.hi), v(box.v.lo, box.v.hi);
    for (int k = 0; k < 20; ++k)
      expect_same_jet(*model.faces[i].surface, occ, {u(random), v(random)}, box, model.diagonal());
    if (HasFailure()) return;
  }
}

/// Whether some coedge of the face is the use of the edge that OpenCASCADE states, up to whole periods.
bool has_coedge(const CadFace& face, const Geom2d_Curve& pcurve, double first, double last, bool reversed) {
  const auto matches = [&](const Coedge& coedge) {
    if (coedge.reversed != reversed || coedge.range.lo != first || coedge.range.hi != last) return false;
    for (int i = 0; i <= 8; ++i) {
      const double t = first + (last - first) * i / 8;
      const gp_Pnt2d occ = pcurve.Value(t);
      Eigen::Vector2d difference = coedge.pcurve->position(t) - Eigen::Vector2d(occ.X(), occ.Y());
      if (const auto period = face.surface->u_period()) difference.x() = std::remainder(difference.x(), *period);
      if (const auto period = face.surface->v_period()) difference.y() = std::remainder(difference.y(), *period);
      if (!(difference.norm() <= 1e-12 * (1.0 + std::hypot(occ.X(), occ.Y())))) return false;
    }
    return true;
  };
  return std::any_of(face.loops.begin(), face.loops.end(), [&](const TrimLoop& loop) {
    return std::any_of(loop.coedges.begin(), loop.coedges.end(), matches);
  });
}

TEST_P(AgainstOcc, EveryUseOfAnEdgeIsACoedgeWithItsCurve) {
  const std::string path = test::shared_file(GetParam());
  SKIP_WITHOUT(path);
  const auto& [model, faces] = pair_of(path);
  ASSERT_EQ(model.faces.size(), faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    SCOPED_TRACE("Face" + std::to_string(i + 1));
    const TopoDS_Face forward = TopoDS::Face(faces[i].Oriented(TopAbs_FORWARD));
    std::size_t uses = 0, coedges = 0;
    for (const TrimLoop& loop : model.faces[i].loops) coedges += loop.coedges.size();
    for (TopExp_Explorer edge(forward, TopAbs_EDGE); edge.More(); edge.Next(), ++uses) {
      double first, last;
      const auto pcurve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Current()), forward, first, last);
      const bool reversed = edge.Current().Orientation() == TopAbs_REVERSED;
      EXPECT_TRUE(has_coedge(model.faces[i], *pcurve, first, last, reversed)) << "use " << uses;
    }
    EXPECT_EQ(coedges, uses);
  }
}

/// Signed turns of the loops about p, and how near they pass.
struct Winding {
  int turns = 0;
  double nearest = 1e300;  ///< relative to the extents of the face
};

Winding winding(const CadFace& face, const UvBox& box, Uv p) {
  constexpr int kChords = 200;
  Winding result;
  for (const TrimLoop& loop : face.loops) {
    std::vector<Uv> polygon;
    for (const Coedge& coedge : loop.coedges) {
      for (int i = 0; i < kChords; ++i) {
        const double k = static_cast<double>(coedge.reversed ? kChords - i : i) / kChords;
        polygon.push_back(uv(coedge.pcurve->position(coedge.range.lo + k * coedge.range.length())));
      }
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Uv a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      const UvVec ab = b - a, ap = p - a;
      const double length2 = ab.u * ab.u + ab.v * ab.v;
      const double k = length2 > 0.0 ? std::clamp((ap.u * ab.u + ap.v * ab.v) / length2, 0.0, 1.0) : 0.0;
      result.nearest =
          std::min(result.nearest, std::hypot((ap.u - k * ab.u) / box.u.length(), (ap.v - k * ab.v) / box.v.length()));
      if ((a.v <= p.v) == (b.v <= p.v)) continue;
      if ((cross(ab, ap) > 0.0) == (b.v > a.v)) result.turns += b.v > a.v ? 1 : -1;
    }
  }
  return result;
}

// OpenCASCADE's classifier knows which points of the parameter plane belong to a face. The loops turn once about each
// of them and not at all about the others only if outer loops run counter-clockwise, holes clockwise, and all are
// closed.
TEST_P(AgainstOcc, LoopsTurnOnceAboutEveryPointOfTheFace) {
  const std::string path = test::shared_file(GetParam());
  SKIP_WITHOUT(path);
  const auto& [model, faces] = pair_of(path);
  ASSERT_EQ(model.faces.size(), faces.size());
  std::mt19937 random(77);
  int inside = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    SCOPED_TRACE("Face" + std::to_string(i + 1));
    const UvBox box = box_of(model.faces[i]);
    std::uniform_real_distribution<double> u(box.u.lo, box.u.hi), v(box.v.lo, box.v.hi);
    for (int k = 0; k < 12; ++k) {
      const Uv p{u(random), v(random)};
      const Winding turns = winding(model.faces[i], box, p);
      if (turns.nearest < 0.02) continue;
      BRepClass_FaceClassifier classifier(faces[i], gp_Pnt2d(p.u, p.v), 1e-9);
      EXPECT_EQ(turns.turns, classifier.State() == TopAbs_IN ? 1 : 0) << p.u << ", " << p.v;
      inside += turns.turns;
    }
  }
  EXPECT_GT(inside, 0);
}

TEST_P(AgainstOcc, EdgesLieOnTheirSurfacesWithinTheirTolerance) {
  const std::string path = test::shared_file(GetParam());
  SKIP_WITHOUT(path);
  const CadModel& model = pair_of(path).model;
  for (const CadFace& face : model.faces) {
    SCOPED_TRACE("Face" + std::to_string(face.number));
    for (const TrimLoop& loop : face.loops) {
      for (const Coedge& coedge : loop.coedges) {
        const CadEdge& edge = model.edges[static_cast<std::size_t>(coedge.edge)];
        if (edge.degenerate()) continue;
        ASSERT_EQ(coedge.range.lo, edge.range.lo);
        ASSERT_EQ(coedge.range.hi, edge.range.hi);
        for (int i = 0; i <= 20; ++i) {
          const double t = edge.range.lo + edge.range.length() * i / 20;
          const Xyz on_surface = face.surface->position(uv(coedge.pcurve->position(t)));
          ASSERT_LE((edge.curve->position(t) - on_surface).norm(), 1.1 * edge.tolerance);
        }
        const Xyz first = edge.curve->position(edge.range.lo), last = edge.curve->position(edge.range.hi);
        const auto& v = model.vertices;
        const CadVertex& from = v[static_cast<std::size_t>(edge.first_vertex)];
        const CadVertex& to = v[static_cast<std::size_t>(edge.last_vertex)];
        ASSERT_LE((first - from.position).norm(), 1.1 * from.tolerance);
        ASSERT_LE((last - to.position).norm(), 1.1 * to.tolerance);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Corpus, AgainstOcc, testing::ValuesIn(test::varied_files()), [](const auto& test) {
  std::string name = test.param.substr(test.param.find_last_of("/_") + 1);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name + "_" + std::to_string(test.index);
});

}  // namespace
}  // namespace geovor
