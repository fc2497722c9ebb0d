// Value and derivatives of a function of two variables, the height of a graph.
#pragma once

namespace geovor {

/// f(u, v) and its partial derivatives up to the second order.
struct HeightJet {
  double f, fu, fv, fuu, fuv, fvv;
};

/// Those of the third order.
struct HeightThirds {
  double fuuu, fuuv, fuvv, fvvv;
};

}  // namespace geovor
