// geovor_bench: what surfaces and geodesics cost on this machine, in one run. Times are medians; seeds are fixed.
#include "benches.h"

int main() {
  geovor::bench::bench_jets();
  geovor::bench::bench_geodesics();
  geovor::bench::bench_distances();
}
