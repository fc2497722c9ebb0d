#include "pipeline/cell_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "delaunay/polygon_triangulation.h"
#include "pipeline/cell_sheet.h"

namespace geovor {
namespace {

// How far triangles may lie from the surface, as a part of the face's size: less than a unit of a usual screen.
constexpr double kEye = 3e-4;
// Grid lines a direction at most, and samples of the bending a direction.
constexpr int kMostGridLines = 160;
constexpr int kBendSamples = 24;

using Polygon = std::vector<Uv>;

/// Keeps of a polyline what the eye needs, its ends always (Douglas and Peucker).
void thin_out(const SheetLine& line, int first, int last, double eye, std::vector<char>& keep) {
  const Xyz a = line.xyz[first], way = line.xyz[last] - a;
  const double square = way.squaredNorm();
  int farthest = -1;
  double most = eye;
  for (int i = first + 1; i < last; ++i) {
    const Xyz to = line.xyz[i] - a;
    const double k = square > 0.0 ? std::clamp(to.dot(way) / square, 0.0, 1.0) : 0.0;
    const double off = (to - k * way).norm();
    if (off > most) most = off, farthest = i;
  }
  if (farthest < 0) return;
  keep[farthest] = 1;
  thin_out(line, first, farthest, eye, keep);
  thin_out(line, farthest, last, eye, keep);
}

class CellMesher {
 public:
  CellMesher(const FaceOutline& outline, const CellSheet& sheet, bool reversed)
      : outline_(outline), surface_(outline.surface()), sheet_(sheet), turn_(reversed ? -1.0 : 1.0) {
    Xyz lower = Xyz::Constant(1e300), upper = -lower;
    for (const SheetLine& line : sheet.lines) {
      for (const Xyz& x : line.xyz) lower = lower.cwiseMin(x), upper = upper.cwiseMax(x);
    }
    eye_ = kEye * (upper - lower).norm();
    choose_grid();
    for (const SheetLine& line : sheet.lines) thin_.push_back(thinned(line));
  }

  CellMesh run() {
    for (const SheetCell& cell : sheet_.cells) {
      if (!add_cell(cell, true)) add_cell(cell, false);
    }
    for (size_t i = 0; i < sheet_.lines.size(); ++i) {
      const SheetLine& line = sheet_.lines[i];
      if (line.run < 0 && FaceOutline::kind(outline_.sides()[line.side]) == SideKind::Border) {
        mesh_.border.push_back(line.xyz);
      }
    }
    return std::move(mesh_);
  }

 private:
  /// Steps at which a chord of the surface stays within the eye's tolerance.
  void choose_grid() {
    const UvBox& box = outline_.box();
    double bend_u = 0.0, bend_v = 0.0, length_u = 0.0, length_v = 0.0;
    for (int i = 0; i < kBendSamples; ++i) {
      for (int k = 0; k < kBendSamples; ++k) {
        const SurfaceJet j = surface_.jet({box.u.lo + (i + 0.5) / kBendSamples * box.u.length(),
                                           box.v.lo + (k + 0.5) / kBendSamples * box.v.length()});
        bend_u = std::max(bend_u, j.Suu.norm() + j.Suv.norm() * box.v.length() / box.u.length());
        bend_v = std::max(bend_v, j.Svv.norm() + j.Suv.norm() * box.u.length() / box.v.length());
        length_u = std::max(length_u, j.Su.norm() * box.u.length());
        length_v = std::max(length_v, j.Sv.norm() * box.v.length());
      }
    }
    const auto lines = [&](double bend, double length) {
      const double wanted = length * std::sqrt(bend / (8.0 * eye_));
      return wanted < kMostGridLines ? static_cast<int>(std::ceil(wanted)) : kMostGridLines;
    };
    const int u = std::max(1, lines(bend_u, box.u.length())), v = std::max(1, lines(bend_v, box.v.length()));
    // Where one direction bends, long triangles along the other one would twist across the bend.
    constexpr double kLongest = 3.0;
    const auto other = [&](int n, double length, int across, double width) {
      const double wanted = across > 1 ? length * across / (kLongest * width) : 0.0;
      return std::max(n, wanted < kMostGridLines ? static_cast<int>(std::ceil(wanted)) : kMostGridLines);
    };
    grid_u_ = other(u, length_u, v, length_v), grid_v_ = other(v, length_v, u, length_u);
  }

  std::vector<char> thinned(const SheetLine& line) const {
    std::vector<char> keep(line.uv.size(), 0);
    keep.front() = keep.back() = 1;
    // A line that closes on itself keeps its middle too: two ends alone would have no length.
    const int last = static_cast<int>(line.uv.size()) - 1;
    if (last >= 2)
      keep[last / 2] = 1, thin_out(line, 0, last / 2, eye_, keep), thin_out(line, last / 2, last, eye_, keep);
    return keep;
  }

