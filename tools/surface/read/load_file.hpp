#pragma once
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace firmtouch::tools {

/// Every byte of a file, or the problem: what is wrong and how to mend it, without the file's name.
struct LoadedFile {
  std::vector<uint8_t> bytes;
  std::string problem;
};

/// No line of a model or table is longer; 200,000 corners of one face fit. A file that is one line
/// (a dump, a minified export, a disk image) is refused before it fills the memory.
constexpr size_t kMaxLineBytes = size_t{1} << 24;

/// The largest asset's triangles, as text STL, the most verbose format, fit.
constexpr size_t kMaxFileBytes = 0xFFFFFFFF;

/// "obj" of "dir/Bone.OBJ" and of "bone.obj.gz"; empty where there is none.
std::string model_extension(const std::string& path);

/// Reads a file. A text (no zero byte so far) with a line longer than `max_line_bytes`, and a file
/// longer than kMaxFileBytes, are refused where that is seen. Gzip is decompressed.
/// Bounds: memory and time of what is taken.
LoadedFile load_file(const std::string& path, size_t max_line_bytes);
LoadedFile load_stream(std::FILE* stream, size_t max_line_bytes);

/// The letters behind the last dot, in lower case; empty where there is none.
std::string extension_of(const std::string& path);

}  // namespace firmtouch::tools
