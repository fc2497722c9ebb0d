// Tessellated STEP (ISO 10303-42, tessellated shape; AP242): one list of points, and a triangulated face a CAD face.
#include "io/face_groups.h"
#include "io/face_patches.h"
#include "io/mesh_writers.h"
#include "io/step_text.h"
#include "mesh/mesh_shells.h"

namespace geovor {
namespace {

constexpr StepSchema kSchema = {"AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }",
                                "managed model based 3d engineering", "ap242_managed_model_based_3d_engineering", 2014,
                                "tessellated shape"};
constexpr std::size_t kOfLine = 6;  // triples a line of the file

class TessellationWriter {
 public:
  TessellationWriter(const LabelledMesh& labelled, ByteStream& out)
      : mesh_(labelled.mesh),
        groups_(labelled, NameAlphabet::Text),
        patches_(mesh_),
        out_(out),
        text_(labelled, kSchema, out) {}

  void put() {
    const std::vector<MeshShell> shells = shells_of(mesh_, shared_edges(mesh_));
    std::vector<int> shell_of(mesh_.triangles.size());
    for (std::size_t s = 0; s < shells.size(); ++s) {
      for (const int t : shells[s].triangles) shell_of[t] = static_cast<int>(s);
    }
    put_points();
    std::vector<std::vector<std::size_t>> faces(shells.size());
    std::vector<std::size_t> items, styled;
    for (const FaceGroup& group : groups_) put_parts(group, shell_of, faces, styled);
    for (std::size_t s = 0; s < shells.size(); ++s) {
      const std::size_t id = text_.reserve(1);
      out_ << '#' << id << (shells[s].closed ? "=TESSELLATED_SOLID('',(" : "=TESSELLATED_SHELL('',(");
      for (std::size_t i = 0; i < faces[s].size(); ++i) out_ << (i > 0 ? ",#" : "#") << faces[s][i];
      out_ << "),$);\n";
      items.push_back(id);
    }
    text_.finish("TESSELLATED_SHAPE_REPRESENTATION", items, styled);
  }

 private:
  /// "((…),(…))": put(i) puts what is inside of one.
  template <class Put>
  void put_triples(std::size_t count, const Put& put) {
    out_ << '(';
    for (std::size_t i = 0; i < count; ++i) {
      out_ << (i == 0 ? "(" : i % kOfLine == 0 ? ",\n(" : ",(");
      put(i);
      out_ << ')';
    }
    out_ << ')';
  }

  void put_points() {
    points_ = text_.reserve(1);
    out_ << '#' << points_ << "=COORDINATES_LIST(''," << mesh_.points.size() << ",\n";
    put_triples(mesh_.points.size(), [this](std::size_t i) {
      const Xyz& p = mesh_.points[i];
      out_ << StepReal{p.x()} << ',' << StepReal{p.y()} << ',' << StepReal{p.z()};
    });
    out_ << ");\n";
  }

  /// A face's triangles; a face in several shells has a part in each.
  void put_parts(const FaceGroup& group, const std::vector<int>& shell_of, std::vector<std::vector<std::size_t>>& faces,
                 std::vector<std::size_t>& styled) {
    std::map<int, std::vector<int>> parts;
    for (const int t : group.triangles) parts[shell_of[t]].push_back(t);
    for (const auto& [shell, triangles] : parts) {
      FaceGroup part = group;
      part.triangles = triangles;
      const std::size_t id = text_.reserve(1);
      faces[static_cast<std::size_t>(shell)].push_back(id);
      put_face(id, part);
      if (!group.colour) continue;
      const std::size_t style = text_.style(*group.colour), item = text_.reserve(1);
      out_ << '#' << item << "=STYLED_ITEM('colour',(#" << style << "),#" << id << ");\n";
      styled.push_back(item);
    }
  }

  /// Numbers in the triangles are places in the list of points' numbers, both from 1.
  void put_face(std::size_t id, const FaceGroup& group) {
    const FacePatch& patch = patches_.patch(group);
    out_ << '#' << id << "=TRIANGULATED_FACE(" << step_string(group.name) << ",#" << points_ << ','
         << patch.points.size() << ",\n";
    put_triples(patch.normals.size(), [&](std::size_t i) {
      const Eigen::Vector3f& n = patch.normals[i];
      out_ << StepReal{n.x()} << ',' << StepReal{n.y()} << ',' << StepReal{n.z()};
    });
    out_ << ",$,\n(";
    for (std::size_t i = 0; i < patch.points.size(); ++i) {
      out_ << (i == 0 ? "" : i % (3 * kOfLine) == 0 ? ",\n" : ",") << patch.points[i] + 1;
    }
    out_ << "),\n";
    put_triples(patch.triangles.size(), [&](std::size_t i) {
      const auto& [a, b, c] = patch.triangles[i];
      out_ << a + 1 << ',' << b + 1 << ',' << c + 1;
    });
    out_ << ");\n";
  }

  const TriangleMesh& mesh_;
  const FaceGroups groups_;
  FacePatches patches_;
  ByteStream& out_;
  StepText text_;
  std::size_t points_ = 0;
};

}  // namespace

void put_step_tessellation(const LabelledMesh& labelled, ByteStream& out) { TessellationWriter(labelled, out).put(); }

}  // namespace geovor
