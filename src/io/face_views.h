// A face on one page: in space and, beside it, in its parameter domain. What diagrams and paths are drawn on.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "io/depth_map.h"
#include "io/mesh_shading.h"
#include "io/path_data.h"
#include "io/picture_projection.h"
#include "voronoi/cell_raster.h"

namespace geovor {

struct PictureSize {
  int width = 1800, height = 960;  ///< page units
};

/// A page of SVG, written from the back to the front. Lines and dots take a class of the style sheet. What is hidden in
/// space is left out. The same calls give the same bytes. REQUIRES: the raster outlives it.
class FaceViews {
 public:
  /// `style`: rules of the style sheet; class "b" is the border of the face, "f" the frame of the parameter domain.
  FaceViews(const CellRaster& raster, const std::string& title, const std::string& style, const PictureSize& size);

  /// Patches in space and outlines in the plane, tinted by their site, then the frame and the border.
  void paint(const std::function<LinearColour(int site)>& tint);

  void space_line(const std::vector<Xyz>& line, const char* style);
  /// Across a seam the values jump, or run on out of the rectangle: there the pen is lifted.
  void plane_line(const std::vector<Uv>& line, const char* style);
  /// The same line moved by whole periods (0: none) into the rectangle as often as needed, and cut off at its sides.
  void plane_copies(const std::vector<Uv>& line, double u_period, double v_period, const char* style);

  void space_dot(const Xyz& p, const char* style, double radius);
  void plane_dot(Uv p, const char* style, double radius);

  std::string finish() { return text_ + "</svg>\n"; }

 private:
  PagePoint on_plane(Uv p) const;
  void append_head(const std::string& title, const std::string& style);
  void append_number(double x);
  void append_path(const PathData& path, const std::string& attributes);
  /// Polygons of one colour in a row are one path: text_ has it only from end_polygons() on.
  void append_polygon(const std::array<PagePoint, 4>& corners, const std::string& colour);
  void end_polygons();
  /// The pieces i to i + 1 that are shown.
  void append_lines(const std::vector<PagePoint>& points, const std::vector<char>& shown, const char* style);
  void append_dot(const PagePoint& p, const char* style, double radius);
  std::string lit_tint(const LinearColour& tint, const Xyz& normal) const;
  void paint_space(const std::function<LinearColour(int site)>& tint);
  void paint_plane(const std::function<LinearColour(int site)>& tint);
  void append_outline(const CellOutline& outline, const std::string& colour);
  void append_frame();

  const CellRaster& raster_;
  PictureSize size_;
  PictureProjection view_;
  PageFrame plane_;
  DepthMap depth_;
  PathData polygons_;
  std::string colour_;  ///< of polygons_
  std::string text_;
};

}  // namespace geovor
