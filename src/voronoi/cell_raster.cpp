#include "voronoi/cell_raster.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geodesic/connect.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/face_border.h"

namespace geovor {
namespace {

/// The middle of a row meets an edge at u, coming from the cell of `before`.
struct RowCrossing {
  double u;
  double slope;  ///< du/dv of the edge
  int before, after;
};

/// Where a row runs in the face.
struct RowSpan {
  Interval inside;
  std::vector<RowCrossing> crossings;
  int owner;  ///< where it meets no edge

  int owner_at(double u) const {
    if (crossings.empty()) return owner;
    const auto next = std::find_if(crossings.begin(), crossings.end(), [u](const RowCrossing& c) { return c.u > u; });
    return next != crossings.end() ? next->before : crossings.back().after;
  }
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
    for (int row = 0; row < rows; ++row) {
      auto& list = crossings_[row];
      std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.u < b.u; });
      spans_.emplace_back();
      for (const Interval& inside : domain.inside_at(v(row + 0.5))) spans_.back().push_back(span(row, inside));
    }
  }

  double v(double row) const { return box_.v.lo + box_.v.length() * row / rows_; }
  const std::vector<RowSpan>& spans(int row) const { return spans_[row]; }

 private:
  RowSpan span(int row, const Interval& inside) const {
    RowSpan span{inside, {}, -1};
    for (const RowCrossing& c : crossings_[row]) {
      if (inside.contains(c.u)) span.crossings.push_back(c);
    }
    if (span.crossings.empty()) span.owner = nearest_site({inside.middle(), v(row + 0.5)});
    return span;
  }

  void add_chord(const DiagramEdge& e, Uv a, Uv b) {
    const auto pu = domain_.surface().u_period(), pv = domain_.surface().v_period();
    if (pu) b.u -= *pu * std::round((b.u - a.u) / *pu);
    if (pv) b.v -= *pv * std::round((b.v - a.v) / *pv);
    const double first = (std::min(a.v, b.v) - box_.v.lo) / box_.v.length() * rows_ - 0.5;
    const double last = (std::max(a.v, b.v) - box_.v.lo) / box_.v.length() * rows_ - 0.5;
    for (int row = static_cast<int>(std::ceil(first)); row < last; ++row) {
      const double slope = (b.u - a.u) / (b.v - a.v), u = a.u + slope * (v(row + 0.5) - a.v);
      const int before = b.v > a.v ? e.left : e.right, after = b.v > a.v ? e.right : e.left;
      const int wrapped_row = pv ? (row % rows_ + rows_) % rows_ : row;
      if (wrapped_row < 0 || wrapped_row >= rows_) continue;
      crossings_[wrapped_row].push_back({wrapped(u, box_.u, pu), slope, before, after});
    }
  }

  // A span that meets no edge lies in one cell: that of the nearest site. A site farther off in space than the best
  // way found so far can't be it.
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
  std::vector<std::vector<RowSpan>> spans_;
};

/// Rows [row, row_end) and columns [column, column_end) of the raster.
struct Block {
  int row, row_end, column, column_end;
  int rows() const { return row_end - row; }
  int columns() const { return column_end - column; }
};

// A patch is flat enough for the eye where its middle lies this near to where its corners have it, as a part of the
// face's size (half a unit of a usual page), and its halves differ by this angle (radians) at most: a step in shade
// that is hardly seen.
constexpr double kFlat = 5e-4;
constexpr double kShadeTurn = 0.1;

// Patches are no larger than this part of the face: nine points of one would miss a narrow dent.
constexpr int kCoarsest = 8;

/// Blocks as large as the cells and the bend of the face allow, down to a row and a column.
class Patchwork {
 public:
  Patchwork(const FaceDomain& domain, const RowScan& scan, int rows, int columns)
      : domain_(domain), scan_(scan), rows_(rows), columns_(columns), size_(face_size(domain)) {}

  std::vector<CellPatch> patches() {
    add({0, rows_, 0, columns_});
    return std::move(patches_);
  }

 private:
  /// How far a block bends along rows and along columns: 1 is what a patch may.
  struct Bend {
    double along_u, along_v;
  };

  double u(int column) const {
    const Interval& range = domain_.box().u;
    return column == columns_ ? range.hi : range.lo + range.length() * column / columns_;
  }

  /// The owner of the block where it lies in one cell and in the face.
  std::optional<int> only_owner(const Block& b) const {
    const double first = u(b.column), last = u(b.column_end), middle = 0.5 * (first + last);
    std::optional<int> owner;
    for (int row = b.row; row < b.row_end; ++row) {
      const auto& spans = scan_.spans(row);
      const auto span = std::find_if(spans.begin(), spans.end(),
                                     [&](const RowSpan& s) { return s.inside.lo <= first && last <= s.inside.hi; });
      if (span == spans.end()) return std::nullopt;
      const auto cuts = [&](const RowCrossing& c) { return first < c.u && c.u < last; };
      if (std::any_of(span->crossings.begin(), span->crossings.end(), cuts)) return std::nullopt;
      if (owner.value_or(span->owner_at(middle)) != span->owner_at(middle)) return std::nullopt;
      owner = span->owner_at(middle);
    }
    return owner;
  }

