#include "voronoi/face_border.h"

#include <algorithm>
#include <cmath>

#include "numeric/root.h"
#include "surface/forms.h"

namespace geovor {
namespace {

// How far to step off a segment, as a part of the box, to see whether the face goes on behind it; and at least so many
// deflections, by which the polylines of both sides of a seam may differ, but never further than the last part.
constexpr double kSideStep = 1e-6;
constexpr double kSideDeflections = 4.0;
constexpr double kLongestSideStep = 1e-4;

// A segment shorter than this in space, as a part of the face's size, is a piece of a pole.
constexpr double kPole = 1e-10;

// Of the rectangle around the face.
constexpr double kLongestSegment = 1.0 / 48.0;

// A chord may miss the end of a segment by rounding; this part of the segment's length is added at both ends.
constexpr double kEndSlack = 1e-12;

// Newton's method on one analytic arc that is nearly straight.
constexpr int kRefinements = 12;

// Of a segment's parameters: rounding.
constexpr double kSettled = 1e-15;

// Chords of a segment whose lengths are added up, and whose ends bound it in space.
constexpr int kParts = 8;

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Whether the face goes on to the right of the segment, where a border has nothing.
bool is_seam(const FaceDomain& domain, Uv a, Uv b) {
  const UvBox& box = domain.box();
  const UvVec along = {(b.u - a.u) / box.u.length(), (b.v - a.v) / box.v.length()};
  const double length = std::hypot(along.u, along.v);
  const UvVec right = {along.v / length * box.u.length(), -along.u / length * box.v.length()};
  const Uv middle = lerp(a, b, 0.5);
  const double deflections = kSideDeflections * domain.deflection() / norm(domain.surface().jet(middle), right);
  const double step = std::max(kSideStep, std::min(deflections, kLongestSideStep));
  return domain.contains(middle + step * right);
}

}  // namespace

// Loops are taken apart at every segment that is a seam or a pole; what is left are closed loops and open chains. Two
// open chains follow one another where the end of one is the start of the other in space.
FaceBorder::FaceBorder(const FaceDomain& domain) : domain_(domain) {
  const Surface& surface = domain.surface();
  const UvBox& box = domain.box();
  const double size =
      (surface.position({box.u.lo, box.v.lo}) - surface.position({box.u.middle(), box.v.middle()})).norm();
  std::vector<std::vector<BorderChord>> open_chains;
  for (const auto& loop : domain.chords()) {
    const int n = static_cast<int>(loop.size());
    const auto is_border = [&](int i) {
      const BorderChord& c = loop[i % n];
      const double half = (surface.position(c.a) - surface.position(lerp(c.a, c.b, 0.5))).norm();
      return half > kPole * size && !is_seam(domain, c.a, c.b);
    };
    int start = 0;
    while (start < n && is_border(start)) ++start;
    const bool whole = start == n;
    std::vector<BorderChord> chain;
    for (int i = whole ? 0 : start + 1; i < (whole ? n : start + 1 + n); ++i) {
      if (is_border(i)) {
        chain.push_back(loop[i % n]);
      } else if (!chain.empty()) {
        open_chains.push_back(std::move(chain));
        chain.clear();
      }
    }
    if (whole) cycles_.push_back(chain);
  }
  link(open_chains);
  split_long_segments();
  build_trees();
}

void FaceBorder::link(const std::vector<std::vector<BorderChord>>& open_chains) {
  const Surface& surface = domain_.surface();
  std::vector<char> used(open_chains.size(), 0);
  for (size_t first = 0; first < open_chains.size(); ++first) {
    if (used[first]) continue;
    std::vector<BorderChord> cycle;
    size_t chain = first;
    while (!used[chain]) {
      used[chain] = 1;
      cycle.insert(cycle.end(), open_chains[chain].begin(), open_chains[chain].end());
      const Xyz end = surface.position(cycle.back().b);
      double nearest = kInf;
      size_t next = first;
      for (size_t i = 0; i < open_chains.size(); ++i) {
        const double gap = (surface.position(open_chains[i].front().a) - end).norm();
        if (gap < nearest && (i == first || !used[i])) nearest = gap, next = i;
      }
      chain = next;
    }
    cycles_.push_back(std::move(cycle));
  }
}

void FaceBorder::split_long_segments() {
  const UvBox& box = domain_.box();
  for (auto& cycle : cycles_) {
    std::vector<BorderChord> fine;
    for (const BorderChord& s : cycle) {
      const UvVec way = s.b - s.a;
      const double size = std::max(std::abs(way.u) / box.u.length(), std::abs(way.v) / box.v.length());
      const int parts = std::max(1, static_cast<int>(std::ceil(size / kLongestSegment)));
      for (int k = 0; k < parts; ++k) {
        fine.push_back(s.part(static_cast<double>(k) / parts, static_cast<double>(k + 1) / parts));
      }
    }
    cycle = std::move(fine);
  }
}

void FaceBorder::build_trees() {
  std::vector<ChordBox> boxes;
  std::vector<SpaceBox> space_boxes;
  for (int c = 0; c < cycle_count(); ++c) {
    for (int k = 0; k < segment_count(c); ++k) {
      order_.push_back({c, k});
      boxes.push_back(ChordBox::around(cycles_[c][k].a, cycles_[c][k].b));
      space_boxes.push_back(space_box(cycles_[c][k]));
    }
  }
  tree_ = NestedBoxes<ChordBox>(boxes);
  space_tree_ = NestedBoxes<SpaceBox>(space_boxes);
  const double pu = domain_.surface().u_period().value_or(0.0), pv = domain_.surface().v_period().value_or(0.0);
  for (double u : {0.0, -pu, pu}) {
    for (double v : {0.0, -pv, pv}) {
      const auto same = [&](UvVec s) { return s.u == u && s.v == v; };
      if (std::none_of(shifts_.begin(), shifts_.end(), same)) shifts_.push_back({u, v});
    }
  }
}

void FaceBorder::SpaceBox::include(const SpaceBox& other) {
  lower = lower.cwiseMin(other.lower);
  upper = upper.cwiseMax(other.upper);
}

double FaceBorder::SpaceBox::least_distance(const Xyz& x) const {
  return (lower - x).cwiseMax(x - upper).cwiseMax(0.0).norm();
}

// Between two of the points that the box is made of the segment sags by a 64th (kParts squared) of what it sags as a
// whole, as long as its curvature varies little; the box is wider by four times that.
FaceBorder::SpaceBox FaceBorder::space_box(const BorderChord& s) const {
  const Xyz a = xyz_of(s.a), b = xyz_of(s.b);
  SpaceBox box{a.cwiseMin(b), a.cwiseMax(b)};
  double sag = 0.0;
  for (int i = 1; i < kParts; ++i) {
    const double f = static_cast<double>(i) / kParts;
    const Xyz x = xyz_of(s.at(f));
    box.include({x, x});
    sag = std::max(sag, (x - ((1.0 - f) * a + f * b)).norm());
  }
  const Xyz margin = Xyz::Constant(4.0 * sag / (kParts * kParts));
  box.lower -= margin, box.upper += margin;
  return box;
}

Uv FaceBorder::uv(BorderPlace place) const {
  const int n = segment_count(place.cycle);
  const double whole = std::floor(place.parameter);
  return cycles_[place.cycle][static_cast<int>(whole) % n].at(place.parameter - whole);
}

double FaceBorder::segment_length(int cycle, int k) const {
  const BorderChord& s = cycles_[cycle][k];
  double length = 0.0;
  Xyz last = xyz_of(s.a);
  for (int i = 1; i <= kParts; ++i) {
    const Xyz next = xyz_of(s.at(static_cast<double>(i) / kParts));
    length += (next - last).norm();
    last = next;
  }
  return length;
}

UvVec FaceBorder::direction(BorderPlace place) const {
  const double whole = std::floor(place.parameter);
  const BorderChord& s = cycles_[place.cycle][static_cast<int>(whole) % segment_count(place.cycle)];
  return s.direction(place.parameter - whole);
}

// Newton's method for where the line of the chord meets the true arc; where it does not settle (the chord grazes the
// arc) the place on the polyline stands, which is as near as the domain's deflection.
std::optional<FaceBorder::Crossing> FaceBorder::refined(SegmentId id, Uv a, Uv b, double across, double along,
                                                        double from) const {
  const BorderChord& s = cycles_[id.cycle][id.k];
  double f = std::clamp(across, 0.0, 1.0);
  if (s.curve) {
    const UvVec way = b - a;
    for (int i = 0; i < kRefinements; ++i) {
      const double step = -cross(way, s.at(f) - a) / cross(way, s.direction(f));
      if (!std::isfinite(step)) break;
      const double next = std::clamp(f + step, 0.0, 1.0);
      const bool settled = std::abs(next - f) <= kSettled;
      f = next;
      if (settled) break;
    }
    const UvVec there = s.at(f) - a;
    const double pu = domain_.box().u.length(), pv = domain_.box().v.length();
    const UvVec scaled = {way.u / (pu * pu), way.v / (pv * pv)};
    along = (there.u * scaled.u + there.v * scaled.v) / (way.u * scaled.u + way.v * scaled.v);
    if (from == 0.0) along = std::clamp(along, 0.0, 1.0);
  }
  if (!(along >= from)) return std::nullopt;
  return Crossing{{id.cycle, id.k + f}, std::min(along, 1.0)};
}

std::optional<FaceBorder::Crossing> FaceBorder::first_crossing(Uv a0, Uv b0, double from) const {
  std::optional<Crossing> best;
  for (UvVec shift : shifts_) {
    const Uv a = a0 + shift, b = b0 + shift;
    const auto enter = [&](const ChordBox& box) { return box.may_meet(a, b); };
    tree_.walk(enter, [&](int i) {
      const BorderChord& s = cycles_[order_[i].cycle][order_[i].k];
      const double det = cross(b - a, s.b - s.a);
      const double along = cross(s.a - a, s.b - s.a) / det, across = cross(s.a - a, b - a) / det;
      if (!(along >= 0.0 && along <= 1.0 && across >= -kEndSlack && across <= 1.0 + kEndSlack)) return;
      const auto crossing = refined(order_[i], a, b, across, along, from);
      if (crossing && (!best || crossing->fraction < best->fraction)) best = crossing;
    });
  }
  return best;
}

std::optional<BorderPlace> FaceBorder::nearest(Uv p0) const {
  const FirstForm I = first_form(domain_.surface().jet(p0));
  std::optional<BorderPlace> best;
  Uv seen_from = p0;
  double least2 = kInf;
  const auto towards = [&](UvVec d, UvVec way) { return dot(I, way, d) / dot(I, d, d); };
  for (UvVec shift : shifts_) {
    const Uv p = p0 + shift;
    const auto enter = [&](const ChordBox& box) { return !(box.least_distance2(I, p) >= least2); };
    tree_.walk(enter, [&](int i) {
      const BorderChord& s = cycles_[order_[i].cycle][order_[i].k];
      const double f = std::clamp(towards(s.b - s.a, p - s.a), 0.0, 1.0);
      const UvVec off = p - lerp(s.a, s.b, f);
      const double off2 = dot(I, off, off);
      if (off2 < least2) least2 = off2, best = {order_[i].cycle, order_[i].k + f}, seen_from = p;
    });
  }
  if (best) refine_nearest(seen_from, I, *best);
  return best;
}

// The foot of p on the true border: on the chord's own arc, or on a neighbour of it, as far as the polyline errs.
void FaceBorder::refine_nearest(Uv p, const FirstForm& I, BorderPlace& place) const {
  const int n = segment_count(place.cycle);
  int k = std::min(static_cast<int>(place.parameter), n - 1);
  for (int moves = 0; moves < kRefinements; ++moves) {
    const BorderChord& s = cycles_[place.cycle][k];
    const auto ahead = [&](double f) { return dot(I, p - s.at(f), s.direction(f)); };
    const int next = (k + 1) % n, before = (k + n - 1) % n;
    if (ahead(0.0) < 0.0) {
      place.parameter = k;
      if (!(cycles_[place.cycle][before].b == s.a)) return;
      k = before;
    } else if (ahead(1.0) > 0.0) {
      place.parameter = next;
      if (!(cycles_[place.cycle][next].a == s.b)) return;
      k = next;
    } else {
      place.parameter = k + root_between(ahead, 0.0, 1.0, kSettled);
      return;
    }
  }
}

bool FaceBorder::near_border(const Xyz& x, double distance) const {
  bool near = false;
  space_tree_.walk([&](const SpaceBox& box) { return !near && !(box.least_distance(x) > distance); },
                   [&](int) { near = true; });
  return near;
}

std::vector<Uv> FaceBorder::stretch(BorderPlace from, BorderPlace to) const {
  const int n = segment_count(from.cycle);
  std::vector<Uv> line = {uv(from)};
  const double end = to.parameter > from.parameter ? to.parameter : to.parameter + n;
  for (double k = std::floor(from.parameter) + 1.0; k <= end; k += 1.0) {
    const BorderChord& before = cycles_[from.cycle][(static_cast<int>(k) - 1) % n];
    const BorderChord& after = cycles_[from.cycle][static_cast<int>(k) % n];
    if (!(line.back() == before.b)) line.push_back(before.b);
    if (k < end && !(after.a == before.b)) line.push_back(after.a);  // the other side of a seam
  }
  if (end > std::floor(end)) line.push_back(uv(to));
  return line;
}

}  // namespace geovor
