#include "io/colours.h"

#include <algorithm>
#include <cmath>

namespace geovor {

std::array<double, 3> srgb(const std::array<double, 3>& linear) {
  std::array<double, 3> out{};
  for (int k = 0; k < 3; ++k) {
    // The conditions are such that NaN becomes black.
    const double x = linear[k] > 0.0 ? std::min(linear[k], 1.0) : 0.0;
    out[k] = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  }
  return out;
}

std::array<std::uint8_t, 3> srgb_bytes(const std::array<double, 3>& linear) {
  const std::array<double, 3> colour = srgb(linear);
  std::array<std::uint8_t, 3> bytes{};
  for (int k = 0; k < 3; ++k) bytes[k] = static_cast<std::uint8_t>(std::lround(255.0 * colour[k]));
  return bytes;
}

}  // namespace geovor
