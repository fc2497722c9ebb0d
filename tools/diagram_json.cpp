#include "diagram_json.h"

#include "io/atomic_file.h"

namespace geovor {
namespace {

Json index_or_null(int i) { return i >= 0 ? Json(i) : Json(nullptr); }

Json sites_json(const VoronoiDiagram& d) {
  return each(d.sites, [](size_t i, const DiagramSite& s) {
    return Json{{"id", i}, {"uv", pair(s.uv)}, {"xyz", triple(s.xyz)}};
  });
}

Json vertices_json(const VoronoiDiagram& d) {
  return each(d.vertices, [](size_t i, const DiagramVertex& v) {
    return Json{{"id", i},
                {"uv", pair(v.uv)},
                {"xyz", triple(v.xyz)},
                {"radius", v.radius},
                {"sites", v.sites},
                {"on_boundary", v.on_boundary},
                {"residual", v.residual}};
  });
}

Json edges_json(const VoronoiDiagram& d) {
  return each(d.edges, [](size_t i, const DiagramEdge& e) {
    Json points = each(e.points, [](size_t, const EdgePoint& p) {
      return Json{{"uv", pair(p.uv)}, {"xyz", triple(p.xyz)}, {"radius", p.radius}};
    });
    return Json{{"id", i},
                {"sites", {e.left, e.right}},
                {"vertices", e.closed() ? Json(nullptr) : Json::array({e.from, e.to})},
                {"closed", e.closed()},
                {"kind", e.kind == EdgeKind::CutLocus ? "cut_locus" : "bisector"},
                {"length", e.length},
                {"points", std::move(points)},
                {"residual", e.residual}};
  });
}

Json piece_json(const CellPiece& piece) {
  if (piece.edge >= 0) return Json{{"edge", piece.edge}, {"reversed", piece.reversed}};
  Json points = each(piece.border_uv, [&](size_t i, Uv p) {
    return Json{{"uv", pair(p)}, {"xyz", triple(piece.border_xyz[i])}};
  });
  return Json{{"boundary",
               {{"cycle", piece.border_cycle},
                {"from", index_or_null(piece.from_vertex)},
                {"to", index_or_null(piece.to_vertex)},
                {"points", std::move(points)}}}};
}

Json cells_json(const VoronoiDiagram& d) {
  return each(d.cells, [](size_t, const DiagramCell& cell) {
    Json loops = each(cell.loops, [](size_t, const std::vector<CellPiece>& loop) {
      return each(loop, [](size_t, const CellPiece& piece) { return piece_json(piece); });
    });
    return Json{{"site", cell.site}, {"loops", std::move(loops)}, {"area", cell.area}};
  });
}

Json warnings_json(const VoronoiDiagram& d) {
  return each(d.warnings, [](size_t, const DiagramWarning& w) {
    return Json{{"kind", w.kind}, {"sites", w.sites}, {"uv", pair(w.uv)}, {"text", w.text}};
  });
}

Json dual_json(const DualGraph& dual) {
  Json edges = each(dual.edges, [](size_t, const DualEdge& e) {
    return Json{{"sites", {e.a, e.b}}, {"length", e.length}};
  });
  return Json{{"edges", std::move(edges)},
              {"triangles", dual.triangles},
              {"is_triangulation", dual.is_triangulation},
              {"why_not", dual.why_not.empty() ? Json(nullptr) : Json(dual.why_not)}};
}

const char* word(CertificateClaim::Offender offender) {
  switch (offender) {
    case CertificateClaim::Offender::Vertex:
      return "vertex";
    case CertificateClaim::Offender::Edge:
      return "edge";
    case CertificateClaim::Offender::Cell:
      return "cell";
    default:
      return "diagram";
  }
}

Json certificate_json(const Certificate& certificate) {
  Json claims = each(certificate.claims, [](size_t, const CertificateClaim& c) {
    Json claim{{"name", c.name},         {"statement", c.statement}, {"holds", c.holds},
               {"measured", c.measured}, {"bound", c.bound},         {"offender", nullptr}};
    if (!c.holds) claim["offender"] = {{"kind", word(c.offender)}, {"id", c.id}, {"uv", pair(c.uv)}, {"why", c.why}};
    return claim;
  });
  return Json{{"holds", certificate.holds()},
              {"result", certificate.result},
              {"not_covered", certificate.not_covered},
              {"claims", std::move(claims)}};
}

}  // namespace

std::string diagram_json(const DocumentSource& source, const VoronoiDiagram& diagram, const DualGraph& dual,
                         const Certificate* certificate) {
  Json document = document_head("geovor-voronoi", source);
  document["tolerance"] = diagram.tolerance;
  document["surface"] = surface_json(source);
  document["sites"] = sites_json(diagram);
  document["vertices"] = vertices_json(diagram);
  document["edges"] = edges_json(diagram);
  document["cells"] = cells_json(diagram);
  document["warnings"] = warnings_json(diagram);
  document["delaunay"] = dual_json(dual);
  if (certificate != nullptr) document["certificate"] = certificate_json(*certificate);
  return document_text(document);
}

void write_diagram_json(const DocumentSource& source, const VoronoiDiagram& diagram, const DualGraph& dual,
                        const Certificate* certificate, const std::string& path) {
  write_file(path, diagram_json(source, diagram, dual, certificate));
}

}  // namespace geovor
