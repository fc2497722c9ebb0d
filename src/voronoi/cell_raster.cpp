#include "voronoi/cell_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geodesic/connect.h"
#include "voronoi/face_border.h"

namespace geovor {
namespace {

/// A row meets an edge at u, coming from the cell of `before`.
struct RowCrossing {
  double u;
  int before, after;
};

double wrapped(double x, const Interval& range, const std::optional<double>& period) {
  return period ? x - *period * std::floor((x - range.lo) / *period) : x;
}

class RowScan {
 public:
  RowScan(const FaceDomain& domain, const VoronoiDiagram& diagram, int rows)
      : domain_(domain), diagram_(diagram), box_(domain.box()), rows_(rows), crossings_(rows) {
    for (const DiagramEdge& e : diagram.edges) {
      for (size_t i = 0; i + 1 < e.points.size(); ++i) add_chord(e, e.points[i].uv, e.points[i + 1].uv);
    }
    for (auto& row : crossings_) {
      std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.u < b.u; });
    }
  }

  double v(double row) const { return box_.v.lo + box_.v.length() * row / rows_; }
  const std::vector<RowCrossing>& crossings(int row) const { return crossings_[row]; }

  int owner(int row, double u) const {
    const auto& list = crossings_[row];
    const auto next = std::find_if(list.begin(), list.end(), [u](const RowCrossing& c) { return c.u > u; });
    if (next != list.end()) return next->before;
    if (!list.empty()) return list.back().after;
    return nearest_site({u, v(row + 0.5)});
  }

 private:
  void add_chord(const DiagramEdge& e, Uv a, Uv b) {
    const auto pu = domain_.surface().u_period(), pv = domain_.surface().v_period();
    if (pu) b.u -= *pu * std::round((b.u - a.u) / *pu);
    if (pv) b.v -= *pv * std::round((b.v - a.v) / *pv);
    const double first = (std::min(a.v, b.v) - box_.v.lo) / box_.v.length() * rows_ - 0.5;
    const double last = (std::max(a.v, b.v) - box_.v.lo) / box_.v.length() * rows_ - 0.5;
    for (int row = static_cast<int>(std::ceil(first)); row < last; ++row) {
      const double u = a.u + (b.u - a.u) * (v(row + 0.5) - a.v) / (b.v - a.v);
      const int before = b.v > a.v ? e.left : e.right, after = b.v > a.v ? e.right : e.left;
      const int wrapped_row = pv ? (row % rows_ + rows_) % rows_ : row;
      if (wrapped_row < 0 || wrapped_row >= rows_) continue;
      crossings_[wrapped_row].push_back({wrapped(u, box_.u, pu), before, after});
    }
  }

  // A row that meets no edge lies in one cell: that of the nearest site. A site farther off in space than the best way
  // found so far can't be it.
  int nearest_site(Uv p) const {
    const Xyz x = domain_.surface().position(p);
    double least = std::numeric_limits<double>::infinity();
    int nearest = diagram_.sites.empty() ? -1 : 0;
    for (int i = 0; i < static_cast<int>(diagram_.sites.size()); ++i) {
      if ((diagram_.sites[i].xyz - x).norm() >= least) continue;
      const Connection c = connect(domain_.surface(), diagram_.sites[i].uv, p);
      if (c.status == ConnectStatus::Converged && c.length < least) least = c.length, nearest = i;
    }
    return nearest;
  }

  const FaceDomain& domain_;
  const VoronoiDiagram& diagram_;
  UvBox box_;
  int rows_;
  std::vector<std::vector<RowCrossing>> crossings_;
};

void add_patches(const RowScan& scan, const FaceDomain& domain, int row, int columns, std::vector<CellPatch>& out) {
  const UvBox& box = domain.box();
  const double v0 = scan.v(row), v1 = scan.v(row + 1.0);
  for (const Interval& inside : domain.inside_at(0.5 * (v0 + v1))) {
    std::vector<double> cuts = {inside.lo, inside.hi};
    for (const RowCrossing& c : scan.crossings(row)) {
      if (inside.contains(c.u)) cuts.push_back(c.u);
    }
    for (int k = 1; k < columns; ++k) {
      const double u = box.u.lo + box.u.length() * k / columns;
      if (inside.contains(u)) cuts.push_back(u);
    }
    std::sort(cuts.begin(), cuts.end());
    for (size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (!(cuts[i + 1] > cuts[i])) continue;
      CellPatch patch;
      patch.uv = {Uv{cuts[i], v0}, Uv{cuts[i + 1], v0}, Uv{cuts[i + 1], v1}, Uv{cuts[i], v1}};
      for (int k = 0; k < 4; ++k) patch.xyz[k] = domain.surface().position(patch.uv[k]);
      patch.site = scan.owner(row, 0.5 * (cuts[i] + cuts[i + 1]));
      out.push_back(patch);
    }
  }
}

}  // namespace

CellRaster raster_of_cells(const FaceDomain& domain, const VoronoiDiagram& diagram, int rows, int columns) {
  CellRaster raster;
  raster.box = domain.box();
  const RowScan scan(domain, diagram, rows);
  for (int row = 0; row < rows; ++row) add_patches(scan, domain, row, columns, raster.patches);
  const FaceBorder border(domain);
  for (int cycle = 0; cycle < border.cycle_count(); ++cycle) {
    raster.border_uv.push_back(border.stretch({cycle, 0.0}, {cycle, 0.0}));
    raster.border.emplace_back();
    for (Uv p : raster.border_uv.back()) raster.border.back().push_back(border.xyz_of(p));
  }
  return raster;
}

}  // namespace geovor
