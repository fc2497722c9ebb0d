// A distance with its shortest paths as JSON ("format": "geovor-distance", "version": 1); docs/FILES.md names the
// members.
#pragma once

#include <string>

#include "document.h"
#include "pipeline/distance_face.h"

namespace geovor {

/// The whole document. The same distance gives the same bytes.
std::string distance_json(const DocumentSource& source, const FaceDistance& distance);

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_distance_json(const DocumentSource& source, const FaceDistance& distance, const std::string& path);

}  // namespace geovor
