#include "pipeline/nearest_on_cad.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "surface/project.h"

namespace geovor {
namespace {

/// A piece of a curve is straight enough where its second differences are below this part of it.
constexpr double kStraight = 0.02;
constexpr int kMostHalvings = 16;
constexpr int kBorderLooks = 5;
/// Before it is looked at, a curve is halved so often: a full turn must not look short.
constexpr int kFirstHalvings = 2;
/// A foot may lie outside of its patch by this part of the patch, where another one would find it as well.
constexpr double kOverlap = 1e-3;

UvBox widened_in(const UvBox& b, const UvBox& domain) {
  const auto widen = [](Interval r, const Interval& limits) {
    const double by = kOverlap * r.length();
    return Interval{std::max(r.lo - by, std::min(limits.lo, r.lo)), std::min(r.hi + by, std::max(limits.hi, r.hi))};
  };
  return {widen(b.u, domain.u), widen(b.v, domain.v)};
}

// Newton's method for the foot on a nearly straight piece, kept inside it.
double foot_parameter(const Curve3& curve, const Interval& range, const Xyz& x, double guess) {
  constexpr int kSteps = 20;
  double t = range.clamp(guess), least = std::numeric_limits<double>::infinity(), best = t;
  for (int i = 0; i < kSteps; ++i) {
    const CurveJet<3> j = curve.jet(t);
    const Xyz r = j.C - x;
    if (!(r.squaredNorm() < least)) break;
    least = r.squaredNorm();
    best = t;
    const double gauss = j.d1.squaredNorm(), newton = gauss + r.dot(j.d2);
    const double h = newton > 0.0 ? newton : gauss;
    if (!(h > 0.0)) break;
    t = range.clamp(t - r.dot(j.d1) / h);
  }
  return best;
}

}  // namespace

NearestOnFace::NearestOnFace(const CadModel& model, int face, double precision)
    : face_(face),
      precision_(precision),
      side_(model.faces[face].reversed ? -1.0 : 1.0),
      domain_(model, model.faces[face], precision),
      probe_(domain_.surface(), domain_.box()),
      patches_(surface_patches(domain_, precision)) {
  std::set<int> done;
  for (const TrimLoop& loop : model.faces[face].loops) {
    for (const Coedge& c : loop.coedges) {
      const CadEdge& edge = model.edges[c.edge];
      if (!edge.degenerate() && done.insert(c.edge).second) cut_edge(c, *edge.curve, edge.range, precision, 0);
    }
  }
  std::vector<SpaceBox> boxes;
  for (const SurfacePatch& p : patches_) boxes.push_back(p.space);
  boxes.insert(boxes.end(), border_boxes_.begin(), border_boxes_.end());
  boxes_ = NearestBoxes(std::move(boxes));
}

void NearestOnFace::cut_edge(const Coedge& coedge, const Curve3& curve, Interval t, double negligible, int halvings) {
  Xyz looks[kBorderLooks];
  for (int i = 0; i < kBorderLooks; ++i) looks[i] = curve.position(t.lo + t.length() * i / (kBorderLooks - 1));
  double bulge = 0.0;
  SpaceBox box{looks[0], looks[0]};
  for (int i = 1; i < kBorderLooks; ++i) {
    box.include(looks[i]);
    if (i > 1) bulge = std::max(bulge, (looks[i] - 2.0 * looks[i - 1] + looks[i - 2]).norm());
  }
  const bool bent = bulge > std::max(kStraight * (looks[kBorderLooks - 1] - looks[0]).norm(), negligible);
  const bool curved_edge = halvings > 0 || bent || !curve.breaks(t).empty();
  if ((bent && halvings < kMostHalvings) || (curved_edge && halvings < kFirstHalvings)) {
    cut_edge(coedge, curve, {t.lo, t.middle()}, negligible, halvings + 1);
    cut_edge(coedge, curve, {t.middle(), t.hi}, negligible, halvings + 1);
    return;
  }
  box.lo.array() -= bulge;
  box.hi.array() += bulge;
  border_.push_back({&coedge, &curve, t});
  border_boxes_.push_back(box);
}

bool NearestOnFace::contains(Uv p) const { return domain_.contains(p) || domain_.distance_to_border(p) <= precision_; }

Xyz NearestOnFace::normal(Uv uv) const { return side_ * probe_.at(uv).n; }

void NearestOnFace::improve(const Xyz& x, CadPlace& best) const {
  double best2 = best.distance * best.distance;
  boxes_.near(x, best2, [&](int i, double) {
    const int patches = static_cast<int>(patches_.size());
    if (i < patches) {
      if (patches_[i].least_distance2(x) < best2) improve_on_patch(patches_[i], x, best);
    } else {
      improve_on_border(border_[i - patches], x, best);
    }
    best2 = best.distance * best.distance;
  });
}

// Every point of a patch that lies in the face bounds the distance from above; the nearest one is a foot, or lies on
// the border, or on the edge of the patch and then is found in the next one too.
void NearestOnFace::improve_on_patch(const SurfacePatch& patch, const Xyz& x, CadPlace& best) const {
  const UvBox box = widened_in(patch.box, domain_.surface().domain());
  const Projection p = project_near(domain_.surface(), x, patch.guess(x), box);
  if (!(p.distance < best.distance)) return;
  const bool surely = patch.inside && box.contains(p.uv);
  if (surely || contains(p.uv)) best = {face_, p.uv, p.foot, p.distance};
}

void NearestOnFace::improve_on_border(const BorderPiece& piece, const Xyz& x, CadPlace& best) const {
  const Xyz a = piece.curve->position(piece.t.lo), d = piece.curve->position(piece.t.hi) - a;
  const double length2 = d.squaredNorm();
  const double k = length2 > 0.0 ? (x - a).dot(d) / length2 : 0.5;
  const double t = foot_parameter(*piece.curve, piece.t, x, piece.t.lo + k * piece.t.length());
  const Xyz foot = piece.curve->position(t);
  const double distance = (foot - x).norm();
  if (!(distance < best.distance)) return;
  const auto uv = piece.coedge->pcurve->position(t);
  best = {face_, {uv[0], uv[1]}, foot, distance};
}

NearestOnCad::NearestOnCad(const CadModel& model, const ForEach& for_each)
    : model_(model), faces_(model.faces.size()), why_not_(model.faces.size()) {
  const int n = static_cast<int>(model.faces.size());
  const double precision = kPrecision * model.diagonal();
  for_each(n, [&](int f) {
    try {
      faces_[f] = std::make_unique<NearestOnFace>(model, f, precision);
      if (faces_[f]->empty()) why_not_[f] = "it holds no point";
    } catch (const Error& error) {
      why_not_[f] = error.what();
    }
  });
  std::vector<SpaceBox> boxes;
  for (int f = 0; f < n; ++f) {
    if (!why_not_[f].empty()) {
      faces_[f].reset();
      continue;
    }
    usable_.push_back(f);
    boxes.push_back(faces_[f]->box());
  }
  tree_ = NearestBoxes(std::move(boxes));
}

CadPlace NearestOnCad::nearest(const Xyz& x) const {
  CadPlace best;
  double best2 = std::numeric_limits<double>::infinity();
  tree_.near(x, best2, [&](int i, double) {
    faces_[usable_[i]]->improve(x, best);
    best2 = best.distance * best.distance;
  });
  return best;
}

CadPlace NearestOnCad::nearest(const Xyz& x, int face) const {
  CadPlace best;
  if (faces_[face]) faces_[face]->improve(x, best);
  return best;
}

}  // namespace geovor
