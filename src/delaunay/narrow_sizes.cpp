#include "delaunay/narrow_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace geovor {
namespace {

// Places nearer to each other than this part of the edge are one: their ways are exact to 1e-13.
constexpr double kSamePlace = 1e-7;
// A segment in a corner takes no more than this part of its edge.
constexpr double kMostOfEdge = 1.0 / 3;
// From the segment in the corner to the next one the length falls to this part, and so on until it is that of the gap:
// the faces on the other sides of both edges have to follow.
constexpr double kFall = 0.4;

// Where a gap asks for less than this part of the smallest size, slivers can't be helped, and finer ones are only more.
constexpr double kHopeless = 0.5;

// The place's station, made where there is none.
void insert(EdgeStations& st, const Curve3& curve, std::vector<double> places) {
  std::sort(places.begin(), places.end());
  const double same = kSamePlace * st.way.length();
  std::vector<double> s, h;
  std::vector<Xyz> x;
  size_t next = 0;
  for (size_t i = 0; i < st.s.size(); ++i) {
    for (; next < places.size() && places[next] < st.s[i] - same; ++next) {
      if (i == 0 || !(places[next] > s.back() + same)) continue;
      const double part = (places[next] - st.s[i - 1]) / (st.s[i] - st.s[i - 1]);
      s.push_back(places[next]);
      h.push_back(st.h[i - 1] + part * (st.h[i] - st.h[i - 1]));
      x.push_back(curve.position(st.way.parameter(places[next])));
    }
    s.push_back(st.s[i]);
    h.push_back(st.h[i]);
    x.push_back(st.x[i]);
  }
  st.s = std::move(s);
  st.h = std::move(h);
  st.x = std::move(x);
}

int nearest_station(const EdgeStations& st, double s) {
  const auto after = std::lower_bound(st.s.begin(), st.s.end(), s);
  if (after == st.s.begin()) return 0;
  const int i = static_cast<int>(std::min(after, st.s.end() - 1) - st.s.begin());
  return s - st.s[i - 1] < st.s[i] - s ? i - 1 : i;
}

// The stations before and after the place, or its own.
std::array<int, 2> stations_beside(const EdgeStations& st, double s) {
  const int i = nearest_station(st, s);
  if (std::abs(st.s[i] - s) <= kSamePlace * st.way.length()) return {i, i};
  return st.s[i] < s ? std::array<int, 2>{i, i + 1} : std::array<int, 2>{i - 1, i};
}

}  // namespace

NarrowSizes::NarrowSizes(const CadModel& model, const std::vector<NarrowFace>& faces,
                         const std::vector<std::vector<FaceUse>>& uses,
                         std::vector<std::optional<EdgeStations>>& stations) {
  std::vector<std::vector<double>> places(model.edges.size());
  for (const NarrowFace& face : faces) {
    for (const NarrowPlace& p : face.places) places[p.edge].push_back(p.s);
    corners_.insert(corners_.end(), face.corners.begin(), face.corners.end());
    least_.push_back(face.least);
  }
  for (size_t e = 0; e < places.size(); ++e) {
    if (!places[e].empty()) insert(*stations[e], *model.edges[e].curve, std::move(places[e]));
  }
  add_links(faces, stations);
  for (size_t f = 0; f < faces.size(); ++f) {
    for (const NarrowPlace& p : faces[f].places) {
      const double asked = (p.corner < 0 ? kLengthPerGap : kLengthPerGapInCorners) * p.gap;
      if (asked < kHopeless * least_[f]) continue;
      double size = std::numeric_limits<double>::infinity();
      for (const FaceUse& use : uses[p.edge]) size = std::min(size, use.rule->size);
      const double h = in_steps(std::max(asked, least_[f]), size);
      const int i = nearest_station(*stations[p.edge], p.s);
      if (p.corner >= 0) {
        in_corners_.push_back({p.edge, i, p.corner, p.from_corner, h});
      } else {
        stations[p.edge]->h[i] = std::min(stations[p.edge]->h[i], h);
      }
    }
  }
}

void NarrowSizes::add_links(const std::vector<NarrowFace>& faces,
                            const std::vector<std::optional<EdgeStations>>& stations) {
  links_.resize(stations.size());
  for (const NarrowFace& face : faces) {
    for (const PlacePair& p : face.pairs) {
      const EdgeStations &a = *stations[p.a.edge], &b = *stations[p.b.edge];
      for (int i : stations_beside(a, p.a.s)) {
        for (int k : stations_beside(b, p.b.s)) {
          const double distance = p.distance + std::abs(a.s[i] - p.a.s) + std::abs(b.s[k] - p.b.s);
          links_[p.a.edge].push_back({i, p.b.edge, k, distance});
          links_[p.b.edge].push_back({k, p.a.edge, i, distance});
        }
      }
    }
  }
  for (std::vector<Link>& of_edge : links_) {
    std::sort(of_edge.begin(), of_edge.end(), [](const Link& a, const Link& b) { return a.station < b.station; });
  }
}

std::vector<NarrowSizes::Caps> NarrowSizes::lower_in_corners(const std::vector<std::optional<EdgeStations>>& stations,
                                                             const std::vector<double>& vertex,
                                                             std::vector<std::vector<double>>& h) const {
  std::vector<Caps> caps(stations.size());
  std::vector<double> length = vertex;  // of the segments in a vertex's sharp corners
  for (const FaceCorner& c : corners_) {
    double& l = length[c.vertex];
    for (const FaceCorner::End& end : {c.in, c.out}) l = std::min(l, kMostOfEdge * stations[end.edge]->way.length());
  }
  // Beyond a segment shorter than the smallest size nothing follows the gap.
  for (const FaceCorner& c : corners_) {
    if (length[c.vertex] < least_[c.face]) length[c.vertex] = 0.0;
  }
  for (const FaceCorner& c : corners_) {
    for (const FaceCorner::End& end : {c.in, c.out}) {
      (end.at_start ? caps[end.edge].first : caps[end.edge].last) = length[c.vertex];
    }
  }
  for (const InCorner& p : in_corners_) {
    const double beyond = p.from_corner - length[p.corner];
    if (beyond < 0.0) continue;
    const double fall = kFall * length[p.corner] - (1.0 - kFall) * beyond;
    h[p.edge][p.station] = std::min(h[p.edge][p.station], std::max(p.size, fall));
  }
  return caps;
}

}  // namespace geovor
