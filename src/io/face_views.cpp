#include "io/face_views.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "io/hidden_surfaces.h"
#include "io/number_text.h"
#include "io/thin_line.h"

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

constexpr int kDecimals = 1;

// A line may lie this far (page units) from where it belongs: its points are rounded to tenths already.
constexpr double kInvisible = 0.1;

void append_run(const std::vector<PagePoint>& points, PathData& path) {
  const std::vector<PagePoint> thin = thin_line(points, kInvisible);
  path.move(thin.front());
  for (size_t i = 1; i < thin.size(); ++i) path.line(thin[i]);
}

std::vector<Xyz> corners(const CellRaster& raster) {
  std::vector<Xyz> points;
  for (const CellPatch& p : raster.patches) points.insert(points.end(), p.xyz.begin(), p.xyz.end());
  return points;
}

/// The left (0) or right (1) half of the page.
PageFrame frame(const PictureSize& o, int half) {
  const double margin = kMargin * o.height;
  const double width = 0.5 * o.width - 1.5 * margin;
  return {margin + half * (width + margin), margin, width, o.height - 2.0 * margin};
}

PageFrame parameter_frame(const UvBox& box, const PageFrame& room) {
  const double ratio = std::clamp(box.u.length() / box.v.length(), kTallest, kWidest);
  const double width = std::min(room.width, room.height * ratio), height = width / ratio;
  return {room.left + 0.5 * (room.width - width), room.top + 0.5 * (room.height - height), width, height};
}

}  // namespace

FaceViews::FaceViews(const CellRaster& raster, const std::string& title, const std::string& style,
                     const PictureSize& size)
    : raster_(raster),
      size_(size),
      view_(PictureProjection::isometric(corners(raster), frame(size, 0))),
      plane_(parameter_frame(raster.box, frame(size, 1))),
      depth_(size.width, size.height) {
  for (const CellPatch& p : raster.patches) {
    for (int k = 2; k < 4; ++k) depth_.add_triangle(view_(p.xyz[0]), view_(p.xyz[k - 1]), view_(p.xyz[k]));
  }
  append_head(title, style);
}

void FaceViews::append_head(const std::string& title, const std::string& style) {
  const std::string width = std::to_string(size_.width), height = std::to_string(size_.height);
  text_ += "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
           "\" viewBox=\"0 0 " + width + ' ' + height + "\">\n<title>" + title + "</title>\n";
  text_ +=
      "<style>path{stroke-linejoin:round;stroke-linecap:round}.b,.f{fill:none;stroke:#1c2733}"
      ".f{stroke-opacity:.3;stroke-width:1}.b{stroke-width:1.3}.p path{fill:currentColor;stroke:currentColor}" +
      style + "</style>\n";
  text_ += "<rect width=\"" + width + "\" height=\"" + height + "\" fill=\"#fbfbfa\"/>\n";
}

PagePoint FaceViews::on_plane(Uv p) const {
  const double x = (p.u - raster_.box.u.lo) / raster_.box.u.length();
  const double y = (p.v - raster_.box.v.lo) / raster_.box.v.length();
  return {plane_.left + x * plane_.width, plane_.top + (1.0 - y) * plane_.height, 0.0};
}

void FaceViews::append_number(double x) { append_rounded(text_, x, kDecimals); }

void FaceViews::append_path(const PathData& path, const std::string& attributes) {
  text_ += "<path " + attributes + " d=\"" + path.text() + "\"/>\n";
}

void FaceViews::append_polygon(const std::array<PagePoint, 4>& corners, const std::string& colour) {
  if (colour != colour_) end_polygons();
  colour_ = colour;
  polygons_.move(corners[0]);
  for (int k = 1; k < 4; ++k) polygons_.line(corners[k]);
  polygons_.close();
}

void FaceViews::end_polygons() {
  if (!polygons_.empty()) append_path(polygons_, "color=\"" + colour_ + '"');
  polygons_ = {};
}

