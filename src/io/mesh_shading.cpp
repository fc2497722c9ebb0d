#include "io/mesh_shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geovor {
namespace {

double to_linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }  // IEC 61966-2-1
double to_srgb(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; }

LinearColour from_srgb(double r, double g, double b) { return {to_linear(r), to_linear(g), to_linear(b)}; }

Xyz direction(const PictureProjection& view, double right, double up, double towards) {
  return (right * view.right() + up * view.up() + towards * view.towards_viewer()).normalized();
}

}  // namespace

std::string to_hex(const LinearColour& colour) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const double x : colour) {
    const int byte = static_cast<int>(std::lround(255.0 * to_srgb(std::clamp(x, 0.0, 1.0))));
    text += kDigits[byte / 16];
    text += kDigits[byte % 16];
  }
  return text;
}

LinearColour plain_tint() { return from_srgb(0.60, 0.70, 0.80); }

LinearColour face_tint(int number) {
  // Hues by the golden angle, the first a steel blue; a cosine a channel keeps the lightness even.
  constexpr double kMiddle = 0.70, kSwing = 0.13, kFirstHue = 3.6;
  const double golden_angle = 2.0 * std::numbers::pi * (2.0 - std::numbers::phi);
  const double hue = kFirstHue + golden_angle * (number - 1);
  const auto channel = [&](double shift) { return kMiddle + kSwing * std::cos(hue - shift); };
  const double third = 2.0 * std::numbers::pi / 3.0;
  return from_srgb(channel(0.0), channel(third), channel(2.0 * third));
}

LinearColour lit(const LinearColour& tint, const Xyz& normal, const PictureProjection& view) {
  const Xyz key = direction(view, -0.55, 0.55, 0.80), fill = direction(view, 0.9, 0.1, 0.45);
  const double sky = 0.5 + 0.5 * normal.z();
  const double diffuse =
      0.20 + 0.14 * sky + 0.64 * std::max(0.0, normal.dot(key)) + 0.20 * std::max(0.0, normal.dot(fill));
  constexpr double kGloss = 0.10, kGlossPower = 24.0;
  const Xyz half = (key + view.towards_viewer()).normalized();
  const double gloss = kGloss * std::pow(std::max(0.0, normal.dot(half)), kGlossPower);
  return diffuse * tint + LinearColour::Constant(gloss);
}

}  // namespace geovor
