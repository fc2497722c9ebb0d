// Times of calls that last nanoseconds, fit to be compared with each other on a machine that does other things besides.
#pragma once

#include <functional>
#include <vector>

namespace geovor::bench {

/// One of several things whose times are compared.
struct Contender {
  std::function<void()> pass;  ///< `calls` calls of the thing
  int calls = 1;
};

/// Nanoseconds a call of each contender: the median over rounds in which every contender runs once, in turn, so that
/// a busy machine is equally unkind to all of them.
std::vector<double> race(const std::vector<Contender>& contenders);

/// The compiler must make `value`, though nobody reads it.
template <class T>
inline void keep(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

}  // namespace geovor::bench
