#include "io/diagram_svg.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "io/atomic_file.h"
#include "io/depth_map.h"
#include "io/hidden_surfaces.h"
#include "io/mesh_shading.h"
#include "io/number_text.h"
#include "io/picture_projection.h"

namespace geovor {
namespace {

// Of the page's height, around each of the two views.
constexpr double kMargin = 0.08;

// A line on the surface is hidden only by what lies clearly in front of it (page units).
constexpr double kHiddenSlack = 6.0;

// The parameter view keeps the rectangle's shape within these ratios of width to height.
constexpr double kTallest = 0.5, kWidest = 2.0;

// How far the tints of the cells are moved towards white.
constexpr double kPale = 0.45;

constexpr int kDecimals = 2;

class DiagramPicture {
 public:
  DiagramPicture(const VoronoiDiagram& diagram, const DualGraph& dual, const CellRaster& raster,
                 const DiagramPictureOptions& options)
      : diagram_(diagram),
        dual_(dual),
        raster_(raster),
        options_(options),
        view_(PictureProjection::isometric(corners(raster), frame(options, 0))),
        plane_(parameter_frame(raster.box, frame(options, 1))),
        depth_(options.width, options.height) {
    for (const CellPatch& p : raster.patches) {
      for (int k = 2; k < 4; ++k) depth_.add_triangle(view_(p.xyz[0]), view_(p.xyz[k - 1]), view_(p.xyz[k]));
    }
  }

  std::string svg() {
    append_head();
    text_ += "<g shape-rendering=\"crispEdges\">\n";  // with the strokes: no hairlines between patches
    append_space_patches();
    append_plane_patches();
    text_ += "</g>\n";
    append_plane_frame();
    for (size_t i = 0; i < raster_.border.size(); ++i) {
      append_space_line(raster_.border[i], "b");
      append_plane_line(raster_.border_uv[i], "b");
    }
    for (const DualEdge& e : dual_.edges) {
      append_space_line(e.path, "d");
      append_plane_line(e.path_uv, "d");
    }
    for (const DiagramEdge& e : diagram_.edges) append_edge(e);
    for (const DiagramSite& s : diagram_.sites) append_site(s);
    return text_ + "</svg>\n";
  }

 private:
  static std::vector<Xyz> corners(const CellRaster& raster) {
    std::vector<Xyz> points;
    for (const CellPatch& p : raster.patches) points.insert(points.end(), p.xyz.begin(), p.xyz.end());
    return points;
  }

  /// The left (0) or right (1) half of the page.
  static PageFrame frame(const DiagramPictureOptions& o, int half) {
    const double margin = kMargin * o.height;
    const double width = 0.5 * o.width - 1.5 * margin;
    return {margin + half * (width + margin), margin, width, o.height - 2.0 * margin};
  }

  static PageFrame parameter_frame(const UvBox& box, const PageFrame& room) {
    const double ratio = std::clamp(box.u.length() / box.v.length(), kTallest, kWidest);
    const double width = std::min(room.width, room.height * ratio), height = width / ratio;
    return {room.left + 0.5 * (room.width - width), room.top + 0.5 * (room.height - height), width, height};
  }

  PagePoint on_plane(Uv p) const {
    const double x = (p.u - raster_.box.u.lo) / raster_.box.u.length();
    const double y = (p.v - raster_.box.v.lo) / raster_.box.v.length();
    return {plane_.left + x * plane_.width, plane_.top + (1.0 - y) * plane_.height, 0.0};
  }

  void append_point(char command, const PagePoint& p) {
    text_ += command;
    append_rounded(text_, p.x, kDecimals);
    text_ += ' ';
    append_rounded(text_, p.y, kDecimals);
  }

  void append_head();
  void append_space_patches();
  void append_plane_patches();
  void append_plane_frame();
  void append_polygon(const std::array<PagePoint, 4>& corners, const std::string& fill);
  std::string tint(int site, const Xyz& normal) const;
  void append_space_line(const std::vector<Xyz>& line, const char* style);
  void append_plane_line(const std::vector<Uv>& line, const char* style);
  void append_edge(const DiagramEdge& e);
  void append_site(const DiagramSite& s);
  void append_dot(const PagePoint& p);

