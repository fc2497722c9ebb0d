// A curve in space on its way into a CAD file.
#pragma once

#include <string>
#include <vector>

#include "base/xyz.h"

namespace geovor {

/// A polynomial B-spline that is not periodic, as CAD files state it: ascending distinct knots with multiplicities,
/// those at the ends degree + 1; poles = sum of the multiplicities - degree - 1.
struct CadCurve {
  std::string name;
  int degree = 0;
  std::vector<double> knots;
  std::vector<int> multiplicities;
  std::vector<Xyz> poles;
};

}  // namespace geovor
