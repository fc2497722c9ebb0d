// From a prepared shape to the model: indices for what is shared, loops, shells, box, problems.
#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "occ_adapter/occ_private.h"

namespace geovor::occ {
namespace {

// A vertex or an edge looser than this part of the model's diagonal is worth a word.
constexpr double kLooseTolerance = 1e-3;
// OpenCASCADE raises an error for a location that scales; only rounding of a rotation matrix may remain.
constexpr double kScaleRounding = 1e-9;

// Places at which the distance between an edge and its image on a surface is measured: the distance swings about as
// often as the curve has pieces.
constexpr int kSamplesAlone = 24;
constexpr int kSamplesPerPiece = 6;

std::string number(double x) {
  std::ostringstream text;
  text.precision(3);
  text << x;
  return text.str();
}

class ModelBuilder {
 public:
  explicit ModelBuilder(const LoadedShape& loaded) : loaded_(loaded), prepared_(prepare_shape(loaded.shape)) {}

  CadModel build() {
    model_.file_unit = loaded_.file_unit;
    model_.warnings = loaded_.warnings;
    find_box();
    TopTools_IndexedMapOfShape originals;
    TopExp::MapShapes(loaded_.shape, TopAbs_FACE, originals);
    for (int i = 1; i <= originals.Extent(); ++i) model_.faces.push_back(build_face(i, TopoDS::Face(originals(i))));
    build_shells(originals);
    return std::move(model_);
  }

 private:
  void find_box() {
    const Bnd_Box box = bounding_box(prepared_.shape);
    if (box.IsVoid() || box.IsOpen()) {
      model_.warnings.push_back("the shape has no finite bounding box");
      return;
    }
    model_.lower = to_xyz(box.CornerMin());
    model_.upper = to_xyz(box.CornerMax());
  }

  int vertex_index(const TopoDS_Vertex& vertex) {
    if (vertex.IsNull()) return -1;
    const int before = vertices_.Extent();
    const int index = vertices_.Add(vertex.Oriented(TopAbs_FORWARD)) - 1;
    if (vertices_.Extent() > before)
      model_.vertices.push_back({to_xyz(BRep_Tool::Pnt(vertex)), BRep_Tool::Tolerance(vertex)});
    return index;
  }

  int edge_index(const TopoDS_Edge& any_direction) {
    const TopoDS_Edge edge = TopoDS::Edge(any_direction.Oriented(TopAbs_FORWARD));
    const int before = edges_.Extent();
    const int index = edges_.Add(edge) - 1;
    if (edges_.Extent() == before) return index;
    CadEdge made;
    double first, last;
    if (BRep_Tool::Degenerated(edge)) {
      BRep_Tool::Range(edge, first, last);
    } else {
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
      if (!curve.IsNull()) made.curve = convert_curve(curve, {first, last});
    }
    made.range = {first, last};
    made.first_vertex = vertex_index(TopExp::FirstVertex(edge));
    made.last_vertex = vertex_index(TopExp::LastVertex(edge));
    made.tolerance = BRep_Tool::Tolerance(edge);
    model_.edges.push_back(std::move(made));
    return index;
  }

  CadFace build_face(int number_from_1, const TopoDS_Face& original) {
    CadFace face;
    face.number = number_from_1;
    face.problems = prepared_.repairs[static_cast<std::size_t>(number_from_1 - 1)];
    face.reversed = original.Orientation() == TopAbs_REVERSED;
    face.tolerance = BRep_Tool::Tolerance(original);
    const auto label = loaded_.labels.find(original.TShape().get());
    if (label != loaded_.labels.end()) face.name = label->second.name, face.colour = label->second.colour;
    try {
      fill_face(prepared_.faces[static_cast<std::size_t>(number_from_1 - 1)], original, face);
    } catch (const Standard_Failure& failure) {
      reject(face, "OpenCASCADE fails on it (" + describe(failure) + ")");
    } catch (const Error& error) {
      reject(face, error.what());
    }
    return face;
  }

  static void reject(CadFace& face, const std::string& why) {
    face.surface = nullptr;
    face.loops.clear();
    face.problems.push_back(why);
  }

  void fill_face(const TopoDS_Shape& healed, const TopoDS_Face& original, CadFace& face) {
    for (std::string& problem : check_face(original)) face.problems.push_back(std::move(problem));
    // Healing may have moved the seam of the surface, so the surface is the healed face's.
    TopExp_Explorer part(healed, TopAbs_FACE);
    if (!part.More()) return reject(face, "OpenCASCADE's healing leaves nothing of it");
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(part.Current()));
    if (surface.IsNull()) return reject(face, "it has no surface");
    const double scale = std::abs(original.Location().Transformation().ScaleFactor());
    if (!(std::abs(scale - 1.0) <= kScaleRounding))
      return reject(face, "its placement scales; export it at its true size");
    face.surface = convert_surface(surface);
    face.spline = spline_facts(unwrapped(surface));
    for (; part.More(); part.Next()) {
      add_loops(extract_trims(TopoDS::Face(part.Current())), face);
    }
    if (face.loops.empty()) reject(face, "it has no border; trim it in the CAD system");
    judge_tolerances(face);
  }

