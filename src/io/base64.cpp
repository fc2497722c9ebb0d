#include "io/base64.h"

namespace geovor {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// One to three bytes as four characters.
void put_group(std::string_view bytes, ByteStream& out) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
  char text[4];
  for (std::size_t k = 0; k < 4; ++k) text[k] = k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63U];
  out << std::string_view(text, 4);
}

}  // namespace

void put_base64(ByteStream& out, const std::function<void(ByteStream&)>& put) {
  std::string left;  // what is no whole group of three yet
  ByteStream bytes([&](std::string_view piece) {
    left += piece;
    std::size_t at = 0;
    for (; at + 3 <= left.size(); at += 3) put_group(std::string_view(left).substr(at, 3), out);
    left.erase(0, at);
  });
  put(bytes);
  bytes.flush();
  if (!left.empty()) put_group(left, out);
}

}  // namespace geovor
