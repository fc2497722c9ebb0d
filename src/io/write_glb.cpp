// glTF 2.0 (Khronos, ISO/IEC 12113): a JSON chunk that describes, a binary chunk that holds positions, normals and
// indices, face by face.
#include <limits>
#include <map>

#include "base/error.h"
#include "io/colours.h"
#include "io/face_patches.h"
#include "io/length_unit.h"
#include "io/mesh_writers.h"

namespace geovor {
namespace {

// Numbers of the specification.
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertices = 34962, kIndices = 34963;

struct Layout {
  std::size_t points = 0, triangles = 0, start = 0;  ///< bytes from the start of the binary chunk
  Eigen::Vector3f lower, upper;

  std::size_t vector_bytes() const { return 12 * points; }
  std::size_t index_bytes() const { return 12 * triangles; }
  std::size_t end() const { return start + 2 * vector_bytes() + index_bytes(); }
};

class GlbWriter {
 public:
  GlbWriter(const LabelledMesh& labelled, ByteStream& out)
      : labelled_(labelled),
        mesh_(labelled.mesh),
        groups_(labelled, NameAlphabet::Text),
        patches_(mesh_),
        frame_(mesh_),
        metres_(metres_of(labelled.unit)),
        out_(out) {}

  void put() {
    for (const FaceGroup& group : groups_) measure(patches_.patch(group));
    std::string json = bytes_of([this](ByteStream& text) { describe(text); });
    json.resize((json.size() + 3) / 4 * 4, ' ');
    constexpr std::size_t kHead = 12, kChunkHead = 8;
    const std::size_t bytes = layouts_.back().end(), total = kHead + kChunkHead + json.size() + kChunkHead + bytes;
    if (total > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(ErrorCode::Unwritable, "glTF can't hold so many triangles in one file; write .ply");
    }
    for (const std::uint32_t word : {kMagic, kVersion, static_cast<std::uint32_t>(total)}) out_.word(word);
    out_.word(static_cast<std::uint32_t>(json.size())), out_.word(kJsonChunk);
    out_ << json;
    out_.word(static_cast<std::uint32_t>(bytes)), out_.word(kBinaryChunk);
    for (const FaceGroup& group : groups_) put(patches_.patch(group));
  }

 private:
  /// In metres, from the middle of the mesh.
  Eigen::Vector3f place(int point) const { return (metres_ * (mesh_.points[point] - frame_.middle)).cast<float>(); }

  void measure(const FacePatch& patch) {
    Layout layout;
    layout.points = patch.points.size(), layout.triangles = patch.triangles.size();
    layout.start = layouts_.empty() ? 0 : layouts_.back().end();
    layout.lower = layout.upper = place(patch.points.front());
    for (const int p : patch.points) {
      layout.lower = layout.lower.cwiseMin(place(p)), layout.upper = layout.upper.cwiseMax(place(p));
    }
    if (!(layout.lower.allFinite() && layout.upper.allFinite())) {
      throw Error(ErrorCode::Unwritable, "a coordinate is too large for glTF's single precision; write .ply");
    }
    layouts_.push_back(layout);
  }

  void put(const FacePatch& patch) {
    for (const int p : patch.points) {
      for (const float x : place(p)) out_.real(x);
    }
    for (const Eigen::Vector3f& normal : patch.normals) {
      for (const float x : normal) out_.real(x);
    }
    for (const auto& corners : patch.triangles) {
      for (const std::uint32_t c : corners) out_.word(c);
    }
  }

  /// The elements of an array, with commas between them.
  template <class Put>
  void list(ByteStream& json, const char* name, std::size_t count, const Put& put) const {
    json << ",\"" << name << "\":[";
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) json << ',';
      put(i);
    }
    json << ']';
  }

