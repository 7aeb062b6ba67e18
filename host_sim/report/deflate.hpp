#pragma once
#include <string>

namespace firmtouch::host_sim {

/// zlib stream (RFC 1950, 1951) of `bytes`: greedy matches, one block with dynamic Huffman codes.
/// The report's pictures are about 10 % larger than with zlib -6.
std::string zlib_compress(const std::string& bytes);

}  // namespace firmtouch::host_sim
