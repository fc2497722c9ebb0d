// Points and vectors of space over any scalar: Eigen's would do, but compile slowly over a Float128.
#pragma once

#include <cmath>

#include "base/xyz.h"

namespace geovor::testing {

template <class T>
struct Vec3 {
  T x{0}, y{0}, z{0};
  Vec3() = default;
  Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  explicit Vec3(const Xyz& v) : x(v.x()), y(v.y()), z(v.z()) {}
};

template <class T>
Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vec3<T> operator*(const T& k, const Vec3<T>& a) {
  return {k * a.x, k * a.y, k * a.z};
}
template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T norm(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
template <class T>
Vec3<T> normalized(const Vec3<T>& a) {
  return (T(1) / norm(a)) * a;
}

}  // namespace geovor::testing
