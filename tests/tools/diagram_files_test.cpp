// The files of a diagram: what JSON and SVG say of a small diagram made by hand.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "diagram_json.h"
#include "io/diagram_svg.h"
#include "io/path_data.h"

namespace geovor {
namespace {

/// Two cells of the square [0, 2] x [0, 1] on a plane, sites at (0.5, 0.1) and (1.5, 0.1).
struct TwoCells {
  VoronoiDiagram diagram;
  DualGraph dual;
  DocumentSource source;
  CellRaster raster;

  TwoCells() {
    const auto space = [](Uv p) { return Xyz(p.u, p.v, 1.0 / 3.0); };
    diagram.tolerance = 1e-5;
    for (Uv p : {Uv{0.5, 0.1}, Uv{1.5, 0.1}}) diagram.sites.push_back({p, space(p)});
    DiagramEdge edge;
    edge.left = 0, edge.right = 1, edge.from = 0, edge.to = 1, edge.length = 1.0;
    for (int i = 0; i < 2; ++i) {
      const Uv p = {1.0, static_cast<double>(i)};
      const double radius = std::hypot(0.5, p.v - 0.1);
      edge.points.push_back({p, space(p), radius, 0, 0, 0, 0, 0});
      DiagramVertex v;
      v.uv = p, v.xyz = space(p), v.radius = radius, v.on_boundary = true, v.sites = {1, 0};
      v.spokes = {{0, i == 1}};
      diagram.vertices.push_back(v);
    }
    diagram.edges.push_back(edge);
    for (int site = 0; site < 2; ++site) {
      DiagramCell cell;
      cell.site = site, cell.area = 1.0;
      CellPiece along, border;
      along.edge = 0, along.reversed = site == 1;
      border.from_vertex = 1 - site, border.to_vertex = site, border.border_cycle = 0;
      for (Uv p : {Uv{1, 1}, Uv{2.0 * site, 1}, Uv{2.0 * site, 0}, Uv{1, 0}}) {
        border.border_uv.push_back(p);
        border.border_xyz.push_back(space(p));
      }
      cell.loops = {{along, border}};
      diagram.cells.push_back(cell);
      CellPatch patch;
      patch.uv = {Uv{1.0 * site, 0}, Uv{1.0 + site, 0}, Uv{1.0 + site, 1}, Uv{1.0 * site, 1}};
      for (int k = 0; k < 4; ++k) patch.xyz[k] = space(patch.uv[k]);
      patch.site = site;
      raster.patches.push_back(patch);
    }
    raster.box = {{0, 2}, {0, 1}};
    diagram.warnings.push_back({"path_leaves_face", {1}, {1.9, 0.5}, "a \"quoted\" word"});
    dual.edges.push_back({0, 1, 0, 1.0, 0.0, true, {{0.5, 0.1}, {1.5, 0.1}}, {space({0.5, 0.1}), space({1.5, 0.1})}});
    dual.why_not = "there are fewer than three sites";
    source = {"geovor test", "two.step", 3, "mm", "plane", raster.box, std::nullopt, 2.0 / 3.0};
  }

