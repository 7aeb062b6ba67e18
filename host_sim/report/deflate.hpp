#pragma once
#include <string>

namespace firmtouch::host_sim {

/// zlib stream (RFC 1950, 1951) of `bytes`: greedy matches, one block with its own Huffman codes.
/// For the report's pictures: within some 10 % of what zlib -6 makes of them.
std::string zlib_compress(const std::string& bytes);

}  // namespace firmtouch::host_sim