  const VoronoiDiagram& diagram_;
  const DualGraph& dual_;
  const CellRaster& raster_;
  DiagramPictureOptions options_;
  PictureProjection view_;
  PageFrame plane_;
  DepthMap depth_;
  std::string text_;
};

void DiagramPicture::append_head() {
  const std::string width = std::to_string(options_.width), height = std::to_string(options_.height);
  text_ += "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
           "\" viewBox=\"0 0 " + width + ' ' + height + "\">\n<title>Geodesic Voronoi diagram of " +
           std::to_string(diagram_.sites.size()) + " sites</title>\n";
  text_ +=
      "<style>path{stroke-linejoin:round;stroke-linecap:round}.e,.c,.b,.d,.f{fill:none}"
      ".f{stroke:#1c2733;stroke-opacity:.3;stroke-width:1}.e{stroke:#1c2733;stroke-width:2.2}.c{stroke:#1c2733;stroke-"
      "width:1.6;stroke-dasharray:1 5}"
      ".b{stroke:#1c2733;stroke-width:1.3}.d{stroke:#1c2733;stroke-opacity:.45;stroke-width:.9;stroke-dasharray:6 5}"
      "circle{fill:#1c2733;stroke:#fff;stroke-width:1.2}</style>\n";
  text_ += "<rect width=\"" + width + "\" height=\"" + height + "\" fill=\"#fbfbfa\"/>\n";
}

std::string DiagramPicture::tint(int site, const Xyz& normal) const {
  const LinearColour colour = face_tint(site);
  return to_hex(lit(colour + kPale * (LinearColour::Ones() - colour), normal, view_));
}

void DiagramPicture::append_polygon(const std::array<PagePoint, 4>& corners, const std::string& fill) {
  text_ += "<path d=\"";
  for (int k = 0; k < 4; ++k) append_point(k == 0 ? 'M' : 'L', corners[k]);
  text_ += "Z\" fill=\"" + fill + "\" stroke=\"" + fill + "\"/>\n";
}

void DiagramPicture::append_space_patches() {
  std::vector<PageTriangle> triangles;
  for (const CellPatch& p : raster_.patches) {
    triangles.push_back({view_(p.xyz[0]), view_(p.xyz[1]), view_(p.xyz[2])});
    triangles.push_back({view_(p.xyz[0]), view_(p.xyz[2]), view_(p.xyz[3])});
  }
  std::vector<char> painted(raster_.patches.size(), 0);
  for (int t : painting_order(triangles, options_.width, options_.height)) {
    if (painted[t / 2]) continue;
    painted[t / 2] = 1;
    const CellPatch& p = raster_.patches[t / 2];
    Xyz n = (p.xyz[2] - p.xyz[0]).cross(p.xyz[3] - p.xyz[1]);
    n = n.isZero(0.0) ? n : Xyz(n.stableNormalized());
    if (n.dot(view_.towards_viewer()) < 0.0) n = -n;
    append_polygon({view_(p.xyz[0]), view_(p.xyz[1]), view_(p.xyz[2]), view_(p.xyz[3])}, tint(p.site, n));
  }
}

// The rectangle of the parameters: what is no border of the face in it is a seam or a pole.
void DiagramPicture::append_plane_frame() {
  const UvBox& b = raster_.box;
  text_ += "<path class=\"f\" d=\"";
  append_point('M', on_plane({b.u.lo, b.v.lo}));
  append_point('L', on_plane({b.u.hi, b.v.lo}));
  append_point('L', on_plane({b.u.hi, b.v.hi}));
  append_point('L', on_plane({b.u.lo, b.v.hi}));
  text_ += "Z\"/>\n";
}

// One polygon a run of patches of the same cell in a row.
void DiagramPicture::append_plane_patches() {
  for (size_t i = 0; i < raster_.patches.size();) {
    size_t last = i;
    const auto joins = [&](const CellPatch& a, const CellPatch& b) {
      return a.site == b.site && a.uv[1] == b.uv[0] && a.uv[2] == b.uv[3];
    };
    while (last + 1 < raster_.patches.size() && joins(raster_.patches[last], raster_.patches[last + 1])) ++last;
    const CellPatch &a = raster_.patches[i], &b = raster_.patches[last];
    append_polygon({on_plane(a.uv[0]), on_plane(b.uv[1]), on_plane(b.uv[2]), on_plane(a.uv[3])},
                   tint(a.site, view_.towards_viewer()));
    i = last + 1;
  }
}

void DiagramPicture::append_space_line(const std::vector<Xyz>& line, const char* style) {
  bool drawing = false, any = false;
  std::string before = text_;
  text_ += std::string("<path class=\"") + style + "\" d=\"";
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const bool hidden = depth_.hides(view_(0.5 * (line[i] + line[i + 1])), kHiddenSlack);
    if (!hidden && !drawing) append_point('M', view_(line[i]));
    if (!hidden) append_point('L', view_(line[i + 1]));
    drawing = !hidden;
    any = any || drawing;
  }
  text_ += "\"/>\n";
  if (!any) text_ = std::move(before);
}

// Across a seam the values jump, or run on out of the rectangle: there the pen is lifted.
void DiagramPicture::append_plane_line(const std::vector<Uv>& line, const char* style) {
  const UvBox& box = raster_.box;
  const auto in_box = [&](Uv p) {
    constexpr double kRounding = 1e-9;
    const double du = kRounding * box.u.length(), dv = kRounding * box.v.length();
    return p.u >= box.u.lo - du && p.u <= box.u.hi + du && p.v >= box.v.lo - dv && p.v <= box.v.hi + dv;
  };
  std::string path;
  path.swap(text_);
  bool drawing = false;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const UvVec way = line[i + 1] - line[i];
    const bool jump =
        line.size() > 2 && (std::abs(way.u) > 0.6 * box.u.length() || std::abs(way.v) > 0.6 * box.v.length());
    const bool shown = !jump && in_box(line[i]) && in_box(line[i + 1]);
    if (shown && !drawing) append_point('M', on_plane(line[i]));
    if (shown) append_point('L', on_plane(line[i + 1]));
    drawing = shown;
  }
  path.swap(text_);
  if (!path.empty()) text_ += std::string("<path class=\"") + style + "\" d=\"" + path + "\"/>\n";
}

