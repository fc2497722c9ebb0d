// Bytes on their way into a file: text, numbers as text, and numbers as little-endian bytes on every machine.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace geovor {

/// Collects what is written and hands it on in large pieces, so that a file of any length needs little memory.
class ByteStream {
 public:
  using Drain = std::function<void(std::string_view)>;

  explicit ByteStream(Drain drain);
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  ByteStream& operator<<(std::string_view text);
  ByteStream& operator<<(const char* text) { return *this << std::string_view(text); }
  ByteStream& operator<<(char c);
  /// The shortest text that reads back as the same double.
  ByteStream& operator<<(double x);
  template <std::integral Integer>
  ByteStream& operator<<(Integer i) {
    return *this << std::string_view(std::to_string(i));
  }

  void byte(std::uint8_t x) { *this << static_cast<char>(x); }
  void word(std::uint32_t x);
  void long_word(std::uint64_t x);
  void real(float x) { word(std::bit_cast<std::uint32_t>(x)); }
  void real(double x) { long_word(std::bit_cast<std::uint64_t>(x)); }

  /// Hands on what is left. Without it the end is lost.
  void flush();

 private:
  Drain drain_;
  std::string buffer_;
};

/// All that `put` writes.
std::string bytes_of(const std::function<void(ByteStream&)>& put);

/// Writes what `put` writes; the file is complete or absent. Throws Error(Unwritable), and what `put` throws.
void write_file(const std::string& path, const std::function<void(ByteStream&)>& put);

}  // namespace geovor
