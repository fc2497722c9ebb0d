// What a unit of length is in metres.
#pragma once

#include <string>

namespace geovor {

/// Of "mm", "m", "cm", "km", "um", "in", "ft" and "mi". Throws Error(Unwritable) for another.
double metres_of(const std::string& unit);

}  // namespace geovor
