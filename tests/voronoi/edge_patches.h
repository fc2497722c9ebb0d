// Two sites each on surfaces of every kind: what the tests of an edge's points have in common.
#pragma once

#include <memory>
#include <vector>

#include "support/splines.h"
#include "test_faces.h"

namespace geovor::testing {

struct Patch {
  const char* name;
  SurfacePtr surface;
  Uv p, q;
};

inline std::vector<Patch> patches() {
  return {{"plane", std::make_shared<Plane>(Frame{}), {0, 0}, {0.4, 0.1}},
          {"cylinder over its seam", std::make_shared<Cylinder>(Frame{}, 1.0), {-0.3, 0.0}, {0.2, 0.1}},
          {"sphere", std::make_shared<Sphere>(Frame{}, 1.0), {0.2, 0.1}, {0.7, 0.0}},
          {"wave", std::make_shared<WaveSurface>(UvBox{{-9, 9}, {-9, 9}}), {0.1, 0.2}, {0.6, 0.3}},
          {"torus", std::make_shared<Torus>(Frame{}, 3.0, 1.0), {0.2, 0.3}, {0.35, 0.4}},
          {"spline with knots",
           std::make_shared<BSplineSurface>(random_spline(3, 3, 6, false, 5).surface()),
           {2.8, 2.9},
           {3.3, 3.2}}};
}

}  // namespace geovor::testing
