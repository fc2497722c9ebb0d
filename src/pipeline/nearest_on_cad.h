// The point of a CAD model's trimmed faces that is nearest to a point of space.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "brep/face_domain.h"
#include "brep/model.h"
#include "delaunay/surface_probe.h"
#include "mesh/nearest_boxes.h"
#include "pipeline/surface_patches.h"

namespace geovor {

struct CadPlace {
  int face = -1;  ///< index into CadModel::faces; -1: none
  Uv uv;
  Xyz foot = Xyz::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

/// One face: feet on its surface that lie in it, and the nearest points of its edges' curves.
class NearestOnFace {
 public:
  /// `precision`: a length. The border is flattened that finely, and a foot that is no farther outside of it counts as
  /// in the face. Throws Error(FaceRejected) as FaceDomain does.
  NearestOnFace(const CadModel& model, int face, double precision);

  /// Replaces `best` where the face comes nearer.
  void improve(const Xyz& x, CadPlace& best) const;

  /// The outward unit normal of the face; zero where it has none.
  Xyz normal(Uv uv) const;

  /// Whether p lies in the face, up to `precision`.
  bool contains(Uv p) const;

  const FaceDomain& domain() const { return domain_; }
  const std::vector<SurfacePatch>& patches() const { return patches_; }
  const SpaceBox& box() const { return boxes_.all(); }
  bool empty() const { return boxes_.empty(); }

  /// Nearly straight pieces of the edges' curves.
  struct BorderPiece {
    const Coedge* coedge = nullptr;
    const Curve3* curve = nullptr;
    Interval t;
  };
  const std::vector<BorderPiece>& border() const { return border_; }

 private:
  void cut_edge(const Coedge& coedge, const Curve3& curve, Interval t, double length, int halvings);
  void improve_on_patch(const SurfacePatch& patch, const Xyz& x, CadPlace& best) const;
  void improve_on_border(const BorderPiece& piece, const Xyz& x, CadPlace& best) const;

  int face_;
  double precision_;
  double side_;  ///< 1, or -1 where the outward normal is -(Su x Sv)
  FaceDomain domain_;
  SurfaceProbe probe_;
  std::vector<SurfacePatch> patches_;
  std::vector<BorderPiece> border_;
  std::vector<SpaceBox> border_boxes_;
  NearestBoxes boxes_;  ///< of the patches, then of the pieces of the border
};

/// The faces of a model. Immutable, so that any number of threads may ask. The model must outlive it.
class NearestOnCad {
 public:
  using ForEach = std::function<void(int, const std::function<void(int)>&)>;

  /// Part of the diagonal to which the borders of faces are flattened.
  static constexpr double kPrecision = 1e-6;

  NearestOnCad(const CadModel& model, const ForEach& for_each);

  CadPlace nearest(const Xyz& x) const;
  /// The nearest place of one face; face -1 where that is null (see on_face).
  CadPlace nearest(const Xyz& x, int face) const;

  const CadModel& model() const { return model_; }
  /// Null where the face can't be used.
  const NearestOnFace* on_face(int face) const { return faces_[face].get(); }
  /// Why a face can't be used; empty where it can.
  const std::string& why_not(int face) const { return why_not_[face]; }

 private:
  const CadModel& model_;
  std::vector<std::unique_ptr<NearestOnFace>> faces_;
  std::vector<std::string> why_not_;
  std::vector<int> usable_;  ///< faces, in the order of the tree's boxes
  NearestBoxes tree_;
};

}  // namespace geovor