std::string FaceViews::lit_tint(const LinearColour& tint, const Xyz& normal) const {
  return to_hex(lit(tint + kPale * (LinearColour::Ones() - tint), normal, view_));
}

void FaceViews::paint(const std::function<LinearColour(int site)>& tint) {
  text_ += "<g class=\"p\" shape-rendering=\"crispEdges\">\n";  // with the strokes: no hairlines between patches
  paint_space(tint);
  end_polygons();
  paint_plane(tint);
  end_polygons();
  text_ += "</g>\n";
  append_frame();
  for (size_t i = 0; i < raster_.border.size(); ++i) {
    space_line(raster_.border[i], "b");
    plane_line(raster_.border_uv[i], "b");
  }
}

void FaceViews::paint_space(const std::function<LinearColour(int site)>& tint) {
  std::vector<PageTriangle> triangles;
  for (const CellPatch& p : raster_.patches) {
    triangles.push_back({view_(p.xyz[0]), view_(p.xyz[1]), view_(p.xyz[2])});
    triangles.push_back({view_(p.xyz[0]), view_(p.xyz[2]), view_(p.xyz[3])});
  }
  std::vector<char> painted(raster_.patches.size(), 0);
  for (int t : painting_order(triangles, size_.width, size_.height)) {
    if (painted[t / 2]) continue;
    painted[t / 2] = 1;
    const CellPatch& p = raster_.patches[t / 2];
    Xyz n = (p.xyz[2] - p.xyz[0]).cross(p.xyz[3] - p.xyz[1]);
    n = n.isZero(0.0) ? n : Xyz(n.stableNormalized());
    if (n.dot(view_.towards_viewer()) < 0.0) n = -n;
    append_polygon({view_(p.xyz[0]), view_(p.xyz[1]), view_(p.xyz[2]), view_(p.xyz[3])}, lit_tint(tint(p.site), n));
  }
}

// The rectangle of the parameters: what is no border of the face in it is a seam or a pole.
void FaceViews::append_frame() {
  const UvBox& b = raster_.box;
  PathData frame;
  frame.move(on_plane({b.u.lo, b.v.lo}));
  for (Uv p : {Uv{b.u.hi, b.v.lo}, Uv{b.u.hi, b.v.hi}, Uv{b.u.lo, b.v.hi}}) frame.line(on_plane(p));
  frame.close();
  append_path(frame, "class=\"f\"");
  text_ += "<clipPath id=\"plane\"><rect x=\"";
  append_number(plane_.left);
  text_ += "\" y=\"";
  append_number(plane_.top);
  text_ += "\" width=\"";
  append_number(plane_.width);
  text_ += "\" height=\"";
  append_number(plane_.height);
  text_ += "\"/></clipPath>\n";
}

// One path a cell: all of it has the same shade.
void FaceViews::paint_plane(const std::function<LinearColour(int site)>& tint) {
  for (const CellOutline& outline : raster_.outlines) {
    append_outline(outline, lit_tint(tint(outline.site), view_.towards_viewer()));
  }
  if (!raster_.outlines.empty()) return;
  std::vector<const CellPatch*> patches;
  for (const CellPatch& p : raster_.patches) patches.push_back(&p);
  std::stable_sort(patches.begin(), patches.end(),
                   [](const CellPatch* a, const CellPatch* b) { return a->site < b->site; });
  for (const CellPatch* p : patches) {
    append_polygon({on_plane(p->uv[0]), on_plane(p->uv[1]), on_plane(p->uv[2]), on_plane(p->uv[3])},
                   lit_tint(tint(p->site), view_.towards_viewer()));
  }
}

void FaceViews::append_outline(const CellOutline& outline, const std::string& colour) {
  PathData path;
  for (const std::vector<Uv>& loop : outline.loops) {
    std::vector<PagePoint> points;
    for (Uv p : loop) points.push_back(on_plane(p));
    points.push_back(points.front());
    points = thin_line(points, kInvisible);
    path.move(points.front());
    for (size_t i = 1; i + 1 < points.size(); ++i) path.line(points[i]);
    path.close();
  }
  append_path(path, "fill-rule=\"evenodd\" color=\"" + colour + '"');
}

