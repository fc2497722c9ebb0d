#include "voronoi/lattice.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "surface/forms.h"

namespace geovor {
namespace {

// Cells of the grid on which lengths and curvatures are looked at before the lines are placed.
constexpr int kProbe = 48;

// Lines of one direction: at least this many (a label must be able to change), at most this many (a time limit: the
// diagram stays right on a coarser lattice, its candidate lists only get longer).
constexpr int kFewestLines = 6;
constexpr int kMostLines = 400;

// An edge of the lattice turns the surface by no more than about this (radians), so that a neighbour's geodesic is a
// good start for one's own.
constexpr double kTurn = 0.35;

// A side shorter than this part of the longest line is a pole.
constexpr double kPole = 1e-9;

// A rectangle that misses the period by no more than this closes.
constexpr double kFullPeriod = 1e-9;

// A node nearer than this to a point to be avoided, as a part of the node's reach, moves by kAside of a cell.
constexpr double kTooNear = 1e-2;
constexpr double kAside = 0.1;

bool closes(const std::optional<double>& period, const Interval& range) {
  return period && range.length() >= *period * (1.0 - kFullPeriod);
}

/// What one direction asks for in each of kProbe intervals.
struct AxisProbe {
  std::array<double, kProbe> lines{};                       ///< how many lines the interval is to hold
  double first_side = 0.0, last_side = 0.0, longest = 0.0;  ///< lengths across, on the two sides and at most
};

double edge_demand(const SurfaceJet& a, const SurfaceJet& b, double spacing) {
  const double length = (b.S - a.S).norm();
  const double turn = std::acos(std::clamp(unit_normal(a).dot(unit_normal(b)), -1.0, 1.0));
  return std::max(length / spacing, std::isfinite(turn) ? turn / kTurn : 0.0);
}

std::vector<double> spread_lines(const AxisProbe& probe, const Interval& range, bool closed) {
  double total = 0.0;
  for (double n : probe.lines) total += n;
  const int cells = std::clamp(static_cast<int>(std::ceil(total)), kFewestLines, kMostLines);
  const bool pole_first = !closed && probe.first_side < kPole * probe.longest;
  const bool pole_last = !closed && probe.last_side < kPole * probe.longest;
  std::vector<double> lines;
  int interval = 0;
  double before = 0.0;
  for (int i = 0; i <= cells - (closed ? 1 : 0); ++i) {
    double place = i;
    if (i == 0 && pole_first) place = 0.5;
    if (i == cells && pole_last) place = cells - 0.5;
    const double wanted = total * place / cells;
    while (interval + 1 < kProbe && before + probe.lines[interval] < wanted) before += probe.lines[interval++];
    const double within = probe.lines[interval] > 0.0 ? (wanted - before) / probe.lines[interval] : 0.0;
    lines.push_back(range.lo + range.length() * (interval + std::clamp(within, 0.0, 1.0)) / kProbe);
  }
  return lines;
}

}  // namespace

std::array<int, 2> FaceLattice::Axis::around(double x) const {
  if (period > 0.0) {
    x -= period * std::floor((x - lines.front()) / period);
  }
  const int after = static_cast<int>(std::upper_bound(lines.begin(), lines.end(), x) - lines.begin());
  if (period > 0.0) return {after - 1, after % count()};
  const int right = std::clamp(after, 1, count() - 1);
  return {right - 1, right};
}

FaceLattice::FaceLattice(const FaceDomain& domain, double spacing, const std::vector<Uv>& avoid) {
  place_lines(domain, spacing);
  fill_nodes(domain);
  step_aside(domain, avoid);
}

void FaceLattice::place_lines(const FaceDomain& domain, double spacing) {
  const Surface& surface = domain.surface();
  const UvBox& box = domain.box();
  std::vector<SurfaceJet> jets((kProbe + 1) * (kProbe + 1));
  const auto jet = [&](int i, int j) -> SurfaceJet& { return jets[j * (kProbe + 1) + i]; };
  for (int j = 0; j <= kProbe; ++j) {
    for (int i = 0; i <= kProbe; ++i) {
      jet(i, j) = surface.jet({box.u.lo + box.u.length() * i / kProbe, box.v.lo + box.v.length() * j / kProbe});
    }
  }
  AxisProbe u, v;
  for (int k = 0; k <= kProbe; ++k) {
    double along_u = 0.0, along_v = 0.0;
    for (int i = 0; i < kProbe; ++i) {
      u.lines[i] = std::max(u.lines[i], edge_demand(jet(i, k), jet(i + 1, k), spacing));
      v.lines[i] = std::max(v.lines[i], edge_demand(jet(k, i), jet(k, i + 1), spacing));
      along_u += (jet(i + 1, k).S - jet(i, k).S).norm();
      along_v += (jet(k, i + 1).S - jet(k, i).S).norm();
    }
    if (k == 0) v.first_side = along_u, u.first_side = along_v;
    if (k == kProbe) v.last_side = along_u, u.last_side = along_v;
    v.longest = std::max(v.longest, along_u), u.longest = std::max(u.longest, along_v);
  }
  const bool closed_u = closes(surface.u_period(), box.u), closed_v = closes(surface.v_period(), box.v);
  u_ = {spread_lines(u, box.u, closed_u), closed_u ? *surface.u_period() : 0.0};
  v_ = {spread_lines(v, box.v, closed_v), closed_v ? *surface.v_period() : 0.0};
}

void FaceLattice::fill_nodes(const FaceDomain& domain) {
  for (double v : v_.lines) {
    for (double u : u_.lines) {
      uv_.push_back({u, v});
      xyz_.push_back(domain.surface().position({u, v}));
      inside_.push_back(domain.contains({u, v}));
    }
  }
  for (int n = 0; n < count(); ++n) {
    double reach = 0.0;
    for (const Neighbour& z : neighbours(n)) reach = std::max(reach, (xyz_[z.node] - xyz_[n]).norm());
    reach_.push_back(reach);
  }
}

void FaceLattice::step_aside(const FaceDomain& domain, const std::vector<Uv>& avoid) {
  const Surface& surface = domain.surface();
  for (Uv p : avoid) {
    const Xyz x = surface.position(p);
    for (int n : corners(p)) {
      if ((xyz_[n] - x).norm() > kTooNear * reach_[n]) continue;
      const int i = n % u_.count(), j = n / u_.count();
      const int beside_u = i + 1 < u_.count() ? i + 1 : i - 1, beside_v = j + 1 < v_.count() ? j + 1 : j - 1;
      uv_[n] = {u_.lines[i] + kAside * (u_.lines[beside_u] - u_.lines[i]),
                v_.lines[j] + kAside * (v_.lines[beside_v] - v_.lines[j])};
      xyz_[n] = surface.position(uv_[n]);
      inside_[n] = domain.contains(uv_[n]);
    }
  }
}

std::vector<FaceLattice::Neighbour> FaceLattice::neighbours(int node) const {
  const auto beside = [](const Axis& axis, int i, int step) {
    const int n = axis.count();
    struct Line {
      int index;
      double shift;
    };
    if (i + step >= 0 && i + step < n) return Line{i + step, 0.0};
    if (axis.period == 0.0) return Line{-1, 0.0};
    return Line{(i + step + n) % n, step * axis.period};
  };
  std::vector<Neighbour> out;
  const int i = node % u_.count(), j = node / u_.count();
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      const auto a = beside(u_, i, di), b = beside(v_, j, dj);
      if ((di != 0 || dj != 0) && a.index >= 0 && b.index >= 0) {
        const int other = index(a.index, b.index);
        out.push_back({other, uv_[other] + UvVec{a.shift, b.shift}});
      }
    }
  }
  return out;
}

std::array<int, 4> FaceLattice::corners(Uv p) const {
  const auto i = u_.around(p.u), j = v_.around(p.v);
  return {index(i[0], j[0]), index(i[1], j[0]), index(i[0], j[1]), index(i[1], j[1])};
}

double rough_area(const FaceDomain& domain) {
  const UvBox& box = domain.box();
  double sum = 0.0;
  for (int j = 0; j < kProbe; ++j) {
    for (int i = 0; i < kProbe; ++i) {
      const Uv p = {box.u.lo + box.u.length() * (i + 0.5) / kProbe, box.v.lo + box.v.length() * (j + 0.5) / kProbe};
      if (!domain.contains(p)) continue;
      const SurfaceJet jet = domain.surface().jet(p);
      sum += jet.Su.cross(jet.Sv).norm();
    }
  }
  return sum * box.u.length() * box.v.length() / (kProbe * kProbe);
}

}  // namespace geovor
