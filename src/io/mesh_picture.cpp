#include "io/mesh_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "io/atomic_file.h"
#include "io/hidden_surfaces.h"
#include "io/mesh_shading.h"
#include "io/number_text.h"
#include "io/picture_projection.h"

namespace geovor {
namespace {

/// Of the page, on each side.
constexpr double kMargin = 0.07;
/// Sides of triangles are drawn where there are at most this many triangles to see: with more they would be closer than
/// some three units on the default page and turn the picture black.
constexpr std::size_t kMostOutlined = 60000;

/// A side of a triangle, from its corner `corner` to the next.
struct Side {
  int lo, hi, triangle, corner;
};

class MeshPicture {
 public:
  MeshPicture(const TriangleMesh& mesh, const PictureOptions& options)
      : mesh_(mesh), options_(options), view_(PictureProjection::isometric(mesh.points, frame(options))) {
    for (const Xyz& p : mesh.points) page_.push_back(view_(p));
  }

  std::string svg();

 private:
  static PageFrame frame(const PictureOptions& o) {
    const double margin = kMargin * std::min(o.width, o.height);
    return {margin, margin, o.width - 2 * margin, o.height - 2 * margin};
  }
  PageTriangle on_page(const std::array<int, 3>& t) const { return {page_[t[0]], page_[t[1]], page_[t[2]]}; }
  Xyz normal(int t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Xyz n = (mesh_.points[b] - mesh_.points[a]).cross(mesh_.points[c] - mesh_.points[a]);
    return n.isZero(0.0) ? n : Xyz(n.stableNormalized());
  }
  std::vector<std::array<bool, 3>> strong_sides() const;
  void append_head(std::string& svg) const;
  void append_shadow(std::string& svg) const;
  void append_point(std::string& svg, char command, int point) const;
  void append_triangle(std::string& svg, int t, const std::array<bool, 3>& strong) const;

  const TriangleMesh& mesh_;
  const PictureOptions& options_;
  PictureProjection view_;
  std::vector<PagePoint> page_;
  bool lines_ = true;  ///< otherwise each triangle's side has its own colour, which closes the hairlines between them
};

/// For each triangle, which of its sides (from corner k to k + 1) are border, limit of a CAD face, or outline.
std::vector<std::array<bool, 3>> MeshPicture::strong_sides() const {
  std::vector<Side> sides;
  for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [lo, hi] = std::minmax(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]);
      sides.push_back({lo, hi, t, k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array{a.lo, a.hi, a.triangle} < std::array{b.lo, b.hi, b.triangle};
  });
  std::vector<std::array<bool, 3>> strong(mesh_.triangles.size(), {false, false, false});
  const auto faces_viewer = [&](int t) { return normal(t).dot(view_.towards_viewer()) > 0.0; };
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last =
        std::find_if(first, sides.end(), [&](const Side& s) { return s.lo != first->lo || s.hi != first->hi; });
    const int a = first->triangle, b = (last - 1)->triangle;
    const bool plain = last - first == 2 && mesh_.face_of[a] == mesh_.face_of[b] && faces_viewer(a) == faces_viewer(b);
    for (; first != last; ++first) strong[first->triangle][first->corner] = !plain;
  }
  return strong;
}

void MeshPicture::append_head(std::string& svg) const {
  const std::string width = std::to_string(options_.width), height = std::to_string(options_.height);
  svg += "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height + "\" viewBox=\"0 0 " +
         width + ' ' + height + "\">\n<title>" + std::to_string(mesh_.triangles.size()) + " triangles</title>\n";
  svg +=
      "<defs>\n"
      "<linearGradient id=\"sky\" x1=\"0\" y1=\"0\" x2=\"0\" y2=\"1\">"
      "<stop offset=\"0\" stop-color=\"#f7f8fa\"/><stop offset=\"1\" stop-color=\"#dde1e6\"/></linearGradient>\n"
      "<radialGradient id=\"shadow\"><stop offset=\"0.2\" stop-color=\"#20262e\" stop-opacity=\"0.16\"/>"
      "<stop offset=\"1\" stop-color=\"#20262e\" stop-opacity=\"0\"/></radialGradient>\n"
      "</defs>\n"
      "<rect width=\"" +
      width + "\" height=\"" + height + "\" fill=\"url(#sky)\"/>\n";
}

