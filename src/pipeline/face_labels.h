// What a CAD model says of its faces, for the writers of meshes.
#pragma once

#include <vector>

#include "brep/model.h"
#include "mesh/labelled_mesh.h"

namespace geovor {

/// Number, name and colour of every face.
std::vector<FaceLabel> face_labels(const CadModel& model);

}  // namespace geovor
