// Bytes as base 64 (RFC 4648), on their way into a stream.
#pragma once

#include "io/byte_stream.h"

namespace geovor {

/// Puts what `put` writes into `out`, as one run of base 64.
void put_base64(ByteStream& out, const std::function<void(ByteStream&)>& put);

}  // namespace geovor
