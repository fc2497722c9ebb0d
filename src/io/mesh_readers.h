// One function a format; see read_mesh. Private to the room.
#pragma once

#include <string_view>

#include "mesh/loaded_mesh.h"

namespace geovor {

LoadedMesh read_stl(std::string_view bytes);
LoadedMesh read_obj(std::string_view bytes);
LoadedMesh read_ply(std::string_view bytes);
LoadedMesh read_off(std::string_view bytes);
LoadedMesh read_vtp(std::string_view bytes);
LoadedMesh read_msh(std::string_view bytes);
LoadedMesh read_inp(std::string_view bytes);

}  // namespace geovor
