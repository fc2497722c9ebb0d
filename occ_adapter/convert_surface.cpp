// Geom_* surfaces to geovor's own, with the same parameters. Transformed copies come in already: BRep_Tool::Surface
// applies a face's location, mirrored ones included.
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>

#include "occ_adapter/occ_private.h"
#include "surface/bspline_surface.h"
#include "surface/elementary_surfaces.h"
#include "surface/offset_surface.h"
#include "surface/swept_surfaces.h"

namespace geovor::occ {
namespace {

Xyz to_xyz(const gp_Dir& d) { return occ::to_xyz(d.XYZ()); }

Frame frame_of(const gp_Ax3& axes) {
  return {occ::to_xyz(axes.Location()), to_xyz(axes.XDirection()), to_xyz(axes.YDirection()), to_xyz(axes.Direction())};
}

KnotVector knots_of(const Geom_BSplineSurface& spline, bool u) {
  std::vector<double> knots;
  std::vector<int> multiplicities;
  for (int i = 1, n = u ? spline.NbUKnots() : spline.NbVKnots(); i <= n; ++i) {
    knots.push_back(u ? spline.UKnot(i) : spline.VKnot(i));
    multiplicities.push_back(u ? spline.UMultiplicity(i) : spline.VMultiplicity(i));
  }
  return {knots, multiplicities, u ? spline.UDegree() : spline.VDegree(),
          u ? spline.IsUPeriodic() : spline.IsVPeriodic()};
}

SurfacePtr convert_bspline(const Geom_BSplineSurface& spline) {
  const bool rational = spline.IsURational() || spline.IsVRational();
  std::vector<Xyz> poles;
  std::vector<double> weights;
  for (int i = 1; i <= spline.NbUPoles(); ++i) {
    for (int j = 1; j <= spline.NbVPoles(); ++j) {
      poles.push_back(occ::to_xyz(spline.Pole(i, j)));
      if (rational) weights.push_back(spline.Weight(i, j));
    }
  }
  return std::make_shared<BSplineSurface>(knots_of(spline, true), knots_of(spline, false), poles, weights);
}

SurfacePtr convert_elementary(const Geom_ElementarySurface& surface) {
  const Frame frame = frame_of(surface.Position());
  if (surface.IsKind(STANDARD_TYPE(Geom_Plane))) return std::make_shared<Plane>(frame);
  if (const auto* cylinder = dynamic_cast<const Geom_CylindricalSurface*>(&surface)) {
    return std::make_shared<Cylinder>(frame, cylinder->Radius());
  }
  if (const auto* cone = dynamic_cast<const Geom_ConicalSurface*>(&surface)) {
    return std::make_shared<Cone>(frame, cone->RefRadius(), cone->SemiAngle());
  }
  if (const auto* sphere = dynamic_cast<const Geom_SphericalSurface*>(&surface)) {
    return std::make_shared<Sphere>(frame, sphere->Radius());
  }
  if (const auto* torus = dynamic_cast<const Geom_ToroidalSurface*>(&surface)) {
    return std::make_shared<Torus>(frame, torus->MajorRadius(), torus->MinorRadius());
  }
  return nullptr;
}

Interval whole_range(const Geom_Curve& curve) { return {curve.FirstParameter(), curve.LastParameter()}; }

SurfacePtr convert_swept(const Geom_SweptSurface& surface) {
  const Handle(Geom_Curve) basis = surface.BasisCurve();
  const Curve3Ptr curve = convert_curve(basis, whole_range(*basis));
  if (const auto* revolution = dynamic_cast<const Geom_SurfaceOfRevolution*>(&surface)) {
    return std::make_shared<RevolutionSurface>(curve, occ::to_xyz(revolution->Location()), to_xyz(surface.Direction()));
  }
  return std::make_shared<ExtrusionSurface>(curve, to_xyz(surface.Direction()));
}

}  // namespace

SurfacePtr convert_surface(const Handle(Geom_Surface) & any) {
  const Handle(Geom_Surface) surface = unwrapped(any);
  if (const auto* elementary = dynamic_cast<const Geom_ElementarySurface*>(surface.get())) {
    if (SurfacePtr made = convert_elementary(*elementary)) return made;
  }
  if (const auto* spline = dynamic_cast<const Geom_BSplineSurface*>(surface.get())) return convert_bspline(*spline);
  if (surface->IsKind(STANDARD_TYPE(Geom_BezierSurface))) {
    return convert_bspline(*GeomConvert::SurfaceToBSplineSurface(surface));
  }
  if (const auto* swept = dynamic_cast<const Geom_SweptSurface*>(surface.get())) return convert_swept(*swept);
  if (const auto* offset = dynamic_cast<const Geom_OffsetSurface*>(surface.get())) {
    return std::make_shared<OffsetSurface>(convert_surface(offset->BasisSurface()), offset->Offset());
  }
  throw Error(ErrorCode::FaceRejected, std::string("its surface is of the kind ") + surface->DynamicType()->Name() +
                                           ", which is not supported; export it as a B-spline");
}

Handle(Geom_Surface) unwrapped(Handle(Geom_Surface) surface) {
  for (auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface); !trimmed.IsNull();
       trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface)) {
    surface = trimmed->BasisSurface();
  }
  return surface;
}

}  // namespace geovor::occ
