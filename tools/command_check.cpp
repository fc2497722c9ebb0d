// geovor check: a mesh, ours or another program's, measured against the CAD file that it stands for.
#include <fmt/format.h>

#include "base/error.h"
#include "check_report.h"
#include "commands.h"
#include "context.h"
#include "io/atomic_file.h"
#include "io/check_picture.h"
#include "io/read_mesh.h"
#include "occ_adapter/read_cad.h"
#include "outputs.h"
#include "parallel.h"

namespace geovor {
namespace {

void write_outputs(const CheckArguments& arguments, const CheckSummary& summary) {
  if (arguments.outputs.empty()) return;
  const TriangleMesh& mesh = summary.loaded->mesh;
  const CheckSheet sheet = check_sheet(summary);
  StagedOutputs outputs;
  for (const std::string& path : arguments.outputs) {
    const std::string format = ending(path);
    outputs.add(path, [&](const std::string& place) {
      write_file(place, format == ".svg"    ? check_picture(mesh, sheet)
                        : format == ".html" ? check_page(mesh, sheet)
                                            : check_json(summary));
    });
  }
  outputs.commit();
}

}  // namespace

int run(const CheckArguments& arguments) {
  check_outputs(arguments.outputs, arguments.against, arguments.mesh, "mesh");
  const LoadedMesh loaded = in_context(arguments.mesh, [&] { return read_mesh(arguments.mesh); });
  const CadModel model = in_context(arguments.against, [&] { return read_cad(arguments.against); });
  const MeshCheck check =
      in_context(arguments.mesh, [&] { return check_mesh(loaded, model, for_each_on(arguments.threads)); });
  const CheckSummary summary{arguments.mesh, &loaded, &model, &check, check_warnings(loaded, model, check)};
  write_outputs(arguments, summary);
  fmt::print("{}", arguments.json ? check_json(summary) : check_text(summary));
  if (arguments.json) return 0;
  for (const std::string& path : arguments.outputs) fmt::print("{:<17} {}\n", "wrote", path);
  return 0;
}

}  // namespace geovor
