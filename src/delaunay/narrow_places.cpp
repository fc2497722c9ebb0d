#include "delaunay/narrow_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mesh/nearest_boxes.h"

namespace geovor {
namespace {

// Normals of places that face each other on one sheet differ by less than 72 degrees; with the two sides of a thin fold
// they point apart.
constexpr double kSameSheet = 0.3;
// The other place lies near the tangent plane: the complement of kSharpCosine.
constexpr double kOffSheet = 0.66;
// Where a border runs on (also around a corner that is not sharp) places are nearly as far apart in space as along it.
// Around a half circle, the least turn after which it faces itself, the share is 0.64.
constexpr double kRunsOn = 0.7;
// Chords between stations turn by less than this: the foot of a perpendicular on the curve lies below one of them.
constexpr double kBelowChord = 0.35;
// Steps of the foot's search along the curve: from a chord's foot each gains about two digits.
constexpr int kFootSteps = 6;
// The ends of an edge are looked at this part of its length inside, since there the speed of a parameter may vanish.
constexpr double kInside = 4e-5;
// A step along the border is halved while it is longer than this part of the gap's size, and the gap in its middle is
// off the mean of its ends by more than that.
constexpr double kResolved = 0.25;
constexpr double kUneven = 0.1;
// Gaps are not looked for in steps below this part of the smallest size, or of the size where no smallest is given.
constexpr double kFinestOfSmallest = 0.25, kFinestOfSize = 1e-3;
// Where the normals of both uses of an edge by one face agree this well, the face goes on across it.
constexpr double kSmoothCosine = 0.9999;

/// One use of an edge in the face's loops.
struct Piece {
  const Coedge* use = nullptr;
  const CadEdge* edge = nullptr;
  const EdgeStations* stations = nullptr;
  int next = -1, before = -1;  // the pieces that follow and precede it at its vertices

  int start_vertex() const { return use->reversed ? edge->last_vertex : edge->first_vertex; }
  int end_vertex() const { return use->reversed ? edge->first_vertex : edge->last_vertex; }
  double length() const { return stations->way.length(); }
  /// The way from its start, in the loop's direction.
  double along(double s) const { return use->reversed ? length() - s : s; }
};

/// A place on the border: where the loop comes from, where it goes, where the face is.
struct Frame {
  Xyz x, n, in, out;  // unit tangents
  bool is_reflex() const { return n.dot(in.cross(out)) < 0.0; }

  /// Whether it may: for a direction that is not exact.
  bool may_see(const Xyz& d) const { return d.dot(n.cross(in)) > 0.0 || d.dot(n.cross(out)) > 0.0 || is_reflex(); }

  /// Whether the unit direction d leads into the face, well away from the border.
  bool sees(const Xyz& d) const {
    if (std::abs(d.dot(n)) > kOffSheet) return false;
    if (d.dot(n.cross(in)) > kSharpCosine || d.dot(n.cross(out)) > kSharpCosine) return true;
    return is_reflex() && d.dot(in) >= 0.0 && d.dot(out) <= 0.0;
  }
};

class Finder {
 public:
  Finder(const CadModel& model, int face, const SurfaceProbe& probe, const SizeRule& rule)
      : model_(model), face_(face), probe_(probe) {
    result_.least = std::min(rule.min_size, rule.size);
    finest_ = std::max(kFinestOfSmallest * result_.least, kFinestOfSize * rule.size);
  }

  NarrowFace run(const std::vector<std::vector<FaceUse>>& uses,
                 const std::vector<std::optional<EdgeStations>>& stations,
                 const std::vector<std::vector<double>>& sizes) {
    collect(uses, stations);
    link();
    add_boxes();
    for (size_t p = 0; p < pieces_.size(); ++p) ends_sharp_.push_back(add_corner(static_cast<int>(p)));
    for (size_t p = 0; p < pieces_.size(); ++p) look_from(static_cast<int>(p), sizes[pieces_[p].use->edge]);
    return std::move(result_);
  }

 private:
  struct Segment {
    int piece, index;  // between the stations index and index + 1
  };

  bool is_smooth_seam(const std::vector<FaceUse>& uses, const CadEdge& edge) const;
  void collect(const std::vector<std::vector<FaceUse>>& uses, const std::vector<std::optional<EdgeStations>>& stations);
  void link();
  void add_boxes();
  bool add_corner(int p);
  Xyz tangent(const Piece& p, double s) const;
  Frame frame(int p, double s) const;
  void look_from(int p, const std::vector<double>& h);
  double gap_at(int p, double s, double h);
  void between(int p, double s0, double g0, double h0, double s1, double g1, double h1);
  struct From {
    int piece;
    double s;
    Xyz x;
    double h;
    std::optional<Frame> frame;  // made when it is needed
  };
  void look_at(From& from, const Segment& seg, double& gap);
  /// The way along the border where both places lie on one piece or on neighbours; infinite where they don't.
  struct Way {
    double length = std::numeric_limits<double>::infinity();
    int corner = -1;  // the piece after which the corner between them comes; -1: they lie on one piece
    double from_first = 0.0, from_second = 0.0;  // the ways to the corner
  };
  Way way_between(int p, double s, int q, double r) const;

