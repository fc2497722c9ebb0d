// What the program says of a certificate.
#pragma once

#include <optional>
#include <string>

#include "voronoi/certificate.h"

namespace geovor {

/// A line a claim, with what was measured and its bound, and the result.
std::string certificate_text(const Certificate& certificate);

/// The first claim that fails, where and why, in one line; nothing where all hold.
std::optional<std::string> failed_claim(const Certificate& certificate);

}  // namespace geovor
