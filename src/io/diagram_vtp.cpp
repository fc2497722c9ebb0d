#include "io/diagram_vtp.h"

#include <cmath>
#include <limits>

#include "io/atomic_file.h"
#include "io/number_text.h"

namespace geovor {
namespace {

enum class Kind { Site, Bisector, CutLocus, Border, Cell };

/// The arrays of the file on their way. VTK numbers cells in the order verts, lines, polys.
class PolyData {
 public:
  void add_point(const Xyz& x, double radius) {
    for (int k = 0; k < 3; ++k) append_shortest(points_, x[k]), points_ += k < 2 ? ' ' : '\n';
    if (std::isnan(radius)) {
      radius_ += "nan";
    } else {
      append_shortest(radius_, radius);
    }
    radius_ += '\n';
    ++count_;
  }

  void cell_data(Kind kind, int id, int a, int b) {
    kind_ += std::to_string(static_cast<int>(kind)) + '\n';
    id_ += std::to_string(id) + '\n';
    a_ += std::to_string(a) + '\n';
    b_ += std::to_string(b) + '\n';
  }

  struct Cells {
    std::string connectivity, offsets;
    int count = 0, used = 0;
    void add(const std::vector<int>& corners) {
      for (int c : corners) connectivity += std::to_string(c) + ' ';
      connectivity += '\n';
      used += static_cast<int>(corners.size());
      offsets += std::to_string(used) + '\n';
      ++count;
    }
  };

  int count() const { return count_; }

  std::string text() const {
    std::string out =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n"
        "<Piece NumberOfPoints=\"" +
        std::to_string(count_) + "\" NumberOfVerts=\"" + std::to_string(verts.count) + "\" NumberOfLines=\"" +
        std::to_string(lines.count) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(polys.count) +
        "\">\n";
    out += "<PointData>\n" + array("Float64", "radius", 1, radius_) + "</PointData>\n<CellData>\n";
    out += array("Int32", "kind", 1, kind_) + array("Int32", "id", 1, id_) + array("Int32", "site_a", 1, a_) +
           array("Int32", "site_b", 1, b_);
    out += "</CellData>\n<Points>\n" + array("Float64", "points", 3, points_) + "</Points>\n";
    out += section("Verts", verts) + section("Lines", lines) + section("Polys", polys);
    return out + "</Piece>\n</PolyData>\n</VTKFile>\n";
  }

  Cells verts, lines, polys;

 private:
  static std::string array(const char* type, const char* name, int components, const std::string& values) {
    return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
           std::to_string(components) + "\" format=\"ascii\">\n" + values + "</DataArray>\n";
  }

  static std::string section(const char* name, const Cells& cells) {
    return std::string("<") + name + ">\n" + array("Int32", "connectivity", 1, cells.connectivity) +
           array("Int32", "offsets", 1, cells.offsets) + "</" + name + ">\n";
  }

  std::string points_, radius_, kind_, id_, a_, b_;
  int count_ = 0;
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::string diagram_vtp(const VoronoiDiagram& diagram, const CellMesh& cells) {
  PolyData data;
  for (int i = 0; i < static_cast<int>(diagram.sites.size()); ++i) {
    data.verts.add({data.count()});
    data.add_point(diagram.sites[i].xyz, 0.0);
    data.cell_data(Kind::Site, i, i, -1);
  }
  const auto line = [&](const auto& points, const auto& add) {
    std::vector<int> corners;
    for (const auto& p : points) corners.push_back(data.count()), add(p);
    data.lines.add(corners);
  };
  for (int e = 0; e < static_cast<int>(diagram.edges.size()); ++e) {
    const DiagramEdge& edge = diagram.edges[e];
    line(edge.points, [&](const EdgePoint& p) { data.add_point(p.xyz, p.radius); });
    data.cell_data(edge.kind == EdgeKind::CutLocus ? Kind::CutLocus : Kind::Bisector, e, edge.left, edge.right);
  }
  for (const auto& border : cells.border) {
    line(border, [&](const Xyz& x) { data.add_point(x, kNone); });
    data.cell_data(Kind::Border, -1, -1, -1);
  }
  const int base = data.count();
  for (const Xyz& x : cells.points) data.add_point(x, kNone);
  for (size_t t = 0; t < cells.triangles.size(); ++t) {
    const auto [a, b, c] = cells.triangles[t];
    data.polys.add({base + a, base + b, base + c});
    data.cell_data(Kind::Cell, cells.site_of[t], cells.site_of[t], -1);
  }
  return data.text();
}

void write_diagram_vtp(const VoronoiDiagram& diagram, const CellMesh& cells, const std::string& path) {
  write_file(path, diagram_vtp(diagram, cells));
}

}  // namespace geovor