void FaceViews::append_lines(const std::vector<PagePoint>& points, const std::vector<char>& shown, const char* style) {
  PathData path;
  for (size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i]) continue;
    std::vector<PagePoint> run = {points[i]};
    for (; i < shown.size() && shown[i]; ++i) run.push_back(points[i + 1]);
    append_run(run, path);
  }
  if (!path.empty()) append_path(path, std::string("class=\"") + style + '"');
}

void FaceViews::space_line(const std::vector<Xyz>& line, const char* style) {
  std::vector<PagePoint> points;
  std::vector<char> shown;
  for (const Xyz& p : line) points.push_back(view_(p));
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    shown.push_back(!depth_.hides(view_(0.5 * (line[i] + line[i + 1])), kHiddenSlack));
  }
  append_lines(points, shown, style);
}

void FaceViews::plane_line(const std::vector<Uv>& line, const char* style) {
  const UvBox& box = raster_.box;
  const auto in_box = [&](Uv p) {
    constexpr double kRounding = 1e-9;
    const double du = kRounding * box.u.length(), dv = kRounding * box.v.length();
    return p.u >= box.u.lo - du && p.u <= box.u.hi + du && p.v >= box.v.lo - dv && p.v <= box.v.hi + dv;
  };
  std::vector<PagePoint> points;
  std::vector<char> shown;
  for (Uv p : line) points.push_back(on_plane(p));
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const UvVec way = line[i + 1] - line[i];
    const bool jump =
        line.size() > 2 && (std::abs(way.u) > 0.6 * box.u.length() || std::abs(way.v) > 0.6 * box.v.length());
    shown.push_back(!jump && in_box(line[i]) && in_box(line[i + 1]));
  }
  append_lines(points, shown, style);
}

void FaceViews::plane_copies(const std::vector<Uv>& line, double u_period, double v_period, const char* style) {
  if (line.empty()) return;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  UvBox reach{{kInf, -kInf}, {kInf, -kInf}};
  for (const Uv p : line) {
    reach.u = {std::min(reach.u.lo, p.u), std::max(reach.u.hi, p.u)};
    reach.v = {std::min(reach.v.lo, p.v), std::max(reach.v.hi, p.v)};
  }
  struct Turns {
    double first, last, period;
  };
  const auto turns = [](const Interval& of, const Interval& into, double period) {
    if (!(period > 0.0)) return Turns{0.0, 0.0, 0.0};
    return Turns{std::ceil((into.lo - of.hi) / period), std::floor((into.hi - of.lo) / period), period};
  };
  const Turns in_u = turns(reach.u, raster_.box.u, u_period), in_v = turns(reach.v, raster_.box.v, v_period);
  for (double j = in_v.first; j <= in_v.last; ++j) {
    for (double i = in_u.first; i <= in_u.last; ++i) {
      std::vector<PagePoint> points;
      for (const Uv p : line) points.push_back(on_plane(p + UvVec{i * in_u.period, j * in_v.period}));
      PathData path;
      append_run(points, path);
      append_path(path, std::string("class=\"") + style + "\" clip-path=\"url(#plane)\"");
    }
  }
}

void FaceViews::append_dot(const PagePoint& p, const char* style, double radius) {
  text_ += std::string("<circle class=\"") + style + "\" cx=\"";
  append_number(p.x);
  text_ += "\" cy=\"";
  append_number(p.y);
  text_ += "\" r=\"";
  append_number(radius);
  text_ += "\"/>\n";
}

void FaceViews::space_dot(const Xyz& p, const char* style, double radius) {
  if (!depth_.hides(view_(p), kHiddenSlack)) append_dot(view_(p), style, radius);
}

void FaceViews::plane_dot(Uv p, const char* style, double radius) { append_dot(on_plane(p), style, radius); }

}  // namespace geovor