  nlohmann::json json() const { return nlohmann::json::parse(diagram_json(source, diagram, dual)); }
};

TEST(DiagramJson, HasTheMembersOfTheFormat) {
  const auto j = TwoCells().json();
  EXPECT_EQ(j["format"], "geovor-voronoi");
  EXPECT_EQ(j["version"], 1);
  EXPECT_EQ(j["generator"], "geovor test");
  EXPECT_EQ(j["input"], "two.step");
  EXPECT_EQ(j["face"], 3);
  EXPECT_EQ(j["unit"], "mm");
  EXPECT_EQ(j["surface"]["type"], "plane");
  EXPECT_TRUE(j["surface"]["u_period"].is_null());
  EXPECT_EQ(j["surface"]["u"], nlohmann::json({0.0, 2.0}));
  EXPECT_EQ(j["vertices"][1]["sites"], nlohmann::json({1, 0}));
  EXPECT_TRUE(j["vertices"][1]["on_boundary"]);
  EXPECT_EQ(j["edges"][0]["kind"], "bisector");
  EXPECT_EQ(j["edges"][0]["vertices"], nlohmann::json({0, 1}));
  EXPECT_FALSE(j["edges"][0]["closed"]);
  EXPECT_EQ(j["cells"][1]["loops"][0][0], (nlohmann::json{{"edge", 0}, {"reversed", true}}));
  EXPECT_EQ(j["cells"][0]["loops"][0][1]["boundary"]["points"].size(), 4u);
  EXPECT_EQ(j["warnings"][0]["text"], "a \"quoted\" word");
  EXPECT_EQ(j["delaunay"]["edges"][0], (nlohmann::json{{"sites", {0, 1}}, {"length", 1.0}}));
  EXPECT_EQ(j["delaunay"]["triangles"], nlohmann::json::array());
  EXPECT_FALSE(j["delaunay"]["is_triangulation"]);
  EXPECT_EQ(j["delaunay"]["why_not"], "there are fewer than three sites");
}

TEST(DiagramJson, NumbersReadBackAsTheSameDouble) {
  TwoCells two;
  two.diagram.vertices[0].radius = 0.1 + 0.2;
  two.diagram.vertices[1].radius = 5e-324;
  const auto j = two.json();
  EXPECT_EQ(j["vertices"][0]["radius"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(j["vertices"][1]["radius"].get<double>(), 5e-324);
  EXPECT_EQ(j["sites"][0]["xyz"][2].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(j["surface"]["v_period"].get<double>(), 2.0 / 3.0);
}

TEST(DiagramJson, AClosedEdgeHasNoVertices) {
  TwoCells two;
  two.diagram.edges[0].from = two.diagram.edges[0].to = -1;
  two.diagram.edges[0].kind = EdgeKind::CutLocus;
  const auto j = two.json();
  EXPECT_TRUE(j["edges"][0]["vertices"].is_null());
  EXPECT_TRUE(j["edges"][0]["closed"]);
  EXPECT_EQ(j["edges"][0]["kind"], "cut_locus");
}

TEST(DiagramJson, WhatIsNotFiniteIsNull) {
  TwoCells two;
  two.diagram.edges[0].residual = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(two.json()["edges"][0]["residual"].is_null());
}

TEST(DiagramJson, ACertificateNamesWhatFails) {
  TwoCells two;
  Certificate certificate;
  certificate.claims.push_back(
      {"areas", "they add up", true, 1e-9, 1e-6, CertificateClaim::Offender::None, -1, {}, ""});
  certificate.claims.push_back(
      {"stars", "angles grow", false, 0.5, 1e-9, CertificateClaim::Offender::Edge, 7, {0.25, 0.5}, "turns back"});
  certificate.not_covered = {1};
  certificate.result = "not proved";
  const auto j = nlohmann::json::parse(diagram_json(two.source, two.diagram, two.dual, &certificate))["certificate"];
  EXPECT_FALSE(j["holds"]);
  EXPECT_EQ(j["result"], "not proved");
  EXPECT_EQ(j["not_covered"], nlohmann::json({1}));
  EXPECT_TRUE(j["claims"][0]["holds"]);
  EXPECT_TRUE(j["claims"][0]["offender"].is_null());
  EXPECT_EQ(j["claims"][1]["measured"], 0.5);
  EXPECT_EQ(j["claims"][1]["offender"],
            (nlohmann::json{{"kind", "edge"}, {"id", 7}, {"uv", {0.25, 0.5}}, {"why", "turns back"}}));
}

TEST(DiagramJson, CannotBeWrittenIntoAMissingFolder) {
  const TwoCells two;
  const auto path = std::filesystem::temp_directory_path() / "no such folder" / "x.json";
  try {
    write_diagram_json(two.source, two.diagram, two.dual, nullptr, path.string());
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::Unwritable);
  }
}

int occurrences(const std::string& text, const std::string& what) {
  int n = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(DiagramSvg, DrawsEverySiteAndEdgeInBothViews) {
  const TwoCells two;
  const std::string svg = diagram_svg(two.diagram, two.dual, two.raster);
  EXPECT_EQ(svg.rfind("<svg xmlns=\"http://www.w3.org/2000/svg\"", 0), 0u);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(occurrences(svg, "<circle"), 4);
  EXPECT_EQ(occurrences(svg, "class=\"e\""), 2);
  EXPECT_EQ(occurrences(svg, "class=\"d\""), 2);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(PathData, StepsFromPointToPointInTenths) {
  PathData path;
  path.move({10.04, 0.26, 0.0});
  path.line({10.0, 0.3, 0.0});  // the same tenths
  path.line({12.5, -0.7, 0.0});
  path.line({12.0, -1.2, 0.0});
  path.line({13.0, -1.2, 0.0});
  path.line({13.0, 0.0, 0.0});
  path.close();
  path.move({0.0, 0.0, 0.0});
  EXPECT_EQ(path.text(), "M10 .3l2.5-1-.5-.5h1v1.2zM0 0");
}

TEST(DiagramSvg, LeavesOutWhatIsHidden) {
  TwoCells two;
  // A roof over the whole square, far above it.
  CellPatch roof = two.raster.patches[0];
  for (int k = 0; k < 4; ++k) roof.xyz[k] = {k == 0 || k == 3 ? -9.0 : 9.0, k < 2 ? -9.0 : 9.0, 5.0};
  two.raster.patches.push_back(roof);
  const std::string svg = diagram_svg(two.diagram, two.dual, two.raster);
  EXPECT_EQ(occurrences(svg, "<circle"), 2);
  EXPECT_EQ(occurrences(svg, "class=\"e\""), 1);
}

}  // namespace
}  // namespace geovor
