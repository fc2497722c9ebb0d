#include "voronoi/face_border.h"

#include <algorithm>
#include <cmath>

#include "surface/forms.h"

namespace geovor {
namespace {

// How far to step off a segment, as a part of the box, to see whether the face goes on behind it.
constexpr double kSideStep = 1e-6;

// A segment shorter than this in space, as a part of the face's size, is a piece of a pole.
constexpr double kPole = 1e-10;

// Of the rectangle around the face.
constexpr double kLongestSegment = 1.0 / 48.0;

// Segments of a run that shares one bounding box.
constexpr int kBlock = 16;

// A chord may miss the end of a segment by rounding; this part of the segment's length is added at both ends.
constexpr double kEndSlack = 1e-12;

constexpr double kInf = std::numeric_limits<double>::infinity();

UvBox box_of(Uv a, Uv b) {
  return {{std::min(a.u, b.u), std::max(a.u, b.u)}, {std::min(a.v, b.v), std::max(a.v, b.v)}};
}

UvBox join(const UvBox& a, const UvBox& b) {
  return {{std::min(a.u.lo, b.u.lo), std::max(a.u.hi, b.u.hi)}, {std::min(a.v.lo, b.v.lo), std::max(a.v.hi, b.v.hi)}};
}

bool overlap(const UvBox& a, const UvBox& b) {
  return a.u.lo <= b.u.hi && b.u.lo <= a.u.hi && a.v.lo <= b.v.hi && b.v.lo <= a.v.hi;
}

/// Whether the face goes on to the right of the segment, where a border has nothing.
bool is_seam(const FaceDomain& domain, Uv a, Uv b) {
  const UvBox& box = domain.box();
  const UvVec along = {(b.u - a.u) / box.u.length(), (b.v - a.v) / box.v.length()};
  const double length = std::hypot(along.u, along.v);
  const UvVec right = {along.v / length * kSideStep * box.u.length(), -along.u / length * kSideStep * box.v.length()};
  return domain.contains(lerp(a, b, 0.5) + right);
}

}  // namespace

// Loops are taken apart at every segment that is a seam or a pole; what is left are closed loops and open chains. Two
// open chains follow one another where the end of one is the start of the other in space.
FaceBorder::FaceBorder(const FaceDomain& domain) : domain_(domain) {
  const Surface& surface = domain.surface();
  const UvBox& box = domain.box();
  const double size =
      (surface.position({box.u.lo, box.v.lo}) - surface.position({box.u.middle(), box.v.middle()})).norm();
  std::vector<std::vector<Segment>> open_chains;
  for (const auto& loop : domain.loops()) {
    const int n = static_cast<int>(loop.size());
    const auto is_border = [&](int i) {
      const Uv a = loop[i % n], b = loop[(i + 1) % n];
      return (surface.position(a) - surface.position(lerp(a, b, 0.5))).norm() > kPole * size && !is_seam(domain, a, b);
    };
    int start = 0;
    while (start < n && is_border(start)) ++start;
    const bool whole = start == n;
    std::vector<Segment> chain;
    for (int i = whole ? 0 : start + 1; i < (whole ? n : start + 1 + n); ++i) {
      if (is_border(i)) {
        chain.push_back({loop[i % n], loop[(i + 1) % n]});
      } else if (!chain.empty()) {
        open_chains.push_back(std::move(chain));
        chain.clear();
      }
    }
    if (whole) cycles_.push_back(chain);
  }
  link(open_chains);
  split_long_segments();
  build_blocks();
}

void FaceBorder::link(const std::vector<std::vector<Segment>>& open_chains) {
  const Surface& surface = domain_.surface();
  std::vector<char> used(open_chains.size(), 0);
  for (size_t first = 0; first < open_chains.size(); ++first) {
    if (used[first]) continue;
    std::vector<Segment> cycle;
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
    std::vector<Segment> fine;
    for (const Segment& s : cycle) {
      const UvVec way = s.b - s.a;
      const double size = std::max(std::abs(way.u) / box.u.length(), std::abs(way.v) / box.v.length());
      const int parts = std::max(1, static_cast<int>(std::ceil(size / kLongestSegment)));
      for (int k = 0; k < parts; ++k) {
        const Uv end = k + 1 == parts ? s.b : lerp(s.a, s.b, static_cast<double>(k + 1) / parts);
        fine.push_back({k == 0 ? s.a : fine.back().b, end});
      }
    }
    cycle = std::move(fine);
  }
}

void FaceBorder::build_blocks() {
  for (int c = 0; c < cycle_count(); ++c) {
    for (int i = 0; i < segment_count(c); i += kBlock) {
      Block block{c, i, std::min(i + kBlock, segment_count(c)), box_of(cycles_[c][i].a, cycles_[c][i].b)};
      for (int k = i; k < block.last; ++k) block.box = join(block.box, box_of(cycles_[c][k].a, cycles_[c][k].b));
      blocks_.push_back(block);
    }
  }
  const double pu = domain_.surface().u_period().value_or(0.0), pv = domain_.surface().v_period().value_or(0.0);
  for (double u : {0.0, -pu, pu}) {
    for (double v : {0.0, -pv, pv}) {
      const auto same = [&](UvVec s) { return s.u == u && s.v == v; };
      if (std::none_of(shifts_.begin(), shifts_.end(), same)) shifts_.push_back({u, v});
    }
  }
}

Uv FaceBorder::uv(BorderPlace place) const {
  const int n = segment_count(place.cycle);
  const double whole = std::floor(place.parameter);
  const Segment& s = cycles_[place.cycle][static_cast<int>(whole) % n];
  return lerp(s.a, s.b, place.parameter - whole);
}

double FaceBorder::segment_length(int cycle, int k) const {
  constexpr int kChords = 8;
  const Segment& s = cycles_[cycle][k];
  double length = 0.0;
  for (int i = 0; i < kChords; ++i) {
    length += (xyz_of(lerp(s.a, s.b, (i + 1.0) / kChords)) - xyz_of(lerp(s.a, s.b, double(i) / kChords))).norm();
  }
  return length;
}

UvVec FaceBorder::direction(BorderPlace place) const {
  const Segment& s = cycles_[place.cycle][static_cast<int>(place.parameter) % segment_count(place.cycle)];
  return s.b - s.a;
}

std::optional<FaceBorder::Crossing> FaceBorder::first_crossing(Uv a0, Uv b0, double from) const {
  std::optional<Crossing> best;
  for (UvVec shift : shifts_) {
    const Uv a = a0 + shift, b = b0 + shift;
    const UvBox chord = box_of(a, b);
    for (const Block& block : blocks_) {
      if (!overlap(chord, block.box)) continue;
      for (int k = block.first; k < block.last; ++k) {
        const Segment& s = cycles_[block.cycle][k];
        const double det = cross(b - a, s.b - s.a);
        const double along = cross(s.a - a, s.b - s.a) / det, across = cross(s.a - a, b - a) / det;
        if (!(along >= from && along <= 1.0 && across >= -kEndSlack && across <= 1.0 + kEndSlack)) continue;
        if (!best || along < best->fraction) best = {{block.cycle, k + std::clamp(across, 0.0, 1.0)}, along};
      }
    }
  }
  return best;
}

std::optional<BorderPlace> FaceBorder::nearest(Uv p0) const {
  const SurfaceJet j = domain_.surface().jet(p0);
  std::optional<BorderPlace> best;
  double least = kInf;
  for (UvVec shift : shifts_) {
    const Uv p = p0 + shift;
    for (int c = 0; c < cycle_count(); ++c) {
      for (int k = 0; k < segment_count(c); ++k) {
        const Segment& s = cycles_[c][k];
        const Xyz d = push_forward(j, s.b - s.a);
        const double f = std::clamp(push_forward(j, p - s.a).dot(d) / d.squaredNorm(), 0.0, 1.0);
        const double off = norm(j, p - lerp(s.a, s.b, f));
        if (off < least) least = off, best = {c, k + f};
      }
    }
  }
  return best;
}

std::vector<Uv> FaceBorder::stretch(BorderPlace from, BorderPlace to) const {
  const int n = segment_count(from.cycle);
  std::vector<Uv> line = {uv(from)};
  const double end = to.parameter > from.parameter ? to.parameter : to.parameter + n;
  for (double k = std::floor(from.parameter) + 1.0; k <= end; k += 1.0) {
    const Segment& before = cycles_[from.cycle][(static_cast<int>(k) - 1) % n];
    const Segment& after = cycles_[from.cycle][static_cast<int>(k) % n];
    if (!(line.back() == before.b)) line.push_back(before.b);
    if (k < end && !(after.a == before.b)) line.push_back(after.a);  // the other side of a seam
  }
  if (end > std::floor(end)) line.push_back(uv(to));
  return line;
}

}  // namespace geovor
