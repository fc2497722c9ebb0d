#include "io/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/error.h"

namespace geovor {
namespace {

// No writer rounds to fewer digits than printf's own six: numbers that are shorter are meant as they stand. From
// fifteen on the digits are a double's.
constexpr int kFewestDigits = 6, kMostDigits = 15;

// Areas are compared by their squares, four lengths in a product: with larger coordinates these would overflow.
constexpr double kLargest = 1e75;

/// Half a unit in the last place of the largest coordinate, in all three directions at once.
double rounding_of(int digits, double largest) {
  if (!(largest > 0.0)) return 0.0;
  double half = 0.5 * std::numeric_limits<double>::epsilon() * largest;
  if (digits == MeshBuilder::kSingle) {
    half = 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon()) * largest;
  } else if (digits >= kFewestDigits && digits < kMostDigits) {
    half = 0.5 * std::pow(10.0, std::floor(std::log10(largest)) + 1.0 - digits);
  }
  return std::numbers::sqrt3 * half;
}

std::string precision_name(int digits) {
  if (digits == MeshBuilder::kSingle) return "single precision";
  if (digits >= kFewestDigits && digits < kMostDigits) return std::to_string(digits) + " digits";
  return "double precision";
}

}  // namespace

void fail_to_read(int line, const std::string& what) {
  throw Error(ErrorCode::Unreadable, (line > 0 ? "line " + std::to_string(line) + ": " : std::string()) + what);
}

int MeshBuilder::group(std::string_view name) {
  const auto [place, is_new] = groups_.try_emplace(std::string(name), static_cast<int>(loaded_.groups.size()));
  if (is_new) loaded_.groups.emplace_back(name);
  return place->second;
}

void MeshBuilder::polygon(const std::vector<int>& corners, int group) {
  if (corners.size() < 3) return other_element();
  loaded_.split += corners.size() > 3;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    loaded_.mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    loaded_.mesh.face_of.push_back(group);
  }
}

void MeshBuilder::weld() {
  std::vector<Xyz>& points = loaded_.mesh.points;
  std::vector<int> order(points.size()), same(points.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int k) {
    const Xyz &a = points[i], &b = points[k];
    for (int c = 0; c < 3; ++c) {
      if (a[c] != b[c]) return a[c] < b[c];
    }
    return i < k;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && points[order[i]] == points[order[i - 1]];
    same[order[i]] = again ? same[order[i - 1]] : order[i];
  }
  std::vector<Xyz> kept;
  std::vector<int> number(points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (same[i] == static_cast<int>(i)) number[i] = static_cast<int>(kept.size()), kept.push_back(points[i]);
  }
  points = std::move(kept);
  for (auto& t : loaded_.mesh.triangles) {
    for (int& c : t) c = number[same[c]];
  }
}

LoadedMesh MeshBuilder::finish(int digits) {
  double largest = 0.0;
  for (int i = 0; i < points(); ++i) {
    const Xyz& x = loaded_.mesh.points[i];
    if (!x.allFinite()) fail_to_read(0, "point " + std::to_string(i + 1) + " is not finite; export the mesh anew");
    largest = std::max(largest, x.cwiseAbs().maxCoeff());
    if (largest > kLargest) {
      fail_to_read(0,
                   "point " + std::to_string(i + 1) + " is farther away than any part reaches; export the mesh anew");
    }
  }
  for (int t = 0; t < triangles(); ++t) {
    for (const int c : loaded_.mesh.triangles[t]) {
      if (c >= 0 && c < points()) continue;
      fail_to_read(0, "triangle " + std::to_string(t + 1) +
                          " names a point that the file does not hold; it may be cut "
                          "short, export the mesh anew");
    }
  }
  loaded_.precision = precision_name(digits);
  loaded_.rounding = rounding_of(digits, largest);
  return std::move(loaded_);
}

}  // namespace geovor
