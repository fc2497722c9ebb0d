// Numbers from bytes, whatever the order of bytes of this machine. Private to the room.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>

namespace geovor {

template <typename T>
T read_bytes(const char* at, std::endian order) {
  char bytes[sizeof(T)];
  std::copy(at, at + sizeof(T), bytes);
  if (order != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <typename T>
T read_little(const char* at) {
  return read_bytes<T>(at, std::endian::little);
}

}  // namespace geovor
