// A floating-point type of twice the digits of double, for what results are held against.
#pragma once

#if defined(__GNUC__) && !defined(__clang__) && defined(__SIZEOF_FLOAT128__) && __has_include(<quadmath.h>)
#include <boost/multiprecision/float128.hpp>
namespace geovor::testing {
/// 113 bits. GCC's own, in software, with libquadmath.
using Float128 = boost::multiprecision::float128;
}  // namespace geovor::testing
#else
#include <boost/multiprecision/cpp_bin_float.hpp>
namespace geovor::testing {
/// 113 bits, on any compiler; slower.
using Float128 = boost::multiprecision::cpp_bin_float_quad;
}  // namespace geovor::testing
#endif
