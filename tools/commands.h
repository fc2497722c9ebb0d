// The commands of the program. Each returns the program's exit code and throws Error where it can't go on.
#pragma once

#include "options.h"

namespace geovor {

int run(const InfoArguments& arguments);
int run(const MeshArguments& arguments);
int run(const VoronoiArguments& arguments);
int run(const DistanceArguments& arguments);
int run(const CheckArguments& arguments);
inline int run(const NoArguments&) { return 0; }

}  // namespace geovor
