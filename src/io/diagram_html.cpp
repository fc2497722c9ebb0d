#include "io/diagram_html.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/atomic_file.h"
#include "io/base64.h"
#include "io/cell_colours.h"
#include "io/diagram_page.h"
#include "io/number_text.h"

namespace geovor {
namespace {

// Points of an edge nearer to its chord than this part of the face's size are left out: less than a unit of a screen.
constexpr float kEye = 1e-4F;

/// Little-endian bytes on every machine, then base 64.
class Bytes {
 public:
  void add(std::uint32_t x) { stream_.word(x); }
  void add(float x) { stream_.real(x); }
  void add(const Eigen::Vector3f& x) {
    for (int k = 0; k < 3; ++k) add(x[k]);
  }

  std::string base64() {
    stream_.flush();
    return bytes_of([this](ByteStream& out) { put_base64(out, [this](ByteStream& bytes) { bytes << bytes_; }); });
  }

 private:
  std::string bytes_;
  ByteStream stream_{[this](std::string_view piece) { bytes_ += piece; }};
};

/// The face moved and scaled into the ball of radius 1.
struct Frame {
  Xyz middle = Xyz::Zero();
  double size = 1.0;

  explicit Frame(const CellMesh& cells, const VoronoiDiagram& diagram) {
    Xyz lower = Xyz::Constant(1e300), upper = -lower;
    const auto grow = [&](const Xyz& x) { lower = lower.cwiseMin(x), upper = upper.cwiseMax(x); };
    for (const Xyz& x : cells.points) grow(x);
    for (const DiagramSite& s : diagram.sites) grow(s.xyz);
    for (const DiagramEdge& e : diagram.edges) {
      for (const EdgePoint& p : e.points) grow(p.xyz);
    }
    if (!(lower.x() <= upper.x())) return;
    middle = 0.5 * (lower + upper);
    size = std::max(0.5 * (upper - lower).norm(), std::numeric_limits<double>::min());  // a point is drawn too
  }
  Eigen::Vector3f operator()(const Xyz& x) const { return ((x - middle) / size).cast<float>(); }
};

class PageData {
 public:
  PageData(const VoronoiDiagram& diagram, const CellMesh& cells, const PageFacts& facts)
      : diagram_(diagram), cells_(cells), facts_(facts), frame_(cells, diagram) {}

  std::string script() const {
    std::string text = "{\"title\":\"" + script_escaped(facts_.title) + "\",\"unit\":\"" + script_escaped(facts_.unit) +
                       "\",\"size\":";
    append_shortest(text, frame_.size);
    text += ",\"points\":\"" + points() + "\",\"normals\":\"" + normals() + "\",\"owners\":\"" + owners() +
            "\",\"triangles\":\"" + triangles() + "\",\"lines\":\"" + lines() + "\",\"sites\":\"" + sites() +
            "\",\"areas\":[" + areas() + "]}";
    return text;
  }

 private:
  std::string points() const {
    Bytes bytes;
    for (const Xyz& x : cells_.points) bytes.add(frame_(x));
    return bytes.base64();
  }

  std::string normals() const {
    Bytes bytes;
    for (const Xyz& x : cells_.normals) bytes.add(Eigen::Vector3f(x.cast<float>()));
    return bytes.base64();
  }

  /// The site and the colour of each point, packed as site * 16 + colour.
  std::string owners() const {
    constexpr std::uint32_t kColours = 16;
    const std::vector<int> colours = colours_of_cells(diagram_);
    std::vector<std::uint32_t> owner(cells_.points.size(), 0);
    for (size_t t = 0; t < cells_.triangles.size(); ++t) {
      const auto site = static_cast<std::uint32_t>(cells_.site_of[t]);
      const std::uint32_t packed = site * kColours + static_cast<std::uint32_t>(colours[site]) % kColours;
      for (int corner : cells_.triangles[t]) owner[corner] = packed;
    }
    Bytes bytes;
    for (std::uint32_t x : owner) bytes.add(x);
    return bytes.base64();
  }

  std::string triangles() const {
    Bytes bytes;
    for (const auto& t : cells_.triangles) {
      for (int corner : t) bytes.add(static_cast<std::uint32_t>(corner));
    }
    return bytes.base64();
  }

  /// A polyline is its kind (0 bisector, 1 cut locus, 2 border), the number of its points, and these.
  std::string lines() const {
    Bytes bytes;
    for (const DiagramEdge& e : diagram_.edges) {
      std::vector<Eigen::Vector3f> points;
      for (const EdgePoint& p : e.points) points.push_back(frame_(p.xyz));
      add_line(e.kind == EdgeKind::CutLocus ? 1U : 0U, points, bytes);
    }
    for (const auto& border : cells_.border) {
      std::vector<Eigen::Vector3f> points;
      for (const Xyz& x : border) points.push_back(frame_(x));
      add_line(2U, points, bytes);
    }
    return bytes.base64();
  }

  static void add_line(std::uint32_t kind, const std::vector<Eigen::Vector3f>& points, Bytes& bytes) {
    std::vector<Eigen::Vector3f> kept;
    for (size_t i = 0; i < points.size(); ++i) {
      if (i == 0 || i + 1 == points.size() || bends(kept.back(), points[i], points[i + 1])) kept.push_back(points[i]);
    }
    bytes.add(kind), bytes.add(static_cast<std::uint32_t>(kept.size()));
    for (const auto& p : kept) bytes.add(p);
  }

  /// Points are dense where the line turns: one near to the chord of its neighbours can go.
  static bool bends(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    const Eigen::Vector3f way = c - a;
    const float square = way.squaredNorm();
    const float k = square > 0.0F ? (b - a).dot(way) / square : 0.0F;
    return (b - a - k * way).norm() > kEye || (b - a).norm() > 0.05F;
  }

  std::string sites() const {
    Bytes bytes;
    for (const DiagramSite& s : diagram_.sites) bytes.add(frame_(s.xyz));
    return bytes.base64();
  }

  std::string areas() const {
    std::string text;
    for (size_t i = 0; i < diagram_.sites.size(); ++i) {
      if (i > 0) text += ',';
      const double area = i < diagram_.cells.size() ? diagram_.cells[i].area : 0.0;
      if (std::isfinite(area))
        append_shortest(text, area);
      else
        text += "null";
    }
    return text;
  }

  const VoronoiDiagram& diagram_;
  const CellMesh& cells_;
  const PageFacts& facts_;
  Frame frame_;
};

}  // namespace

std::string diagram_html(const VoronoiDiagram& diagram, const CellMesh& cells, const PageFacts& facts) {
  const PageParts parts{facts.title,
                        "click: mark a cell &middot;\nkeys: arrows, + &minus;, R whole face, E edges, S sites, C cells",
                        [&](ByteStream& out) { out << PageData(diagram, cells, facts).script(); }};
  return bytes_of([&](ByteStream& out) { put_page(parts, out); });
}

void write_diagram_html(const VoronoiDiagram& diagram, const CellMesh& cells, const PageFacts& facts,
                        const std::string& path) {
  write_file(path, diagram_html(diagram, cells, facts));
}

}  // namespace geovor
