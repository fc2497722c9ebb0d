#include <algorithm>

#include "io/base64.h"
#include "io/colours.h"
#include "io/face_groups.h"
#include "io/mesh_writers.h"

namespace geovor {
namespace {

class MeshVtp {
 public:
  MeshVtp(const LabelledMesh& labelled, ByteStream& out)
      : mesh_(labelled.mesh), groups_(labelled, NameAlphabet::Text), out_(out) {}

  void put() {
    const std::size_t points = mesh_.points.size(), triangles = mesh_.triangles.size();
    out_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<PolyData>\n";
    names();
    out_ << "<Piece NumberOfPoints=\"" << points << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
         << "NumberOfPolys=\"" << triangles << "\">\n<CellData>\n";
    array("Int32", "face", 1, 4 * triangles, [this](ByteStream& bytes) {
      each_triangle([&](std::size_t g, int) { bytes.word(static_cast<std::uint32_t>(groups_.groups()[g].face)); });
    });
    array("Int32", "group", 1, 4 * triangles, [this](ByteStream& bytes) {
      each_triangle([&](std::size_t g, int) { bytes.word(static_cast<std::uint32_t>(g)); });
    });
    if (std::any_of(groups_.begin(), groups_.end(), [](const FaceGroup& g) { return g.colour.has_value(); })) colours();
    out_ << "</CellData>\n<Points>\n";
    array("Float64", "points", 3, 24 * points, [this](ByteStream& bytes) {
      for (const Xyz& p : mesh_.points) {
        for (const double x : p) bytes.real(x);
      }
    });
    out_ << "</Points>\n<Polys>\n";
    array("Int32", "connectivity", 1, 12 * triangles, [this](ByteStream& bytes) {
      each_triangle([&](std::size_t, int t) {
        for (const int corner : mesh_.triangles[t]) bytes.word(static_cast<std::uint32_t>(corner));
      });
    });
    array("Int64", "offsets", 1, 8 * triangles, [triangles](ByteStream& bytes) {
      for (std::size_t t = 1; t <= triangles; ++t) bytes.long_word(3 * t);
    });
    out_ << "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  }

 private:
  template <class Visit>
  void each_triangle(const Visit& visit) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      for (const int t : groups_.groups()[g].triangles) visit(g, t);
    }
  }

  /// An array of `size` bytes: in VTK's "binary" form the number of bytes and the bytes are one run of base 64 each.
  void array(const char* type, const char* name, int components, std::size_t size,
             const std::function<void(ByteStream&)>& put) {
    out_ << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
         << "\" format=\"binary\">\n";
    put_base64(out_, [size](ByteStream& bytes) { bytes.long_word(size); });
    put_base64(out_, put);
    out_ << "\n</DataArray>\n";
  }

  void colours() {
    array("UInt8", "colour", 3, 3 * mesh_.triangles.size(), [this](ByteStream& bytes) {
      for (const FaceGroup& group : groups_) {
        const auto colour = srgb_bytes(group.colour.value_or(kPlainColour));
        for (std::size_t i = 0; i < group.triangles.size(); ++i) {
          for (const std::uint8_t part : colour) bytes.byte(part);
        }
      }
    });
  }

  /// VTK writes texts as the numbers of their bytes, each ended by 0.
  void names() {
    out_ << "<FieldData>\n<Array type=\"String\" Name=\"group_names\" NumberOfTuples=\"" << groups_.size()
         << "\" format=\"ascii\">\n";
    for (const FaceGroup& group : groups_) {
      for (const char c : group.name) out_ << static_cast<int>(static_cast<unsigned char>(c)) << ' ';
      out_ << "0\n";
    }
    out_ << "</Array>\n</FieldData>\n";
  }

  const TriangleMesh& mesh_;
  const FaceGroups groups_;
  ByteStream& out_;
};

}  // namespace

void put_mesh_vtp(const LabelledMesh& labelled, ByteStream& out) { MeshVtp(labelled, out).put(); }

}  // namespace geovor
