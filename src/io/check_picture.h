// A sheet about a mesh that was checked: the whole of it, coloured by distance, and its worst places from near by.
#pragma once

#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace geovor {

/// A place worth a look.
struct CheckPlace {
  std::string title;    ///< "largest distance"
  std::string caption;  ///< "0.104 mm, triangle 17, Face3"
  Xyz at = Xyz::Zero();
  Xyz normal = Xyz::Zero();             ///< where to look from; zero: from the usual side
  std::vector<int> triangles;           ///< marked
  std::vector<std::vector<Xyz>> lines;  ///< drawn over everything: open edges, the way to the CAD
};

struct CheckSheet {
  /// A name and what there is to say.
  struct Fact {
    std::string name, value;
  };
  std::string title;  ///< the first line
  std::vector<Fact> facts;
  std::vector<double> distance;  ///< of each triangle
  std::string distance_unit;
  std::vector<CheckPlace> places;
};

/// An SVG. The same mesh and sheet give the same bytes. REQUIRES: indices of the mesh in range, points finite.
std::string check_picture(const TriangleMesh& mesh, const CheckSheet& sheet);

/// The same on a page of HTML that needs no network.
std::string check_page(const TriangleMesh& mesh, const CheckSheet& sheet);

}  // namespace geovor
