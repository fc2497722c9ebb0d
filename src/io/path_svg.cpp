#include "io/path_svg.h"

#include "io/atomic_file.h"

namespace geovor {
namespace {

const char* const kStyle =
    ".p,.o{fill:none;stroke:#b3202c;stroke-width:3}.o{stroke-dasharray:2 8}"
    ".s{fill:#b3202c;stroke:#fff;stroke-width:1.2}.t{fill:#fff;stroke:#b3202c;stroke-width:3}"
    ".x{fill:#fff;stroke:#1c2733;stroke-width:2}";

constexpr double kEndRadius = 6.0, kExitRadius = 4.0;

void draw_dot(const PathPicture::Dot& dot, const char* style, double radius, FaceViews& views) {
  views.space_dot(dot.xyz, style, radius);
  views.plane_dot(dot.uv, style, radius);
}

}  // namespace

std::string path_svg(const PathPicture& picture, const PictureSize& size) {
  FaceViews views(picture.face, "Shortest path on a face", kStyle, size);
  views.paint([](int) { return plain_tint(); });
  for (const PathPicture::Line& line : picture.lines) {
    const char* style = line.on_face ? "p" : "o";
    views.space_line(line.xyz, style);
    views.plane_copies(line.uv, picture.u_period.value_or(0.0), picture.v_period.value_or(0.0), style);
  }
  draw_dot(picture.from, "s", kEndRadius, views);
  draw_dot(picture.to, "t", kEndRadius, views);
  for (const PathPicture::Dot& exit : picture.exits) draw_dot(exit, "x", kExitRadius, views);
  return views.finish();
}

void write_path_svg(const PathPicture& picture, const std::string& path, const PictureSize& size) {
  write_file(path, path_svg(picture, size));
}

}  // namespace geovor
