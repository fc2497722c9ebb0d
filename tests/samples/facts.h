// What is known of each sample from outside: closed forms, and quadrature of formulas that the samples were made from.
#pragma once

#include <optional>
#include <string>

namespace geovor::testing {

struct Facts {
  int faces = 1;
  bool closed = false;
  int euler = 1;                    ///< vertices - edges + triangles of any mesh of it
  double area = 0.0;                ///< mm^2
  double area_error = 1e-9;         ///< relative: how well `area` is known, or how far the file is from the formula
  std::optional<double> volume;     ///< mm^3
  std::string unit = "millimetre";  ///< that the file states; an IGES file says "mm"
};

/// The facts of a sample; nothing where none are written down.
std::optional<Facts> facts_of(const std::string& file);

/// The height of the graphs wave, flat, paraboloid and bumps over (x, y); nothing for other files.
std::optional<double> graph_height(const std::string& file, double x, double y);
/// How far the spline in the file may lie from graph_height, measured along z (samples/README.md).
double graph_error(const std::string& file);

}  // namespace geovor::testing
