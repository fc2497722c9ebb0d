// The edges of a diagram cut where they meet the seams and poles of the face, so that each piece is one line in the
// face's parameter plane.
#pragma once

#include <vector>

#include "pipeline/face_outline.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Where a run ends: at a vertex inside the face (side -1), or at a place of the outline.
struct RunEnd {
  int vertex = -1;  ///< of the diagram; -1: none, as where a run meets a seam
  int side = -1;
  double t = 0.0;
};

/// A piece of an edge in one copy of the parameter plane.
struct EdgeRun {
  int edge = -1;
  RunEnd from, to;
  std::vector<Uv> uv;
  std::vector<Xyz> xyz;
};

/// A piece of an edge that lies in a seam: there the seam itself divides the cells.
struct SeamRun {
  int edge = -1;
  RunEnd from, to;
};

struct EdgeRuns {
  std::vector<EdgeRun> runs;  ///< an edge's runs in the order of its travel
  std::vector<SeamRun> in_seams;
};

/// The runs of the edges between different cells (a cut locus divides none). What lies within `snap` (space) of a seam
/// or a pole is taken to lie on it. Vertices on the border lie within `reach` of the outline (the diagram's border is
/// made of straight pieces); the ends of runs are moved onto it.
EdgeRuns cut_edges(const FaceOutline& outline, const VoronoiDiagram& diagram, double snap, double reach);

}  // namespace geovor
