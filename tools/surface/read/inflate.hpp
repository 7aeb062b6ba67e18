#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace firmtouch::tools {

/// What came out of compressed bytes, or what is wrong with them.
struct Inflated {
  std::string bytes;
  std::string problem;
  size_t used = 0;  // of the compressed bytes
};

/// Decompresses a raw deflate stream.
/// Bounds: memory of what comes out, at most `max_bytes`; time in proportion to bytes in and out.
/// Source: RFC 1951.
Inflated inflate(std::string_view deflated, size_t max_bytes);

bool is_gzip(std::string_view bytes);
/// Decompresses a gzip file of one or several members and checks length and CRC-32 of each.
/// Source: RFC 1952.
Inflated gunzip(std::string_view bytes, size_t max_bytes);

}  // namespace firmtouch::tools
