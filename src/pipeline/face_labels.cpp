#include "pipeline/face_labels.h"

namespace geovor {

std::vector<FaceLabel> face_labels(const CadModel& model) {
  std::vector<FaceLabel> labels;
  for (const CadFace& face : model.faces) {
    FaceLabel label{face.number, face.name, {}};
    if (face.colour) label.colour = {face.colour->r, face.colour->g, face.colour->b};
    labels.push_back(std::move(label));
  }
  return labels;
}

}  // namespace geovor