/// A soft disc on the ground under the model, which says where down is.
void MeshPicture::append_shadow(std::string& svg) const {
  if (mesh_.points.empty()) return;
  Xyz lower = mesh_.points.front(), upper = lower;
  for (const Xyz& p : mesh_.points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  constexpr double kShadow = 0.85;  // of half the diagonal of the footprint
  const double radius = kShadow * 0.5 * view_.scale() * (upper - lower).head<2>().norm();
  const PagePoint centre = view_({0.5 * (lower.x() + upper.x()), 0.5 * (lower.y() + upper.y()), lower.z()});
  const double values[] = {centre.x, centre.y, radius, radius * view_.towards_viewer().z()};
  const char* names[] = {"cx", "cy", "rx", "ry"};
  svg += "<ellipse";
  for (int i = 0; i < 4; ++i) {
    svg += std::string(" ") + names[i] + "=\"";
    append_rounded(svg, values[i], 1);
    svg += '"';
  }
  svg += " fill=\"url(#shadow)\"/>\n";
}

void MeshPicture::append_point(std::string& svg, char command, int point) const {
  constexpr int kDecimals = 2;
  svg += command;
  append_rounded(svg, page_[point].x, kDecimals);
  svg += ' ';
  append_rounded(svg, page_[point].y, kDecimals);
}

void MeshPicture::append_triangle(std::string& svg, int t, const std::array<bool, 3>& strong) const {
  const auto& corners = mesh_.triangles[t];
  Xyz n = normal(t);
  if (n.dot(view_.towards_viewer()) < 0.0) n = -n;  // the inner side of an open shell is lit like the outer one
  const LinearColour tint = options_.colour_by_face ? face_tint(mesh_.face_of[t]) : plain_tint();
  const std::string fill = to_hex(lit(tint, n, view_));
  svg += "<path d=\"";
  for (int k = 0; k < 3; ++k) append_point(svg, k == 0 ? 'M' : 'L', corners[k]);
  svg += "Z\" fill=\"" + fill + '"';
  if (!lines_) svg += " stroke=\"" + fill + '"';
  svg += "/>\n";
  if (std::none_of(strong.begin(), strong.end(), [](bool s) { return s; })) return;
  svg += "<path class=\"s\" d=\"";
  for (int k = 0; k < 3; ++k) {
    if (!strong[k]) continue;
    append_point(svg, 'M', corners[k]);
    append_point(svg, 'L', corners[(k + 1) % 3]);
  }
  svg += "\"/>\n";
}

std::string MeshPicture::svg() {
  std::vector<PageTriangle> triangles;
  for (const auto& t : mesh_.triangles) triangles.push_back(on_page(t));
  const std::vector<int> order = painting_order(triangles, options_.width, options_.height);
  std::string svg;
  append_head(svg);
  append_shadow(svg);
  lines_ = options_.lines && order.size() <= kMostOutlined;
  svg += "<style>.s{fill:none;stroke:#1c2733;stroke-opacity:1;stroke-width:1.4;stroke-linecap:round}</style>\n";
  svg += "<g stroke-width=\"0.6\" stroke-linejoin=\"round\"";
  if (lines_) svg += " stroke=\"#1c2733\" stroke-opacity=\"0.55\"";
  svg += ">\n";
  const std::vector<std::array<bool, 3>> strong = strong_sides();
  for (const int t : order) append_triangle(svg, t, strong[t]);
  return svg + "</g>\n</svg>\n";
}

}  // namespace

std::string mesh_picture(const TriangleMesh& mesh, const PictureOptions& options) {
  return MeshPicture(mesh, options).svg();
}

void write_mesh_picture(const TriangleMesh& mesh, const std::string& path, const PictureOptions& options) {
  write_file(path, mesh_picture(mesh, options));
}

}  // namespace geovor