void DiagramPicture::append_edge(const DiagramEdge& e) {
  const char* style = e.kind == EdgeKind::CutLocus ? "c" : "e";
  std::vector<Xyz> space;
  std::vector<Uv> plane;
  for (const EdgePoint& p : e.points) {
    space.push_back(p.xyz);
    plane.push_back(p.uv);
  }
  append_space_line(space, style);
  append_plane_line(plane, style);
}

void DiagramPicture::append_dot(const PagePoint& p) {
  text_ += "<circle cx=\"";
  append_rounded(text_, p.x, kDecimals);
  text_ += "\" cy=\"";
  append_rounded(text_, p.y, kDecimals);
  text_ += diagram_.sites.size() > 200 ? "\" r=\"2\"/>\n" : "\" r=\"4\"/>\n";
}

void DiagramPicture::append_site(const DiagramSite& s) {
  if (!depth_.hides(view_(s.xyz), kHiddenSlack)) append_dot(view_(s.xyz));
  append_dot(on_plane(s.uv));
}

}  // namespace

std::string diagram_svg(const VoronoiDiagram& diagram, const DualGraph& dual, const CellRaster& raster,
                        const DiagramPictureOptions& options) {
  return DiagramPicture(diagram, dual, raster, options).svg();
}

void write_diagram_svg(const VoronoiDiagram& diagram, const DualGraph& dual, const CellRaster& raster,
                       const std::string& path, const DiagramPictureOptions& options) {
  write_file(path, diagram_svg(diagram, dual, raster, options));
}

}  // namespace geovor
