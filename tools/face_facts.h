// What `geovor info` says of a face.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "brep/model.h"

namespace geovor {

struct FaceFacts {
  int number = 0;
  std::string name;
  std::string kind;  ///< "plane", "b-spline", …; "-" where there is no usable surface
  std::optional<CadFace::SplineFacts> spline;
  std::optional<double> u_period, v_period;
  std::optional<double> area, area_error;
  int holes = 0;
  int collapsed = 0;                     ///< sides of the parameter region that are a single point in space
  std::optional<double> anisotropy;      ///< how stretched the parameterization is, 1 where it is not
  std::optional<double> smallest_angle;  ///< between the parameter lines, degrees
  double tolerance = 0.0;
  std::vector<std::string> problems;
};

/// Never throws for a bad face: what can't be found out stays empty, and `problems` says why.
FaceFacts face_facts(const CadModel& model, const CadFace& face);

}  // namespace geovor
