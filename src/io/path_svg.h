// Paths on a face as a picture: in space and, beside it, in the parameter domain.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/face_views.h"

namespace geovor {

struct PathPicture {
  struct Dot {
    Uv uv;
    Xyz xyz;
  };
  struct Line {
    std::vector<Uv> uv;  ///< runs on across seams
    std::vector<Xyz> xyz;
    bool on_face = true;
  };
  CellRaster face;
  std::optional<double> u_period, v_period;
  std::vector<Line> lines;
  Dot from, to;
  std::vector<Dot> exits;  ///< where paths leave the face
};

/// The face pale, paths as strong lines (dashed where they are off the face), a full dot where they start and an open
/// one where they end, small ones where they leave the face. The same picture gives the same bytes.
std::string path_svg(const PathPicture& picture, const PictureSize& size = {});

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_path_svg(const PathPicture& picture, const std::string& path, const PictureSize& size = {});

}  // namespace geovor
