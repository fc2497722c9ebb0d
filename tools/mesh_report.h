// What `geovor mesh` says of its work: a table for people, JSON for programs.
#pragma once

#include <string>

#include "brep/model.h"
#include "mesh/mesh_checks.h"
#include "options.h"
#include "pipeline/mesh_model.h"

namespace geovor {

/// Everything that is known once the mesh is made.
struct MeshSummary {
  const CadModel* model = nullptr;
  const MeshArguments* arguments = nullptr;
  const MeshResult* result = nullptr;
  MeshTopology topology;
  MeshQuality quality;
  int faces_meshed = 0, faces_partial = 0, faces_rejected = 0;
  double mesh_area = 0.0;  ///< of the faces that have triangles
  double face_area = 0.0;  ///< of the same faces, by quadrature on the surfaces
  double largest_distance = 0.0;
  int small_away_from_corners = 0;  ///< triangles below 30 degrees that no sharp corner of the CAD asks for
  double seconds_read = 0.0, seconds_checks = 0.0, seconds_write = 0.0;

  bool complete() const { return faces_partial == 0 && faces_rejected == 0; }
};

MeshSummary summarize(const CadModel& model, const MeshArguments& arguments, const MeshResult& result);

/// A few lines for stdout.
std::string summary_text(const MeshSummary& summary);

/// The document that --report writes ("format": "geovor-mesh-report", "version": 1).
std::string report_json(const MeshSummary& summary);

}  // namespace geovor
