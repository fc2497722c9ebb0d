// What the .cpp files of this room share. The only header in which OpenCASCADE appears; never installed, never included
// from another room.
#pragma once

#include <Bnd_Box.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <map>
#include <optional>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "brep/model.h"
#include "occ_adapter/check_file.h"

namespace geovor::occ {

/// Keeps OpenCASCADE's messages off stdout and stderr while it lives. Global state, like OpenCASCADE's own.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  Message_SequenceOfPrinters printers_;
  std::streambuf* cout_;
  std::streambuf* cerr_;
};

/// Sets one of OpenCASCADE's global parameters and puts the old value back at the end of its life.
class StaticParameter {
 public:
  StaticParameter(const char* name, const std::string& value);
  ~StaticParameter();
  StaticParameter(const StaticParameter&) = delete;
  StaticParameter& operator=(const StaticParameter&) = delete;

 private:
  std::string name_, old_;
};

/// One line of what an exception of OpenCASCADE says.
std::string describe(const Standard_Failure& failure);

/// Runs f; an exception of OpenCASCADE becomes Error(code, "prefix (what it says); remedy").
template <class F>
auto translated(ErrorCode code, const std::string& prefix, const std::string& remedy, F&& f) -> decltype(f()) {
  try {
    return f();
  } catch (const Standard_Failure& failure) {
    throw Error(code, prefix + " (" + describe(failure) + "); " + remedy);
  }
}

/// What the file says of a face beside its geometry; keyed by the address of the face's TShape, for look-up only.
struct FileLabel {
  std::string name;
  std::optional<Colour> colour;
};
using FileLabels = std::map<const void*, FileLabel>;

struct LoadedShape {
  TopoDS_Shape shape;
  std::string file_unit;
  FileLabels labels;
  std::vector<std::string> warnings;
};

/// The shape in the file, its numbers in mm where the file states a unit. Throws Error(Unreadable).
LoadedShape load_shape(const std::string& path, CadFormat format);

/// The file's shape made fit for conversion: every edge has its curve and its p-curves with one parameter, and every
/// face has wires that close in the parameter plane, where OpenCASCADE's shape healing manages it. faces[i] is what
/// became of Face(i+1); the healing may have cut a face into several (same surface), or dropped it (null).
struct PreparedShape {
  TopoDS_Shape shape;
  std::vector<TopoDS_Shape> faces;
  std::vector<std::vector<std::string>> repairs;  ///< what was done to each face
};
PreparedShape prepare_shape(const TopoDS_Shape& shape);

/// A coedge on its way from OpenCASCADE to the model.
struct OccCoedge {
  TopoDS_Edge edge;
  Handle(Geom2d_Curve) pcurve;
  double first = 0.0, last = 0.0;
  bool reversed = false;
  gp_Pnt2d start() const { return pcurve->Value(reversed ? last : first); }
  gp_Pnt2d end() const { return pcurve->Value(reversed ? first : last); }
};

struct OccLoop {
  std::vector<OccCoedge> coedges;
  double gap = 0.0;    ///< largest jump between neighbours, in space, to first order
  bool closed = true;  ///< every jump is explained by the tolerances
  bool winds = false;  ///< it closes only up to a period: a seam is missing
};

struct OccTrims {
  std::vector<OccLoop> loops;
  int missing_pcurves = 0;
  bool turned = false;  ///< some loop ran the wrong way and was turned round
  bool sound() const;
};

/// The loops of a face in its parameter plane, in order of travel, outer loops counter-clockwise, holes clockwise,
/// holes in the same period as the loop around them.
OccTrims extract_trims(const TopoDS_Face& face);

/// Surfaces and curves in geovor's own types, with the same parameters. `range` is where a curve is used: one of a kind
/// without closed form is fitted there. Throw Error(FaceRejected); null only for a curve that can't be fitted.
SurfacePtr convert_surface(const Handle(Geom_Surface) & surface);
Curve3Ptr convert_curve(const Handle(Geom_Curve) & curve, Interval range);
Curve2Ptr convert_pcurve(const Handle(Geom2d_Curve) & curve, Interval range);

/// The surface without its trimming wrapper.
Handle(Geom_Surface) unwrapped(Handle(Geom_Surface) surface);

/// What OpenCASCADE's checker holds against a face, in words, one phrase each.
std::vector<std::string> check_face(const TopoDS_Face& face);

/// The distinct parts of a kind, in the order that numbers them.
std::vector<TopoDS_Shape> parts_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind);

/// The box of the faces, without tolerances. Void or open where there is no finite one.
Bnd_Box bounding_box(const TopoDS_Shape& shape);

/// The model of a loaded file.
CadModel build_model(const LoadedShape& loaded);

inline Xyz to_xyz(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }
inline Xyz to_xyz(const gp_Pnt& p) { return to_xyz(p.XYZ()); }

}  // namespace geovor::occ
