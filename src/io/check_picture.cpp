#include "io/check_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "io/hidden_surfaces.h"
#include "io/mesh_shading.h"
#include "io/number_text.h"
#include "io/picture_projection.h"

namespace geovor {
namespace {

// The sheet: the whole mesh on the left with the facts under it, panels on the right, page units.
constexpr int kWidth = 1600, kHeight = 1180;
constexpr double kMargin = 40, kTop = 70, kOverviewWidth = 760, kOverviewHeight = 600, kFactsTop = 730, kFactStep = 24,
                 kFactName = 120;
constexpr double kPanelLeft = 830, kPanelWidth = 360, kPanelHeight = 350, kPanelGap = 20, kCaptionHeight = 46;
constexpr std::size_t kMostPanels = 6, kPanelColumns = 2;
/// A panel shows so many times the size of what it is about.
constexpr double kAround = 3.0;
/// Sides of triangles are drawn where there are at most so many to see.
constexpr std::size_t kMostOutlined = 30000;

void append(std::string& svg, double x) { append_rounded(svg, x, 2); }

std::string number(double x) {
  std::string text;
  append(text, x);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

/// From pale blue over yellow to red, in linear light; k from 0 to 1.
LinearColour distance_tint(double k) {
  static const LinearColour kStops[] = {{0.50, 0.66, 0.80}, {0.72, 0.80, 0.62}, {0.95, 0.62, 0.12}, {0.75, 0.06, 0.04}};
  const double at = 3.0 * std::clamp(k, 0.0, 1.0);
  const int i = std::min(static_cast<int>(at), 2);
  return kStops[i] + (at - i) * (kStops[i + 1] - kStops[i]);
}

class Sheet {
 public:
  Sheet(const TriangleMesh& mesh, const CheckSheet& sheet) : mesh_(mesh), sheet_(sheet) {
    for (const double d : sheet.distance) largest_ = std::max(largest_, d);
  }

  std::string svg();

 private:
  Xyz normal(int t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Xyz n = (mesh_.points[b] - mesh_.points[a]).cross(mesh_.points[c] - mesh_.points[a]);
    return n.isZero(0.0) ? n : Xyz(n.stableNormalized());
  }
  void text(double x, double y, const char* style, const std::string& words) {
    svg_ +=
        "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" class=\"" + style + "\">" + escaped(words) + "</text>\n";
  }
  void overview();
  void legend();
  void panel(const CheckPlace& place, double left, double top);
  void paint(const PictureProjection& view, const std::vector<int>& triangles, const std::vector<int>& marked,
             double width, double height);
  double size_of(const CheckPlace& place) const;
  void line(const PictureProjection& view, const std::vector<Xyz>& points);

  const TriangleMesh& mesh_;
  const CheckSheet& sheet_;
  double largest_ = 0.0;
  std::string svg_;
};

// In a group of its own, whose origin is the upper left corner of the part of the page.
void Sheet::paint(const PictureProjection& view, const std::vector<int>& triangles, const std::vector<int>& marked,
                  double width, double height) {
  std::vector<PageTriangle> page;
  for (const int t : triangles) {
    const auto& [a, b, c] = mesh_.triangles[t];
    page.push_back({view(mesh_.points[a]), view(mesh_.points[b]), view(mesh_.points[c])});
  }
  const std::vector<int> order = painting_order(page, static_cast<int>(width), static_cast<int>(height));
  const bool outlined = order.size() <= kMostOutlined;
  svg_ += outlined ? "<g class=\"o\">\n" : "<g>\n";
  for (const int i : order) {
    const int t = triangles[i];
    Xyz n = normal(t);
    if (n.dot(view.towards_viewer()) < 0.0) n = -n;
    const double k = largest_ > 0.0 ? sheet_.distance[t] / largest_ : 0.0;
    const std::string fill = to_hex(lit(distance_tint(k), n, view));
    svg_ += "<path d=\"";
    for (int c = 0; c < 3; ++c) {
      svg_ += c == 0 ? 'M' : 'L';
      append(svg_, page[i][c].x);
      svg_ += ' ';
      append(svg_, page[i][c].y);
    }
    svg_ += "Z\" fill=\"" + fill + '"';
    if (!outlined) svg_ += " stroke=\"" + fill + '"';
    svg_ += "/>\n";
  }
  svg_ += "</g>\n";
  for (const int t : marked) {
    const auto& [a, b, c] = mesh_.triangles[t];
    line(view, {mesh_.points[a], mesh_.points[b], mesh_.points[c], mesh_.points[a]});
  }
}

void Sheet::line(const PictureProjection& view, const std::vector<Xyz>& points) {
  svg_ += "<path class=\"m\" d=\"";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PagePoint p = view(points[i]);
    svg_ += i == 0 ? 'M' : 'L';
    append(svg_, p.x);
    svg_ += ' ';
    append(svg_, p.y);
  }
  svg_ += "\"/>\n";
}

void Sheet::overview() {
  constexpr double kInset = 20;
  const PictureProjection view = PictureProjection::isometric(
      mesh_.points, {kInset, kInset, kOverviewWidth - 2 * kInset, kOverviewHeight - 2 * kInset});
  std::vector<int> all(mesh_.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<int>(t);
  svg_ += "<g transform=\"translate(" + number(kMargin) + ' ' + number(kTop) + ")\">\n";
  paint(view, all, {}, kOverviewWidth, kOverviewHeight);
  for (std::size_t i = 0; i < std::min(sheet_.places.size(), kMostPanels); ++i) {
    const PagePoint p = view(sheet_.places[i].at);
    svg_ += "<circle class=\"m\" r=\"9\" cx=\"" + number(p.x) + "\" cy=\"" + number(p.y) + "\"/>\n";
    // To the right and to the left in turn: two places may be one.
    text(i % 2 == 0 ? p.x + 12 : p.x - 22, p.y + 5, "n", std::to_string(i + 1));
  }
  svg_ += "</g>\n";
  legend();
}

void Sheet::legend() {
  constexpr int kSteps = 40;
  constexpr double kLeft = 60, kY = 682, kStep = 5, kTall = 12;
  for (int i = 0; i < kSteps; ++i) {
    svg_ += "<rect x=\"" + number(kLeft + kStep * i) + "\" y=\"" + number(kY) + "\" width=\"" + number(kStep) +
            "\" height=\"" + number(kTall) + "\" fill=\"" + to_hex(distance_tint((i + 0.5) / kSteps)) + "\"/>\n";
  }
  std::string words = "distance from the CAD: 0 to ";
  // Three digits say enough beside a bar of colours.
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.3g", largest_);
  text(kLeft + kStep * kSteps + 12, kY + kTall - 1, "c", words + digits + " " + sheet_.distance_unit);
}

/// The radius of what the place is about.
double Sheet::size_of(const CheckPlace& place) const {
  double size = 0.0;
  const auto include = [&](const Xyz& p) { size = std::max(size, (p - place.at).norm()); };
  for (const int t : place.triangles) {
    for (const int p : mesh_.triangles[t]) include(mesh_.points[p]);
  }
  for (const auto& points : place.lines) {
    for (const Xyz& p : points) include(p);
  }
  return size;
}

void Sheet::panel(const CheckPlace& place, double left, double top) {
  const double radius = kAround * size_of(place), height = kPanelHeight - kCaptionHeight;
  std::vector<int> near;
  for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int p : mesh_.triangles[t]) nearest = std::min(nearest, (mesh_.points[p] - place.at).norm());
    if (nearest <= 2.0 * radius) near.push_back(t);
  }
  std::vector<Xyz> frame;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-radius, radius}) frame.push_back(place.at + side * Xyz::Unit(axis));
  }
  // Oblique to the surface, so that a way straight off it has length on the page.
  const Xyz usual = Xyz(1.0, -1.0, 1.0).normalized();
  Xyz towards = place.normal.squaredNorm() > 0.0 ? Xyz(place.normal + 0.7 * usual) : usual;
  towards = towards.squaredNorm() > 0.01 ? towards.normalized() : usual;
  const PictureProjection view = PictureProjection::from(towards, frame, {0, 0, kPanelWidth, height});
  const std::string clip = "p" + number(left) + "-" + number(top);
  svg_ += "<g transform=\"translate(" + number(left) + ' ' + number(top) + ")\">\n<clipPath id=\"" + clip +
          "\"><rect width=\"" + number(kPanelWidth) + "\" height=\"" + number(height) +
          "\"/></clipPath>\n<rect width=\"" + number(kPanelWidth) + "\" height=\"" + number(height) +
          "\" fill=\"#f4f5f7\" stroke=\"#b8bec6\"/>\n<g clip-path=\"url(#" + clip + ")\">\n";
  paint(view, near, place.triangles, kPanelWidth, height);
  for (const auto& points : place.lines) line(view, points);
  svg_ += "</g>\n";
  text(4, height + 18, "b", place.title);
  text(4, height + 38, "c", place.caption);
  svg_ += "</g>\n";
}

