// Four doubles that are added and multiplied together, and functions compiled for processors that do so in one
// instruction. The results are the same bits on either: no operation is fused or reordered.
#pragma once

#include <cstring>

#include "surface/span_basis.h"

#pragma GCC diagnostic ignored "-Wpsabi"

namespace geovor {

using Lanes = double __attribute__((vector_size(32)));

// Everything below is inlined by force: only then is it compiled for the instruction set of the function that uses it.
// That is why the calling convention, which GCC warns of, is of no matter.
#define GEOVOR_INLINE inline __attribute__((always_inline))

GEOVOR_INLINE Lanes load(const Quad& q) {
  Lanes lanes;
  std::memcpy(&lanes, &q, sizeof lanes);
  return lanes;
}
GEOVOR_INLINE void store(const Lanes& lanes, Quad& q) { std::memcpy(&q, &lanes, sizeof lanes); }
GEOVOR_INLINE Lanes all(double x) { return Lanes{x, x, x, x}; }

#if defined(__x86_64__)
#define GEOVOR_AVX2 __attribute__((target("avx2")))
inline bool has_avx2() { return __builtin_cpu_supports("avx2"); }
#endif

}  // namespace geovor
