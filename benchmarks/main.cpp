// geovor_bench [part...]: what surfaces, geodesics and diagrams cost on this machine, in one run. Times are medians;
// seeds are fixed.
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>

#include "benches.h"

namespace {

struct Part {
  const char* name;
  void (*run)();
};

constexpr Part kParts[] = {{"jets", geovor::bench::bench_jets},
                           {"geodesics", geovor::bench::bench_geodesics},
                           {"distances", geovor::bench::bench_distances},
                           {"bisectors", geovor::bench::bench_bisectors},
                           {"diagrams", geovor::bench::bench_diagrams}};

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const bool known = std::any_of(std::begin(kParts), std::end(kParts),
                                   [&](const Part& p) { return argv[i] == std::string(p.name); });
    if (!known) {
      std::fprintf(stderr,
                   "geovor_bench: no part is called %s; there are jets, geodesics, distances, bisectors, diagrams\n",
                   argv[i]);
      return 1;
    }
  }
  for (const Part& part : kParts) {
    bool wanted = argc == 1;
    for (int i = 1; i < argc; ++i) wanted = wanted || argv[i] == std::string(part.name);
    if (wanted) part.run();
  }
}
