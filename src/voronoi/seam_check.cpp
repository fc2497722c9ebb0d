#include "voronoi/seam_check.h"

#include <algorithm>
#include <cmath>

#include "brep/nested_boxes.h"

namespace geovor {
namespace {

// Two flattened curves that are one in space are apart by twice the deflection at most.
constexpr double kDeflections = 2.0;

// A segment shorter than this many tolerances may be what is left of a pole: it tells nothing.
constexpr double kTooShort = 4.0;

// Refinements of the nearest place on a segment: its curve bends little.
constexpr int kRefinements = 4;

struct Part {
  BorderPlace start;
  Xyz a, b;
  double chord() const { return (b - a).norm(); }
  Xyz middle() const { return 0.5 * (a + b); }
};

/// The places of space for which a part is looked at: about its middle, as far as it is long.
struct Surroundings {
  Xyz lower, upper;
  static Surroundings of(const Part& part) {
    return {part.middle().array() - part.chord(), part.middle().array() + part.chord()};
  }
  void include(const Surroundings& other) { lower = lower.cwiseMin(other.lower), upper = upper.cwiseMax(other.upper); }
  bool hold(const Xyz& x) const { return (x.array() >= lower.array()).all() && (x.array() <= upper.array()).all(); }
};

std::vector<Part> parts_of(const FaceBorder& border) {
  std::vector<Part> parts;
  for (int c = 0; c < border.cycle_count(); ++c) {
    for (int k = 0; k < border.segment_count(c); ++k) {
      const BorderPlace start{c, static_cast<double>(k)};
      // The end is taken from the segment itself: the next one may start elsewhere, beyond a seam.
      parts.push_back({start, border.xyz(start), border.xyz_of(border.uv_in_segment(c, k, 1.0))});
    }
  }
  return parts;
}

/// Distance in space from x to the curve of the part; exact where x is near it.
double distance_to(const FaceBorder& border, const Part& part, const Xyz& x) {
  const int segment = static_cast<int>(part.start.parameter);
  const Xyz chord = part.b - part.a;
  double k = 0.5;
  const auto at = [&](double f) { return border.xyz_of(border.uv_in_segment(part.start.cycle, segment, f)); };
  Xyz there = at(k);
  for (int i = 0; i < kRefinements; ++i) {
    k = std::clamp(k + chord.dot(x - there) / chord.squaredNorm(), 0.0, 1.0);
    there = at(k);
  }
  return (there - x).norm();
}

/// Whether another stretch of the border lies in the same place. Neighbours touch at their ends only, and what is
/// looked at is a middle.
bool lies_twice(const FaceBorder& border, const std::vector<Part>& parts, const NestedBoxes<Surroundings>& tree,
                size_t self, const Xyz& middle, double tolerance) {
  bool twice = false;
  tree.walk([&](const Surroundings& box) { return !twice && box.hold(middle); },
            [&](int i) {
              const Part& part = parts[i];
              if (static_cast<size_t>(i) == self || !((part.middle() - middle).norm() < part.chord())) return;
              twice = twice || distance_to(border, part, middle) <= tolerance;
            });
  return twice;
}

}  // namespace

std::vector<Uv> seams_taken_for_border(const FaceDomain& domain, const FaceBorder& border) {
  const double tolerance = kDeflections * domain.deflection();
  const std::vector<Part> parts = parts_of(border);
  std::vector<Surroundings> boxes;
  for (const Part& part : parts) boxes.push_back(Surroundings::of(part));
  const NestedBoxes<Surroundings> tree(boxes);
  std::vector<Uv> seams;
  int found_on = -1;
  for (size_t i = 0; i < parts.size(); ++i) {
    const BorderPlace middle{parts[i].start.cycle, parts[i].start.parameter + 0.5};
    if (middle.cycle == found_on || !(parts[i].chord() > kTooShort * tolerance)) continue;
    const Uv uv = border.uv(middle);
    if (!(domain.distance_to_border(uv) > tolerance) &&
        !lies_twice(border, parts, tree, i, border.xyz_of(uv), tolerance)) {
      continue;
    }
    found_on = middle.cycle;
    seams.push_back(uv);
  }
  return seams;
}

}  // namespace geovor
