// The commands of the program. Each returns the program's exit code and throws Error where it can't go on.
#pragma once

#include "options.h"

namespace geovor {

int run(const InfoRequest& request);
int run(const MeshRequest& request);
inline int run(const NothingRequest&) { return 0; }

}  // namespace geovor
