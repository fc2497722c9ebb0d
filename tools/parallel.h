// Work on many faces at once.
#pragma once

#include <functional>

namespace geovor {

/// Runs body(0) … body(n-1) in any order; see for_each_on.
using ForEach = std::function<void(int n, const std::function<void(int)>& body)>;

/// A ForEach that uses `threads` threads, or all cores where that is 0.
ForEach for_each_on(int threads);

}  // namespace geovor
