// Follows a bisector from a point of it to where it stops being an edge of the diagram.
#pragma once

#include <optional>
#include <vector>

#include "voronoi/bisector.h"
#include "voronoi/face_border.h"
#include "voronoi/labels.h"

namespace geovor {

enum class ChainEnd {
  Vertex,  ///< another generator is as near: `generators`
  Border,  ///< the face ends: `place`
  Closed,  ///< back at the start
  Stuck,   ///< the bisector can't be followed any further: a conjugate point, or a place where geodesics fail
};

/// A piece of a bisector. Every point fulfils kBisectorTolerance, the chords stay within the tracer's tolerance.
struct Chain {
  std::vector<BisectorPoint> points;  ///< from the start to the end, both included
  ChainEnd end = ChainEnd::Stuck;
  std::vector<SiteRay> generators;  ///< Vertex: all that are equidistant, counter-clockwise by their directions
  BorderPlace place;                ///< Border
};

class ChainTracer {
 public:
  /// All outlive the tracer. `tolerance`: how far chords may lie from the edge, model units.
  ChainTracer(const FaceDomain& domain, const FaceBorder& border, const CandidateLabels& labels, double tolerance)
      : domain_(domain), border_(border), labels_(labels), rays_(labels.rays()), tolerance_(tolerance) {}

  /// Walks in the direction of start.tangent(). `on_border`: the start lies on the face's border and the walk goes in.
  Chain trace(const BisectorPoint& start, bool on_border) const;

 private:
  struct Walk;
  struct Vertex {
    std::vector<SiteRay> generators;
    BisectorPoint point;  ///< the rays of the chain's own two generators
  };
  enum class Step { Going, Ended, Failed };
  Step advance(Walk& walk) const;
  bool end_on_border(Walk& walk, const BisectorPoint& next) const;
  std::optional<BisectorPoint> predict(const Walk& walk, double h) const;
  std::optional<Vertex> find_vertex(const BisectorPoint& from, const BisectorPoint& next, const SiteRay& rival,
                                    double fraction) const;
  std::optional<BisectorPoint> border_point(const BisectorPoint& near, BorderPlace& place) const;
  std::optional<FaceBorder::Crossing> leaves_face(const Walk& walk, const BisectorPoint& next) const;
  double longest_step(const BisectorPoint& m) const;

  const FaceDomain& domain_;
  const FaceBorder& border_;
  const CandidateLabels& labels_;
  const SiteRays& rays_;
  double tolerance_;
};

/// Generators whose distances agree to this part of the radius make one vertex: well above the noise of distances, and
/// far below the sharpness that the diagram promises.
inline constexpr double kOneVertex = 1e-10;

/// The generators of a point sorted counter-clockwise by the directions in which their sites lie, `first` first.
void sort_around(std::vector<SiteRay>& generators);

}  // namespace geovor
