// A geodesic Voronoi diagram of a face: plain data, read by the dual and by the writers.
#pragma once

#include <string>
#include <vector>

#include "base/uv.h"
#include "base/xyz.h"

namespace geovor {

struct DiagramSite {
  Uv uv;
  Xyz xyz;
};

/// One end of an edge, as it leaves a vertex.
struct Spoke {
  int edge = -1;        ///< -1 only while the diagram is being built
  bool at_end = false;  ///< this is the edge's last point (its travel arrives here)
};

/// A point where cells meet. The generators sites[i] (with the angle under which the geodesic leaves the site) stand
/// around it counter-clockwise; spoke i runs between generator i, to its right, and generator i + 1, to its left.
/// Inside the face there are as many spokes as generators (the last one is followed by generator 0); on the border one
/// less: generator 0 owns the border that leaves the vertex, with the face to the left, and the last one owns the
/// border that arrives. A vertex with one generator is the free end of a cut locus.
struct DiagramVertex {
  Uv uv;  ///< within the face
  Xyz xyz;
  double radius = 0.0;  ///< the geodesic distance to the sites
  std::vector<int> sites;
  std::vector<double> angles;  ///< t of the geodesic from sites[i] to here
  std::vector<Spoke> spokes;
  bool on_boundary = false;
  int border_cycle = -1;          ///< on_boundary: which cycle of FaceBorder
  double border_parameter = 0.0;  ///< and where on it
  double residual = 0.0;          ///< see recompute_residuals()
};

enum class EdgeKind { Bisector, CutLocus };

struct EdgePoint {
  Uv uv;  ///< within the face: jumps by a period where the edge crosses a seam
  Xyz xyz;
  double radius = 0.0;
  double left_angle = 0.0, right_angle = 0.0;                      ///< t of the geodesics from the two sites
  double radius_slope = 0.0, left_slope = 0.0, right_slope = 0.0;  ///< how the three grow per length of the edge
};

/// A maximal piece of the border between two cells (or, for a cut locus, of a cell with itself).
struct DiagramEdge {
  int left = -1, right = -1;  ///< the sites on both sides of the direction of travel
  int from = -1, to = -1;     ///< vertices; -1 both on an edge that closes on itself
  EdgeKind kind = EdgeKind::Bisector;
  std::vector<EdgePoint> points;  ///< from `from` to `to`, ends included; closed: the last equals the first
  double length = 0.0;            ///< of the polyline in space
  double residual = 0.0;          ///< see recompute_residuals()
  bool closed() const { return from < 0; }
};

/// A piece of the way around a cell: an edge, or a stretch of the face's border.
struct CellPiece {
  int edge = -1;  ///< -1: border
  bool reversed = false;
  int from_vertex = -1, to_vertex = -1;  ///< border: its ends; -1 where the cell has a whole cycle
  int border_cycle = -1;
  std::vector<Uv> border_uv;    ///< border: its polyline, both ends included
  std::vector<Xyz> border_xyz;  ///< the same in space
};

/// The cell of a site. Its loops run with the cell to the left; a cell without loops is a whole closed surface.
struct DiagramCell {
  int site = -1;
  std::vector<std::vector<CellPiece>> loops;
  double area = 0.0;
};

/// Something true about the diagram that its reader must know.
struct DiagramWarning {
  std::string kind;  ///< "path_leaves_face", "cut_locus", "unresolved", "seam_is_border", "areas_differ"
  std::vector<int> sites;
  Uv uv;
  std::string text;
};

struct VoronoiDiagram {
  double tolerance = 0.0;  ///< how far the polylines of edges may lie from the edges, model units
  std::vector<DiagramSite> sites;
  std::vector<DiagramVertex> vertices;
  std::vector<DiagramEdge> edges;
  std::vector<DiagramCell> cells;  ///< cell i belongs to site i
  std::vector<DiagramWarning> warnings;
};

}  // namespace geovor