  const CadModel& model_;
  int face_;
  const SurfaceProbe& probe_;
  double finest_ = 0.0;
  std::vector<Piece> pieces_;
  std::vector<char> ends_sharp_;  // of the pieces: whether a sharp corner follows
  std::vector<Segment> segments_;
  NearestBoxes boxes_;
  NarrowFace result_;
};

bool Finder::is_smooth_seam(const std::vector<FaceUse>& uses, const CadEdge& edge) const {
  std::vector<const Coedge*> own;
  for (const FaceUse& use : uses) {
    if (use.face == face_) own.push_back(use.coedge);
  }
  if (own.size() != 2 || own[0]->reversed == own[1]->reversed) return false;
  const auto normal = [&](const Coedge* c) {
    const auto p = c->pcurve->position(edge.range.middle());
    return probe_.at({p.x(), p.y()}).n;
  };
  return normal(own[0]).dot(normal(own[1])) > kSmoothCosine;
}

void Finder::collect(const std::vector<std::vector<FaceUse>>& uses,
                     const std::vector<std::optional<EdgeStations>>& stations) {
  for (const TrimLoop& loop : model_.faces[face_].loops) {
    const int first = static_cast<int>(pieces_.size());
    for (const Coedge& c : loop.coedges) {
      if (!stations[c.edge] || !(stations[c.edge]->way.length() > 0.0)) continue;
      if (is_smooth_seam(uses[c.edge], model_.edges[c.edge])) continue;
      pieces_.push_back({&c, &model_.edges[c.edge], &*stations[c.edge], -1, -1});
    }
    const int n = static_cast<int>(pieces_.size()) - first;
    for (int i = 0; i < n; ++i) pieces_[first + i].next = first + (i + 1) % n;
  }
}

// Pieces that follow each other in a loop but have no common vertex (a pole or a seam lies between) are no neighbours.
void Finder::link() {
  for (size_t i = 0; i < pieces_.size(); ++i) {
    Piece& p = pieces_[i];
    const int v = p.end_vertex();
    if (v < 0 || v != pieces_[p.next].start_vertex()) {
      p.next = -1;
    } else {
      pieces_[p.next].before = static_cast<int>(i);
    }
  }
}

void Finder::add_boxes() {
  std::vector<SpaceBox> boxes;
  for (int p = 0; p < static_cast<int>(pieces_.size()); ++p) {
    const std::vector<Xyz>& x = pieces_[p].stations->x;
    for (int i = 0; i + 1 < static_cast<int>(x.size()); ++i) {
      segments_.push_back({p, i});
      boxes.push_back({x[i].cwiseMin(x[i + 1]), x[i].cwiseMax(x[i + 1])});
    }
  }
  boxes_ = NearestBoxes(std::move(boxes));
}

// In the direction of the loop.
Xyz Finder::tangent(const Piece& p, double s) const {
  const double margin = kInside * p.length();
  const double t = p.stations->way.parameter(std::clamp(s, margin, p.length() - margin));
  const Xyz d = p.edge->curve->jet(t).d1.normalized();
  return p.use->reversed ? Xyz(-d) : d;
}

Frame Finder::frame(int p, double s) const {
  const Piece& piece = pieces_[p];
  const double t = piece.stations->way.parameter(s);
  const auto uv = piece.use->pcurve->position(t);
  Frame f{piece.edge->curve->position(t), probe_.at({uv.x(), uv.y()}).n, tangent(piece, s), Xyz::Zero()};
  f.out = f.in;
  const double along = piece.along(s);
  if (!(along > 0.0) && piece.before >= 0) {
    const Piece& before = pieces_[piece.before];
    f.in = tangent(before, before.use->reversed ? 0.0 : before.length());
  }
  if (!(along < piece.length()) && piece.next >= 0) {
    const Piece& next = pieces_[piece.next];
    f.out = tangent(next, next.use->reversed ? next.length() : 0.0);
  }
  return f;
}

// Whether the corner after the piece is sharp.
bool Finder::add_corner(int p) {
  const Piece& piece = pieces_[p];
  if (piece.next < 0) return false;
  const Frame f = frame(p, piece.use->reversed ? 0.0 : piece.length());
  const double angle = std::atan2(f.n.dot(f.out.cross(-f.in)), -f.out.dot(f.in));
  if (!(angle >= 0.0 && std::cos(angle) > kSharpCosine)) return false;
  const Coedge &in = *piece.use, &out = *pieces_[piece.next].use;
  result_.corners.push_back({face_, piece.end_vertex(), {in.edge, in.reversed}, {out.edge, !out.reversed}, angle});
  return true;
}

Finder::Way Finder::way_between(int p, double s, int q, double r) const {
  const Piece &a = pieces_[p], &b = pieces_[q];
  Way way;
  if (p == q) way.length = std::abs(s - r);
  const auto around = [&way](int corner, double first, double second) {
    if (first + second < way.length) way = {first + second, corner, first, second};
  };
  if (a.next == q) around(p, a.length() - a.along(s), b.along(r));
  if (b.next == p) around(q, a.along(s), b.length() - b.along(r));
  return way;
}

void Finder::look_from(int p, const std::vector<double>& h) {
  const EdgeStations& st = *pieces_[p].stations;
  double last = 0.0;
  for (size_t i = 0; i < st.s.size(); ++i) {
    const double gap = gap_at(p, st.s[i], h[i]);
    if (i > 0) between(p, st.s[i - 1], last, h[i - 1], st.s[i], gap, h[i]);
    last = gap;
  }
}

// The gap, or, where there is none that matters, the largest that would.
double Finder::gap_at(int p, double s, double h) {
  const Piece& piece = pieces_[p];
  From from{p, s, piece.edge->curve->position(piece.stations->way.parameter(s)), h, std::nullopt};
  double gap = h / kLengthPerGap, reach2 = h * h;
  boxes_.near(from.x, reach2, [&](int i, double) { look_at(from, segments_[i], gap); });
  return gap;
}

void Finder::between(int p, double s0, double g0, double h0, double s1, double g1, double h1) {
  const double least = std::min(g0, g1);
  const bool is_free = !(g0 < h0 / kLengthPerGap || g1 < h1 / kLengthPerGap);
  if (is_free || !(s1 - s0 > std::max(finest_, kResolved * kLengthPerGap * least))) return;
  const double s = 0.5 * (s0 + s1), h = 0.5 * (h0 + h1), g = gap_at(p, s, h);
  if (!(std::abs(g - 0.5 * (g0 + g1)) > kUneven * g)) return;
  between(p, s0, g0, h0, s, g, h);
  between(p, s, g, h, s1, g1, h1);
}

void Finder::look_at(From& from, const Segment& seg, double& gap) {
  const Piece& q = pieces_[seg.piece];
  const EdgeStations& st = *q.stations;
  const Xyz a = st.x[seg.index], chord = st.x[seg.index + 1] - a;
  const double part = std::clamp((from.x - a).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
  double r = st.s[seg.index] + part * (st.s[seg.index + 1] - st.s[seg.index]);
  const Xyz to_chord = a + part * chord - from.x;
  const auto is_end = [&q](double at) { return !(at > 0.0 && at < q.length()); };
  const double aside = std::abs(to_chord.dot(chord)), most = kBelowChord * to_chord.norm() * chord.norm();
  if (!is_end(r) && !(aside <= most)) return;
  if (!(to_chord.norm() < kRunsOn * way_between(from.piece, from.s, seg.piece, r).length)) return;
  if (!from.frame) from.frame = frame(from.piece, from.s);
  if (!from.frame->may_see(to_chord)) return;
  const double direction = q.use->reversed ? -1.0 : 1.0;
  for (int k = 0; k < kFootSteps && !is_end(r); ++k) {
    const Xyz on_curve = q.edge->curve->position(st.way.parameter(r));
    r = std::clamp(r + direction * (from.x - on_curve).dot(tangent(q, r)), 0.0, q.length());
  }
  const Frame to = frame(seg.piece, r);
  const double distance = (to.x - from.x).norm();
  const Way way = way_between(from.piece, from.s, seg.piece, r);
  if (!(distance > 0.0 && distance < from.h && distance < kRunsOn * way.length)) return;
  const Xyz d = (to.x - from.x) / distance;
  if (!(from.frame->n.dot(to.n) > kSameSheet && from.frame->sees(d) && to.sees(-d))) return;
  result_.pairs.push_back({{pieces_[from.piece].use->edge, from.s}, {q.use->edge, r}, distance});
  if (!(distance < from.h / kLengthPerGap)) return;
  const int corner = way.corner >= 0 && ends_sharp_[way.corner] ? pieces_[way.corner].end_vertex() : -1;
  result_.places.push_back({pieces_[from.piece].use->edge, from.s, distance, corner, way.from_first});
  result_.places.push_back({q.use->edge, r, distance, corner, way.from_second});
  gap = std::min(gap, distance);
}

}  // namespace

NarrowFace narrow_places(const CadModel& model, int face, const SurfaceProbe& probe, const SizeRule& rule,
                         const std::vector<std::vector<FaceUse>>& uses,
                         const std::vector<std::optional<EdgeStations>>& stations,
                         const std::vector<std::vector<double>>& sizes) {
  return Finder(model, face, probe, rule).run(uses, stations, sizes);
}

}  // namespace geovor