  Polygon polygon(const std::vector<LineUse>& loop, bool thin) const {
    Polygon out;
    for (LineUse use : loop) {
      const SheetLine& line = sheet_.lines[use.line];
      const int n = static_cast<int>(line.uv.size());
      for (int i = 0; i + 1 < n; ++i) {
        const int k = use.reversed ? n - 1 - i : i;
        if (!thin || thin_[use.line][k]) out.push_back(line.uv[k]);
      }
    }
    return out;
  }

  std::vector<Uv> grid_points(const Polygon& outer) const {
    UvBox box{{outer[0].u, outer[0].u}, {outer[0].v, outer[0].v}};
    for (Uv p : outer) {
      box.u = {std::min(box.u.lo, p.u), std::max(box.u.hi, p.u)};
      box.v = {std::min(box.v.lo, p.v), std::max(box.v.hi, p.v)};
    }
    const UvBox& all = outline_.box();
    const double du = all.u.length() / grid_u_, dv = all.v.length() / grid_v_;
    std::vector<Uv> points;
    for (double k = std::floor((box.v.lo - all.v.lo) / dv) + 1.0; all.v.lo + k * dv < box.v.hi; ++k) {
      // Every other row is moved by half a step, so that the triangles are even.
      const double start = std::fmod(k, 2.0) != 0.0 ? all.u.lo + 0.5 * du : all.u.lo;
      for (double i = std::floor((box.u.lo - start) / du) + 1.0; start + i * du < box.u.hi; ++i) {
        points.push_back({start + i * du, all.v.lo + k * dv});
      }
    }
    return points;
  }

  bool add_cell(const SheetCell& cell, bool thin) {
    std::vector<Polygon> loops;
    for (const auto& loop : cell.loops) loops.push_back(polygon(loop, thin));
    const std::vector<Uv> inner = grid_points(loops.front());
    const SurfaceJet j = surface_.jet(loops.front().front());
    const UvBox& box = outline_.box();
    double aspect = j.Sv.norm() * box.v.length() / (j.Su.norm() * box.u.length());
    constexpr double kThinnest = 1e-3;
    aspect = aspect > kThinnest && aspect < 1.0 / kThinnest ? aspect : 1.0;
    const PolygonTriangulation made = triangulate_polygon(loops, inner, aspect);
    if (!made.ok) return false;
    std::vector<Uv> all;
    for (const Polygon& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
    all.insert(all.end(), inner.begin(), inner.end());
    std::vector<int> number(all.size(), -1);
    const auto point = [&](int i) {
      if (number[i] < 0) number[i] = static_cast<int>(mesh_.points.size()), add_point(all[i]);
      return number[i];
    };
    for (int t = 0; t < made.triangles.triangle_count(); ++t) {
      if (!made.triangles.alive(t)) continue;
      auto [a, b, c] = made.triangles.corners(t);
      if (turn_ < 0.0) std::swap(b, c);
      mesh_.triangles.push_back({point(a), point(b), point(c)});
      mesh_.site_of.push_back(cell.site);
    }
    return true;
  }

  void add_point(Uv p) {
    SurfaceJet j = surface_.jet(p);
    const Xyz at = j.S;
    Xyz normal = j.Su.cross(j.Sv);
    // At a pole the normal is that of a place beside it.
    constexpr double kSmall = 1e-9, kBeside = 1e-3;
    if (!(normal.norm() > kSmall * (j.Su.squaredNorm() + j.Sv.squaredNorm()))) {
      const UvBox& box = outline_.box();
      j = surface_.jet(lerp(p, {box.u.middle(), box.v.middle()}, kBeside));
      normal = j.Su.cross(j.Sv);
    }
    mesh_.points.push_back(at);
    mesh_.normals.push_back(normal.norm() > 0.0 ? Xyz(turn_ * normal.normalized()) : Xyz(Xyz::UnitZ()));
  }

  const FaceOutline& outline_;
  const Surface& surface_;
  const CellSheet& sheet_;
  double turn_;
  double eye_ = 0.0;
  int grid_u_ = 1, grid_v_ = 1;
  std::vector<std::vector<char>> thin_;
  CellMesh mesh_;
};

}  // namespace

CellMesh mesh_of_cells(const CadModel& model, const CadFace& face, const VoronoiDiagram& diagram, double deflection) {
  const FaceOutline outline(model, face, deflection);
  const CellSheet sheet = sheet_of_cells(model, outline, diagram, deflection);
  return CellMesher(outline, sheet, face.reversed).run();
}

}  // namespace geovor
