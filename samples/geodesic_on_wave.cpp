// The shortest path between two points of the paper's wave surface: its length, and some points along it.
//   geodesic_on_wave samples/cad/wave.step
#include <cstdio>

#include "base/error.h"
#include "geodesic/distance.h"
#include "occ_adapter/read_cad.h"

int main(int argc, char** argv) try {
  using namespace geovor;
  if (argc != 2) throw Error(ErrorCode::Usage, "usage: geodesic_on_wave WAVE.step");
  const CadModel model = read_cad(argv[1]);
  const Surface& surface = *model.faces.at(0).surface;

  const Uv from{-2.0, -1.5}, to{1.0, 2.0};
  const Connection path = distance(surface, from, to).shortest;
  if (path.status != ConnectStatus::Converged) return 1;
  std::printf("length %.12f, straight through space %.12f\n", path.length,
              (surface.position(to) - surface.position(from)).norm());

  constexpr int kPieces = 8;
  for (const GeodesicState& state : sample_geodesic(surface, from, path.start_direction, path.length, kPieces)) {
    const Xyz p = surface.position(state.p);
    std::printf("%9.6f %9.6f %9.6f\n", p.x(), p.y(), p.z());
  }
  return 0;
} catch (const geovor::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.code());
}
