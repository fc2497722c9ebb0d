#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "io/base64.h"
#include "io/colours.h"
#include "io/diagram_page.h"
#include "io/face_patches.h"
#include "io/mesh_writers.h"

namespace geovor {
namespace {

class MeshPage {
 public:
  explicit MeshPage(const LabelledMesh& labelled)
      : labelled_(labelled), mesh_(labelled.mesh), groups_(labelled, NameAlphabet::Text), frame_(mesh_) {}

  void put(ByteStream& out) const {
    out << "{\"title\":\"" << script_escaped(labelled_.title) << "\",\"unit\":\"" << script_escaped(labelled_.unit)
        << "\",\"size\":" << frame_.size << ",\"side\":" << usual_side();
    array(out, "points", [this](const FaceGroup&, const FacePatch& patch, ByteStream& bytes) {
      for (const int p : patch.points) put_place(p, bytes);
    });
    array(out, "normals", [](const FaceGroup&, const FacePatch& patch, ByteStream& bytes) {
      for (const Eigen::Vector3f& normal : patch.normals) {
        for (const float x : normal) bytes.real(x);
      }
    });
    std::uint32_t owner = 0;
    array(out, "owners", [&owner](const FaceGroup&, const FacePatch& patch, ByteStream& bytes) {
      constexpr std::uint32_t kColours = 16;  // of the page's palette: face after face takes the next
      for (std::size_t i = 0; i < patch.points.size(); ++i) bytes.word(owner * kColours + owner % kColours);
      ++owner;
    });
    std::uint32_t first = 0;
    array(out, "triangles", [&first](const FaceGroup&, const FacePatch& patch, ByteStream& bytes) {
      for (const auto& corners : patch.triangles) {
        for (const std::uint32_t c : corners) bytes.word(first + c);
      }
      first += static_cast<std::uint32_t>(patch.points.size());
    });
    put_borders(out);
    put_owners(out);
  }

 private:
  void put_place(int point, ByteStream& bytes) const {
    const Xyz place = (mesh_.points[point] - frame_.middle) / frame_.size;
    for (const double x : place) bytes.real(static_cast<float>(x));
  }

  template <class Put>
  void array(ByteStream& out, const char* name, const Put& put) const {
    out << ",\"" << name << "\":\"";
    put_base64(out, [&](ByteStream& bytes) {
      FacePatches patches(mesh_);
      for (const FaceGroup& group : groups_) put(group, patches.patch(group), bytes);
    });
    out << '"';
  }

  /// The side of the equilateral triangle that has the mean area, relative to the frame.
  double usual_side() const {
    double area = 0.0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) area += area_of(static_cast<int>(t)) / frame_.size;
    return std::sqrt(4.0 / std::sqrt(3.0) * area / frame_.size / static_cast<double>(mesh_.triangles.size()));
  }

  double area_of(int t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return 0.5 * (mesh_.points[b] - mesh_.points[a]).cross(mesh_.points[c] - mesh_.points[a]).norm();
  }

  /// Sides that two triangles of one face don't share, each as a line of kind 2 and two points.
  void put_borders(ByteStream& out) const {
    out << R"(,"sites":"","lines":")";
    put_base64(out, [this](ByteStream& bytes) {
      std::vector<std::array<int, 2>> sides;
      for (const FaceGroup& group : groups_) {
        sides.clear();
        for (const int t : group.triangles) {
          const std::array<int, 3>& corners = mesh_.triangles[t];
          for (int k = 0; k < 3; ++k)
            sides.push_back({std::min(corners[k], corners[(k + 1) % 3]), std::max(corners[k], corners[(k + 1) % 3])});
        }
        std::sort(sides.begin(), sides.end());
        for (auto side = sides.begin(); side != sides.end();) {
          const auto next = std::upper_bound(side, sides.end(), *side);
          if (next - side == 1) put_line(*side, bytes);
          side = next;
        }
      }
    });
    out << '"';
  }

  void put_line(const std::array<int, 2>& side, ByteStream& bytes) const {
    constexpr std::uint32_t kBorder = 2;
    bytes.word(kBorder), bytes.word(2);
    for (const int p : side) put_place(p, bytes);
  }

  void put_owners(ByteStream& out) const {
    const char* comma = "";
    out << ",\"areas\":[";
    for (const FaceGroup& group : groups_) {
      double area = 0.0;
      for (const int t : group.triangles) area += area_of(t);
      out << comma, comma = ",";
      if (std::isfinite(area)) {
        out << area;
      } else {
        out << "null";
      }
    }
    comma = "";
    out << "],\"names\":[";
    for (const FaceGroup& group : groups_) out << comma << '"' << script_escaped(group.name) << '"', comma = ",";
    out << ']';
    if (std::any_of(groups_.begin(), groups_.end(), [](const FaceGroup& g) { return g.colour.has_value(); })) {
      put_tints(out);
    }
    out << '}';
  }

  void put_tints(ByteStream& out) const {
    const char* comma = "";
    out << ",\"tints\":[";
    for (const FaceGroup& group : groups_) {
      const auto [red, green, blue] = srgb_bytes(group.colour.value_or(kPlainColour));
      out << comma << '[' << int{red} << ',' << int{green} << ',' << int{blue} << ']', comma = ",";
    }
    out << ']';
  }

  const LabelledMesh& labelled_;
  const TriangleMesh& mesh_;
  const FaceGroups groups_;
  const MeshFrame frame_;
};

}  // namespace

void put_mesh_html(const LabelledMesh& labelled, ByteStream& out) {
  put_page({labelled.title,
            "click: mark a face &middot;\nkeys: arrows, + &minus;, R whole mesh, T triangles, E borders, C faces",
            [&](ByteStream& data) { MeshPage(labelled).put(data); }},
           out);
}

}  // namespace geovor