  /// Node 0 puts the mesh back to its place and turns it from z up to y up; the others are the faces.
  void describe(ByteStream& json) const {
    const std::size_t count = groups_.size();
    const Xyz shift = metres_ * frame_.middle;
    json << R"({"asset":{"version":"2.0","generator":"geovor"},"scene":0,"scenes":[{"nodes":[0]}])";
    json << ",\"nodes\":[{\"name\":\"" << name_in(NameAlphabet::Text, labelled_.title, FaceGroups::kLongest)
         << R"(","matrix":[1,0,0,0,0,0,-1,0,0,1,0,0,)" << shift.x() << ',' << shift.z() << ',' << -shift.y()
         << R"(,1],"children":[)";
    for (std::size_t i = 1; i <= count; ++i) json << (i > 1 ? "," : "") << i;
    json << "]}";
    for (std::size_t i = 0; i < count; ++i) {
      const FaceGroup& group = groups_.groups()[i];
      json << ",{\"name\":\"" << group.name << "\",\"mesh\":" << i << ",\"extras\":{\"face\":" << group.face << "}}";
    }
    json << ']';
    describe_materials(json);
    describe_buffers(json);
    json << '}';
  }

  /// A material a colour, in the order of the faces that have it first, and the meshes that use it.
  void describe_materials(ByteStream& json) const {
    std::map<std::array<double, 3>, std::size_t> number;
    std::vector<std::array<double, 3>> colours;
    for (const FaceGroup& group : groups_) {
      const auto colour = group.colour.value_or(kPlainColour);
      if (number.try_emplace(colour, colours.size()).second) colours.push_back(colour);
    }
    list(json, "materials", colours.size(), [&](std::size_t i) {
      json << R"({"doubleSided":true,"pbrMetallicRoughness":{"baseColorFactor":[)" << colours[i][0] << ','
           << colours[i][1] << ',' << colours[i][2] << R"(,1],"metallicFactor":0.1,"roughnessFactor":0.6}})";
    });
    list(json, "meshes", groups_.size(), [&](std::size_t i) {
      const FaceGroup& group = groups_.groups()[i];
      json << "{\"name\":\"" << group.name << R"(","primitives":[{"attributes":{"POSITION":)" << 3 * i
           << ",\"NORMAL\":" << 3 * i + 1 << "},\"indices\":" << 3 * i + 2
           << ",\"material\":" << number.at(group.colour.value_or(kPlainColour)) << "}]}";
    });
  }

  /// Three views of the buffer a face, and three accessors: positions, normals, indices.
  void describe_buffers(ByteStream& json) const {
    json << ",\"buffers\":[{\"byteLength\":" << layouts_.back().end() << "}]";
    list(json, "bufferViews", layouts_.size(), [&](std::size_t i) {
      const Layout& layout = layouts_[i];
      const std::size_t size = layout.vector_bytes();
      const auto view = [&](std::size_t offset, std::size_t length, int target) {
        json << "{\"buffer\":0,\"byteOffset\":" << offset << ",\"byteLength\":" << length << ",\"target\":" << target
             << '}';
      };
      view(layout.start, size, kVertices), json << ',';
      view(layout.start + size, size, kVertices), json << ',';
      view(layout.start + 2 * size, layout.index_bytes(), kIndices);
    });
    list(json, "accessors", layouts_.size(), [&](std::size_t i) {
      const Layout& layout = layouts_[i];
      const auto corner = [&](const char* name, const Eigen::Vector3f& x) {
        json << ",\"" << name << "\":[" << double{x[0]} << ',' << double{x[1]} << ',' << double{x[2]} << ']';
      };
      const auto accessor = [&](std::size_t view, int type, std::size_t count, const char* kind) {
        json << "{\"bufferView\":" << view << ",\"componentType\":" << type << ",\"count\":" << count << ",\"type\":\""
             << kind << '"';
      };
      accessor(3 * i, kFloat, layout.points, "VEC3");
      corner("min", layout.lower), corner("max", layout.upper);
      json << "},";
      accessor(3 * i + 1, kFloat, layout.points, "VEC3");
      json << "},";
      accessor(3 * i + 2, kUnsignedInt, 3 * layout.triangles, "SCALAR");
      json << '}';
    });
  }

  const LabelledMesh& labelled_;
  const TriangleMesh& mesh_;
  const FaceGroups groups_;
  FacePatches patches_;
  const MeshFrame frame_;
  const double metres_;
  ByteStream& out_;
  std::vector<Layout> layouts_;
};

}  // namespace

void put_glb(const LabelledMesh& labelled, ByteStream& out) { GlbWriter(labelled, out).put(); }

}  // namespace geovor
