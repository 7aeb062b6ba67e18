#include "surface/read/read_surface.hpp"

#include "surface/read/import_sink.hpp"
#include "surface/read/load_file.hpp"

namespace firmtouch::tools {
namespace {

constexpr struct {
  std::string_view extension;
  void (*read)(std::string_view bytes, ImportSink& sink);
} kReaders[] = {{"obj", read_obj},   {"off", read_off},  {"ply", read_ply}, {"stl", read_stl},
                {"gltf", read_gltf}, {"glb", read_gltf}, {"3mf", read_3mf}};

void read_by_extension(std::string_view bytes, const std::string& extension, ImportSink& sink) {
  if (bytes.empty()) {
    sink.fail("is empty: export the model again");
    return;
  }
  for (const auto& reader : kReaders)
    if (extension == reader.extension) return reader.read(bytes, sink);
  if (extension == "step" || extension == "stp") {
    sink.fail(
        "is STEP, which holds trimmed surfaces and is not read: export it as a mesh from your CAD "
        "program, or convert it, as with FreeCAD or `gmsh -3 part.step -o part.stl`");
    return;
  }
  sink.fail("`" + extension +
            "` is no extension of a mesh: give a file that ends in .obj, .off, .ply, .stl, .gltf, "
            ".glb or .3mf");
}

}  // namespace

Imported read_surface_bytes(std::string_view bytes, const std::string& path, const FileFrame& frame,
                            PointsAre points, MaterialsAre materials) {
  ImportSink sink(path, frame);
  if (materials == MaterialsAre::kRead) sink.read_materials();
  if (points == PointsAre::kTaken) sink.allow_points();
  read_by_extension(bytes, model_extension(path), sink);
  sink.finish();
  Imported imported;
  imported.problem = sink.problem();
  if (!imported.problem.empty()) return imported;
  imported.surface = std::move(sink.surface());
  imported.notes = sink.notes();
  imported.materials = sink.materials();
  return imported;
}

Imported read_surface(const std::string& path, const FileFrame& frame, PointsAre points) {
  const LoadedFile file = load_file(path, kMaxLineBytes);
  if (!file.problem.empty()) return {{}, path + ": " + file.problem, {}, {}};
  const char* bytes = reinterpret_cast<const char*>(file.bytes.data());
  return read_surface_bytes({bytes, file.bytes.size()}, path, frame, points);
}

}  // namespace firmtouch::tools
