#include "io/read_mesh.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/mesh_text.h"

namespace geovor {
namespace {

struct Reader {
  const char* ending;
  LoadedMesh (*read)(std::string_view bytes);
};

constexpr Reader kReaders[] = {{".stl", read_stl}, {".obj", read_obj}, {".ply", read_ply}, {".off", read_off},
                               {".vtp", read_vtp}, {".msh", read_msh}, {".inp", read_inp}};

std::string bytes_of(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) fail_to_read(0, "there is no such file; check the path");
  if (std::filesystem::is_directory(path, error)) fail_to_read(0, "it is a folder; name a file in it");
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) fail_to_read(0, "it can't be read; check its permissions");
  if (bytes.empty()) fail_to_read(0, "it is empty; export the mesh anew");
  return bytes;
}

}  // namespace

const std::vector<std::string>& readable_mesh_endings() {
  static const std::vector<std::string> endings = [] {
    std::vector<std::string> list;
    for (const Reader& r : kReaders) list.emplace_back(r.ending);
    return list;
  }();
  return endings;
}

LoadedMesh read_mesh(const std::string& path) {
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  const auto* reader =
      std::find_if(std::begin(kReaders), std::end(kReaders), [&](const Reader& r) { return ending == r.ending; });
  if (reader == std::end(kReaders)) {
    std::string known;
    for (const std::string& e : readable_mesh_endings()) known += " " + e;
    fail_to_read(0, "the ending '" + ending + "' is no mesh that can be read; use one of" + known);
  }
  LoadedMesh loaded = reader->read(bytes_of(path));
  if (loaded.mesh.triangles.empty()) {
    fail_to_read(0, "it holds no triangle; export the mesh with its surface elements");
  }
  return loaded;
}

}  // namespace geovor
