// Colours for files and screens.
#pragma once

#include <array>
#include <cstdint>

namespace geovor {

/// sRGB (IEC 61966-2-1), 0 … 1, of a linear colour; what lies outside is cut off.
std::array<double, 3> srgb(const std::array<double, 3>& linear);

/// The same as bytes.
std::array<std::uint8_t, 3> srgb_bytes(const std::array<double, 3>& linear);

/// What a face without a colour of its own has: a light grey, linear.
inline constexpr std::array<double, 3> kPlainColour = {0.6, 0.6, 0.6};

}  // namespace geovor
