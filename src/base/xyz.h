// Points and vectors of space.
#pragma once

#include <Eigen/Core>

namespace geovor {

/// A point or a vector of space, in the model's unit of length.
using Xyz = Eigen::Vector3d;

}  // namespace geovor