  static std::optional<CadFace::SplineFacts> spline_facts(const Handle(Geom_Surface) & surface) {
    const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface);
    if (spline.IsNull()) return std::nullopt;
    return CadFace::SplineFacts{spline->UDegree(), spline->VDegree(), spline->NbUPoles(), spline->NbVPoles(),
                                spline->IsURational() || spline->IsVRational()};
  }

  void add_loops(const OccTrims& trims, CadFace& face) {
    if (trims.missing_pcurves > 0) face.problems.push_back("an edge has no curve in the parameter plane");
    if (trims.turned) face.problems.push_back("a border loop ran the wrong way and was turned round");
    for (const OccLoop& loop : trims.loops) {
      if (loop.winds) face.problems.push_back("a border loop closes only up to a period: a seam is missing");
      if (!loop.closed && !loop.winds) {
        face.problems.push_back("a border loop does not close in the parameter plane (gap " + number(loop.gap) + ")");
      }
      TrimLoop made;
      for (const OccCoedge& coedge : loop.coedges) {
        made.coedges.push_back(build_coedge(coedge));
        measure(*face.surface, made.coedges.back());
      }
      face.loops.push_back(std::move(made));
    }
  }

  Coedge build_coedge(const OccCoedge& coedge) {
    Coedge made;
    made.edge = edge_index(coedge.edge);
    made.pcurve = convert_pcurve(coedge.pcurve, {coedge.first, coedge.last});
    made.range = {coedge.first, coedge.last};
    made.reversed = coedge.reversed;
    return made;
  }

  /// Files promise more than they keep: an edge's tolerance is at least what separates its curve from the surface.
  void measure(const Surface& surface, const Coedge& coedge) {
    CadEdge& edge = model_.edges[static_cast<std::size_t>(coedge.edge)];
    if (edge.degenerate() || !coedge.pcurve) return;
    std::vector<double> stops = edge.curve->breaks(edge.range);
    const std::vector<double> more = coedge.pcurve->breaks(coedge.range);
    stops.insert(stops.end(), more.begin(), more.end());
    stops.push_back(edge.range.hi);
    std::sort(stops.begin(), stops.end());
    double from = edge.range.lo;
    for (const double to : stops) {
      const int count = stops.size() == 1 ? kSamplesAlone : kSamplesPerPiece;
      for (int i = 0; i <= count; ++i) {
        const double t = from + (to - from) * i / count;
        const Eigen::Vector2d uv = coedge.pcurve->position(t);
        const double distance = (edge.curve->position(t) - surface.position({uv.x(), uv.y()})).norm();
        edge.tolerance = std::max(edge.tolerance, distance);
      }
      from = to;
    }
  }

  void judge_tolerances(CadFace& face) const {
    double loosest = face.tolerance;
    for (const TrimLoop& loop : face.loops) {
      for (const Coedge& coedge : loop.coedges)
        loosest = std::max(loosest, model_.edges[static_cast<std::size_t>(coedge.edge)].tolerance);
    }
    if (loosest > kLooseTolerance * model_.diagonal()) {
      face.problems.push_back("its border is loose: tolerance " + number(loosest));
    }
  }

  // ---- shells ------------------------------------------------------------------------------------------------------

  void build_shells(const TopTools_IndexedMapOfShape& originals) {
    std::vector<bool> placed(model_.faces.size(), false);
    for (const TopoDS_Shape& shell : parts_of(loaded_.shape, TopAbs_SHELL)) {
      CadShell made;
      for (TopExp_Explorer face(shell, TopAbs_FACE); face.More(); face.Next()) {
        const int index = originals.FindIndex(face.Current()) - 1;
        if (index < 0 || placed[static_cast<std::size_t>(index)]) continue;
        placed[static_cast<std::size_t>(index)] = true;
        made.faces.push_back(index);
      }
      if (!made.faces.empty()) model_.shells.push_back(std::move(made));
    }
    CadShell loose;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      if (!placed[i]) loose.faces.push_back(static_cast<int>(i));
    }
    if (!loose.faces.empty()) model_.shells.push_back(std::move(loose));
    for (CadShell& shell : model_.shells) shell.closed = is_closed(shell);
  }

  bool is_closed(const CadShell& shell) const {
    std::vector<int> forward(model_.edges.size(), 0), backward(model_.edges.size(), 0);
    for (const int index : shell.faces) {
      const CadFace& face = model_.faces[static_cast<std::size_t>(index)];
      if (!face.surface) return false;
      for (const TrimLoop& loop : face.loops) {
        for (const Coedge& coedge : loop.coedges) {
          auto& uses = coedge.reversed != face.reversed ? backward : forward;
          if (!model_.edges[static_cast<std::size_t>(coedge.edge)].degenerate())
            ++uses[static_cast<std::size_t>(coedge.edge)];
        }
      }
    }
    for (std::size_t i = 0; i < forward.size(); ++i) {
      if (forward[i] != backward[i] || forward[i] > 1) return false;
    }
    return true;
  }

  const LoadedShape& loaded_;
  const PreparedShape prepared_;
  CadModel model_;
  TopTools_IndexedMapOfShape vertices_, edges_;
};

}  // namespace

CadModel build_model(const LoadedShape& loaded) { return ModelBuilder(loaded).build(); }

}  // namespace geovor::occ
