// OpenCASCADE's surfaces of every kind that geovor takes over from CAD files.
#pragma once

#include <Geom_Surface.hxx>
#include <string>
#include <vector>

#include "base/interval.h"
#include "base/uv.h"

namespace geovor::test {

struct OccSurface {
  std::string name;
  Handle(Geom_Surface) surface;
  UvBox box;               ///< where it is looked at
  std::vector<Uv> places;  ///< where it is looked at besides: poles, apexes, seams
};

/// Plane, cylinder, cone, sphere, torus.
std::vector<OccSurface> elementary_surfaces();

/// B-splines and Béziers: every degree from 1 to 25, mixed degrees, polynomial and rational, periodic, with knots of
/// every continuity.
std::vector<OccSurface> spline_surfaces();

/// Revolutions and extrusions of lines, conics and splines.
std::vector<OccSurface> swept_surfaces();

/// Offsets, and rectangular trims, of the elementary and swept ones and of some splines.
std::vector<OccSurface> offset_surfaces();
std::vector<OccSurface> trimmed_surfaces();

}  // namespace geovor::test
