// How far a face's parameterization is from one that keeps lengths and angles.
#pragma once

namespace geovor {

class FaceDomain;

/// How unequal the parameterization is: the largest ratio of the singular values of (Su, Sv) inside the face, after one
/// global scale a direction, and the smallest angle between Su and Sv (radians). Infinite and 0 where a sample is
/// singular.
struct Stretch {
  double anisotropy = 1.0;
  double smallest_angle = 0.0;
};

/// Both over a grid of samples strictly inside the face; the scales make the mean of log |Su| and of log |Sv| zero.
Stretch parameter_stretch(const FaceDomain& domain);

}  // namespace geovor