  Bend bend(const Block& b) const {
    const double us[] = {u(b.column), 0.5 * (u(b.column) + u(b.column_end)), u(b.column_end)};
    const double vs[] = {scan_.v(b.row), scan_.v(0.5 * (b.row + b.row_end)), scan_.v(b.row_end)};
    std::array<std::array<Xyz, 3>, 3> x;  // [v][u]
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) x[j][i] = domain_.surface().position({us[i], vs[j]});
    }
    const auto normal = [](const Xyz& p, const Xyz& q, const Xyz& r, const Xyz& s) {
      const Xyz n = (r - p).cross(s - q);
      return n.isZero(0.0) ? n : Xyz(n.stableNormalized());
    };
    const auto turn = [](const Xyz& m, const Xyz& n) { return (m - n).norm() / kShadeTurn; };
    Bend bend{turn(normal(x[0][0], x[0][1], x[2][1], x[2][0]), normal(x[0][1], x[0][2], x[2][2], x[2][1])),
              turn(normal(x[0][0], x[0][2], x[1][2], x[1][0]), normal(x[1][0], x[1][2], x[2][2], x[2][0]))};
    for (int k = 0; k < 3; ++k) {
      bend.along_u = std::max(bend.along_u, (x[k][0] - 2.0 * x[k][1] + x[k][2]).norm() / (2.0 * kFlat * size_));
      bend.along_v = std::max(bend.along_v, (x[0][k] - 2.0 * x[1][k] + x[2][k]).norm() / (2.0 * kFlat * size_));
    }
    return bend;
  }

  void add(const Block& b) {
    const bool least = b.rows() == 1 && b.columns() == 1;
    const auto owner = only_owner(b);
    if (!owner && least) return add_pieces(b);
    const bool large = kCoarsest * b.rows() > rows_ || kCoarsest * b.columns() > columns_;
    if (!owner || large) return split(b, b.columns() * rows_ > b.rows() * columns_);
    const Bend bent = bend(b);
    if (least || (bent.along_u <= 1.0 && bent.along_v <= 1.0)) {
      const double first = u(b.column), last = u(b.column_end);
      return emit(b, {first, last, last, first}, *owner);
    }
    split(b, bent.along_u > bent.along_v);
  }

  void split(const Block& b, bool columns) {
    if ((columns && b.columns() > 1) || b.rows() == 1) {
      const int middle = (b.column + b.column_end) / 2;
      add({b.row, b.row_end, b.column, middle});
      add({b.row, b.row_end, middle, b.column_end});
    } else {
      const int middle = (b.row + b.row_end) / 2;
      add({b.row, middle, b.column, b.column_end});
      add({middle, b.row_end, b.column, b.column_end});
    }
  }

  /// One row of one column, cut along the edges and where it meets the border.
  void add_pieces(const Block& b) {
    for (const RowSpan& span : scan_.spans(b.row)) {
      const Interval piece{std::max(span.inside.lo, u(b.column)), std::min(span.inside.hi, u(b.column_end))};
      if (!(piece.lo < piece.hi)) continue;
      const double half = 0.5 * (scan_.v(b.row_end) - scan_.v(b.row));
      double low = piece.lo, middle = piece.lo, high = piece.lo;  // the last cut below, half way and above
      for (const RowCrossing& c : span.crossings) {
        if (!(piece.lo < c.u && c.u < piece.hi)) continue;
        const double next_low = std::clamp(c.u - half * c.slope, low, piece.hi);
        const double next_high = std::clamp(c.u + half * c.slope, high, piece.hi);
        emit(b, {low, next_low, next_high, high}, span.owner_at(0.5 * (middle + c.u)));
        low = next_low, middle = c.u, high = next_high;
      }
      emit(b, {low, piece.hi, piece.hi, high}, span.owner_at(0.5 * (middle + piece.hi)));
    }
  }

  /// `us`: of the corners, from the lower left one on.
  void emit(const Block& b, const std::array<double, 4>& us, int site) {
    const double v0 = scan_.v(b.row), v1 = scan_.v(b.row_end);
    CellPatch patch;
    patch.uv = {Uv{us[0], v0}, Uv{us[1], v0}, Uv{us[2], v1}, Uv{us[3], v1}};
    for (int k = 0; k < 4; ++k) patch.xyz[k] = domain_.surface().position(patch.uv[k]);
    patch.site = site;
    patches_.push_back(patch);
  }

  const FaceDomain& domain_;
  const RowScan& scan_;
  int rows_, columns_;
  double size_;
  std::vector<CellPatch> patches_;
};

}  // namespace

CellRaster raster_of_cells(const FaceDomain& domain, const VoronoiDiagram& diagram, int rows, int columns) {
  CellRaster raster;
  raster.box = domain.box();
  const RowScan scan(domain, diagram, rows);
  raster.patches = Patchwork(domain, scan, rows, columns).patches();
  const FaceBorder border(domain);
  for (int cycle = 0; cycle < border.cycle_count(); ++cycle) {
    raster.border_uv.push_back(border.stretch({cycle, 0.0}, {cycle, 0.0}));
    raster.border.emplace_back();
    for (Uv p : raster.border_uv.back()) raster.border.back().push_back(border.xyz_of(p));
  }
  return raster;
}

}  // namespace geovor
