#include "surface/read/read_surface.hpp"

#include "surface/read/import_sink.hpp"
#include "surface/read/load_file.hpp"

namespace firmtouch::tools {
Imported read_surface_bytes(std::string_view bytes, const std::string& path, double unit_m) {
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
  } else if (extension == "stl") {
    read_stl(bytes, sink);
  } else {
    sink.fail("`" + extension +
              "` is no extension of a mesh: give a file that ends in .obj, .off, .ply or .stl");
  }
  sink.finish();
  Imported imported;
  imported.problem = sink.problem();
  if (!imported.problem.empty()) return imported;
  imported.surface = std::move(sink.surface());
  imported.notes = sink.notes();
  return imported;
}

Imported read_surface(const std::string& path, double unit_m) {
  const LoadedFile file = load_file(path, kMaxLineBytes);
  if (!file.problem.empty()) return {{}, path + ": " + file.problem, {}};
  const char* bytes = reinterpret_cast<const char*>(file.bytes.data());
  return read_surface_bytes({bytes, file.bytes.size()}, path, unit_m);
}

}  // namespace firmtouch::tools
