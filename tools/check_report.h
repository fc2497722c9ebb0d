// What `geovor check` found out: text for people, JSON for programs.
#pragma once

#include <string>
#include <vector>

#include "brep/model.h"
#include "io/check_picture.h"
#include "mesh/loaded_mesh.h"
#include "pipeline/check_mesh.h"

namespace geovor {

struct CheckSummary {
  std::string mesh_file;
  const LoadedMesh* loaded = nullptr;
  const CadModel* model = nullptr;
  const MeshCheck* check = nullptr;
  std::vector<std::string> warnings;
};

/// What should make one doubt that the figures mean anything: a mesh of another size than the CAD, a rounding of the
/// file that hides what was asked for, faces that can't be used.
std::vector<std::string> check_warnings(const LoadedMesh& loaded, const CadModel& model, const MeshCheck& check);

/// A line a matter (closedness, distances, angles, …), then a row a face and a row a group.
std::string check_text(const CheckSummary& summary);

/// The document of docs/FILES.md ("format": "geovor-check", "version": 1).
std::string check_json(const CheckSummary& summary);

/// The picture's sheet: the lines of check_text in short, and the worst places.
CheckSheet check_sheet(const CheckSummary& summary);

}  // namespace geovor