std::string Sheet::svg() {
  const std::string size = "width=\"" + std::to_string(kWidth) + "\" height=\"" + std::to_string(kHeight) + "\"";
  svg_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + " viewBox=\"0 0 " + std::to_string(kWidth) + ' ' +
         std::to_string(kHeight) + "\">\n<title>" + escaped(sheet_.title) +
         "</title>\n<style>"
         "text{font-family:sans-serif;fill:#1c2733}.t{font-size:24px}.f{font-size:14px;font-family:monospace;white-"
         "space:pre}"
         ".b{font-size:15px;font-weight:bold}.c{font-size:13px}.n{font-size:15px;font-weight:bold;fill:#b4005a}"
         ".o{stroke:#1c2733;stroke-opacity:.5;stroke-width:.6;stroke-linejoin:round}"
         ".m{fill:none;stroke:#b4005a;stroke-width:2;stroke-linejoin:round}</style>\n<rect " +
         size + " fill=\"#ffffff\"/>\n";
  text(kMargin, 44, "t", sheet_.title);
  overview();
  for (std::size_t i = 0; i < sheet_.facts.size(); ++i) {
    const double y = kFactsTop + kFactStep * static_cast<double>(i);
    text(kMargin, y, "b", sheet_.facts[i].name);
    text(kMargin + kFactName, y, "c", sheet_.facts[i].value);
  }
  for (std::size_t i = 0; i < std::min(sheet_.places.size(), kMostPanels); ++i) {
    CheckPlace place = sheet_.places[i];
    place.title = std::to_string(i + 1) + "  " + place.title;
    const auto column = static_cast<double>(i % kPanelColumns), row = static_cast<double>(i / kPanelColumns);
    panel(place, kPanelLeft + column * (kPanelWidth + kPanelGap), kTop + row * (kPanelHeight + kPanelGap));
  }
  return svg_ + "</svg>\n";
}

}  // namespace

std::string check_picture(const TriangleMesh& mesh, const CheckSheet& sheet) { return Sheet(mesh, sheet).svg(); }

std::string check_page(const TriangleMesh& mesh, const CheckSheet& sheet) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>" + escaped(sheet.title) +
         "</title>\n<style>body{margin:0;background:#fff}svg{width:100%;height:auto}</style></head>\n<body>\n" +
         check_picture(mesh, sheet) + "</body>\n</html>\n";
}

}  // namespace geovor
