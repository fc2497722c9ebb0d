#include "pipeline/voronoi_face.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brep/face_domain.h"
#include "pipeline/cell_outlines.h"
#include "pipeline/face_point.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/place_sites.h"

namespace geovor {
namespace {

// The border's polyline lies within this part of the face's size.
constexpr double kBorderDeflection = 1e-6;

// Areas of the cells and the face agree to this in every whole diagram. The certificate's bound is 1e-6; but where
// parameters run 4096 times as fast at one end of a side as at the other, the areas of right cells add up to 1e-5 only.
constexpr double kAreasAgree = 1e-4;

// Of a picture: along edges its patches are some 6 units high on a usual page.
constexpr int kRasterRows = 128;
constexpr int kRasterColumns = 40;

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", x);
  return buffer;
}

Uv locate(const FaceDomain& domain, int index, const Xyz& x, double tolerance, bool snap) {
  try {
    return project_on_face(domain, x, tolerance, snap).uv;
  } catch (const Error& error) {
    throw SiteError(index, -1, error.what());
  }
}

std::vector<Uv> sites_of(const FaceDomain& domain, const VoronoiRequest& request, double area, double tolerance) {
  std::vector<Uv> sites;
  for (int i = 0; i < static_cast<int>(request.sites.size()); ++i) {
    if (const Uv* uv = std::get_if<Uv>(&request.sites[i])) {
      sites.push_back(is_finite(*uv) ? domain.to_principal(*uv) : *uv);
    } else {
      sites.push_back(locate(domain, i, std::get<Xyz>(request.sites[i]), tolerance, request.snap));
    }
  }
  if (!sites.empty()) return sites;
  if (request.count == 0 && request.spacing > 0.0) {
    // A hexagonal arrangement with this distance between neighbours.
    const double cell = 0.5 * std::numbers::sqrt3 * request.spacing * request.spacing;
    constexpr double kMostSites = 1e6;
    if (!(area <= kMostSites * cell)) {
      throw Error(ErrorCode::Usage, "the spacing asks for more than a million sites; give a larger --spacing");
    }
    return place_sites_apart(domain, request.spacing, request.seed, request.placing);
  }
  if (request.count <= 0) throw Error(ErrorCode::Usage, "no sites; give some, or a positive number of them");
  return place_sites(domain, request.count, request.seed, request.placing);
}

void check_areas(const FaceDomain& domain, const Area& face_area, VoronoiDiagram& diagram) {
  const double whole = face_area.value;
  if (diagram.cells.size() == 1 && diagram.cells[0].loops.empty()) diagram.cells[0].area = whole;
  double sum = 0.0;
  for (const DiagramCell& cell : diagram.cells) sum += cell.area;
  if (std::abs(sum - whole) <= kAreasAgree * whole + face_area.error) return;
  diagram.warnings.push_back({"areas_differ",
                              {},
                              {domain.box().u.middle(), domain.box().v.middle()},
                              "the areas of the cells add up to " + text(sum / whole) + " of the face's"});
}

}  // namespace

VoronoiResult voronoi_face(const CadModel& model, const CadFace& face, const VoronoiRequest& request) {
  if (!face.surface) {
    throw Error(ErrorCode::FaceRejected, face.problems.empty() ? "the face has no surface" : face.problems.front());
  }
  const double deflection = std::max(kBorderDeflection * model.diagonal(), kConfusion);
  const FaceDomain domain(model, face, deflection);
  const double tolerance = printed_tolerance(domain, face);
  VoronoiResult result;
  const Area area = face_area(model, face);
  result.face_area = area.value;
  const std::vector<Uv> sites = sites_of(domain, request, result.face_area, tolerance);
  check_sites(domain, sites, tolerance);
  VoronoiOptions options;
  options.tolerance = request.tolerance;
  options.progress = request.progress;
  result.diagram = build_diagram(domain, sites, options);
  check_areas(domain, area, result.diagram);
  result.dual = dual_of(domain.surface(), result.diagram, request.raster ? DualPaths::Drawn : DualPaths::None);
  result.surface = face.surface;
  result.deflection = deflection;
  result.parameters = domain.box();
  if (request.raster) {
    result.raster = raster_of_cells(domain, result.diagram, kRasterRows, kRasterColumns);
    result.raster.outlines = outlines_of_cells(model, face, result.diagram, deflection);
  }
  if (request.certify) result.certificate = certify(domain, result.diagram, area);
  return result;
}

}  // namespace geovor
