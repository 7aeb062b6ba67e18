#include "surface/read_surface.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "surface/import_sink.hpp"

namespace firmtouch::tools {
namespace {

std::string extension_of(const std::string& path) {
  const size_t dot = path.find_last_of("./\\");
  if (dot == path.npos || path[dot] != '.') return "";
  std::string extension = path.substr(dot + 1);
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

// Result: empty, or what is wrong.
std::string load(const std::string& path, std::string& bytes) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return std::string("cannot be opened: ") + std::strerror(errno);
  char block[1 << 16];
  size_t count = 0;
  while ((count = std::fread(block, 1, sizeof block, file)) > 0) bytes.append(block, count);
  const bool failed = std::ferror(file) != 0;
  const int why = errno;
  std::fclose(file);
  return failed ? std::string("cannot be read: ") + std::strerror(why) : "";
}

}  // namespace

Imported read_surface_bytes(const std::string& bytes, const std::string& path, double unit_m) {
  ImportSink sink(path, unit_m);
  const std::string extension = extension_of(path);
  if (bytes.empty()) {
    sink.fail("is empty: export the model again");
  } else if (extension == "obj") {
    read_obj(bytes, sink);
  } else if (extension == "off") {
    read_off(bytes, sink);
  } else if (extension == "ply") {
    read_ply(bytes, sink);
  } else {
    sink.fail("`" + extension +
              "` is no extension of a mesh: give a file that ends in .obj, .off or .ply");
  }
  sink.finish();
  Imported imported;
  imported.problem = sink.problem();
  if (imported.problem.empty()) imported.surface = std::move(sink.surface());
  return imported;
}

Imported read_surface(const std::string& path, double unit_m) {
  std::string bytes;
  const std::string problem = load(path, bytes);
  if (!problem.empty()) return {{}, path + ": " + problem};
  return read_surface_bytes(bytes, path, unit_m);
}

}  // namespace firmtouch::tools
