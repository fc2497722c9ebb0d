#include "io/byte_stream.h"

#include <utility>

#include "io/atomic_file.h"
#include "io/number_text.h"

namespace geovor {
namespace {

// Large enough that a system call a piece costs nothing, small enough to stay in the cache.
constexpr std::size_t kPiece = std::size_t{1} << 16;

template <class Word>
void append_little_endian(std::string& buffer, Word x) {
  for (std::size_t k = 0; k < sizeof(Word); ++k) buffer += static_cast<char>((x >> (8 * k)) & 0xffU);
}

}  // namespace

ByteStream::ByteStream(Drain drain) : drain_(std::move(drain)) { buffer_.reserve(2 * kPiece); }

ByteStream& ByteStream::operator<<(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= kPiece) flush();
  return *this;
}

ByteStream& ByteStream::operator<<(char c) { return *this << std::string_view(&c, 1); }

ByteStream& ByteStream::operator<<(double x) {
  append_shortest(buffer_, x);
  if (buffer_.size() >= kPiece) flush();
  return *this;
}

void ByteStream::word(std::uint32_t x) {
  append_little_endian(buffer_, x);
  if (buffer_.size() >= kPiece) flush();
}

void ByteStream::long_word(std::uint64_t x) {
  append_little_endian(buffer_, x);
  if (buffer_.size() >= kPiece) flush();
}

void ByteStream::flush() {
  drain_(buffer_);
  buffer_.clear();
}

std::string bytes_of(const std::function<void(ByteStream&)>& put) {
  std::string bytes;
  ByteStream stream([&bytes](std::string_view piece) { bytes += piece; });
  put(stream);
  stream.flush();
  return bytes;
}

void write_file(const std::string& path, const std::function<void(ByteStream&)>& put) {
  AtomicFile file(path);
  file.write([&put](const AtomicFile::Drain& drain) {
    ByteStream stream(drain);
    put(stream);
    stream.flush();
  });
  file.commit();
}

}  // namespace geovor
