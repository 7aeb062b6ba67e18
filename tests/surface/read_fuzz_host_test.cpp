#include "formats.hpp"
#include "harness/damage.hpp"
#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/read/read_surface.hpp"

// Damaged files: a problem or a surface that may be used, never a crash (the suite runs these under
// ASan and UBSan).

namespace firmtouch::tools {
namespace {

struct File {
  const char* name;
  std::string bytes;
};

std::vector<File> files() {
  return {{"a.obj", cube_obj()},
          {"a.off", cube_off()},
          {"a.ply", cube_ply_ascii()},
          {"a.ply", cube_ply_binary(false)},
          {"a.ply", cube_ply_binary(true)},
          {"a.stl", cube_stl_text()},
          {"a.stl", cube_stl_text("a\\", "\r\n") + cube_stl_text("#2")},
          {"a.stl", cube_stl_binary("solid of bytes", 3)}};
}

std::vector<std::string> files_of(const std::string& name) {
  std::vector<std::string> list;
  for (const File& file : files())
    if (file.name == name) list.push_back(file.bytes);
  return list;
}

// Reads, mends and searches; what comes out must keep its promises.
void survive(const char* name, const std::string& bytes) {
  Imported read = read_surface_bytes(bytes, name, 1);
  if (!read.problem.empty()) {
    CHECK(says(read.problem, name));
    return;
  }
  CHECK_EQ(read.surface.source.size(), read.surface.faces.size());
  for (const Face& face : read.surface.faces) {
    for (const uint32_t v : face) CHECK_LT(v, read.surface.vertices.size());
  }
  Surface loose = read.surface;
  for (const bool is_mended : {false, true}) {
    Surface sound = read.surface;
    const CheckReport report = check_and_mend(sound, {false, is_mended, is_mended});
    if (!report.usable()) continue;
    CHECK(report.is_closed);
    CHECK(is_closed_and_alike(sound));
    find_crossings(sound);
  }
  check_and_mend(loose, {true});
  for (const Face& face : loose.faces) {
    for (const uint32_t v : face) CHECK_LT(v, loose.vertices.size());
  }
}

}  // namespace

TEST(EveryTruncationEndsInAProblemOrASurface) {
  for (const File& file : files()) {
    for (size_t length = 0; length < file.bytes.size(); ++length)
      survive(file.name, file.bytes.substr(0, length));
  }
}

TEST(EveryBitFlipEndsInAProblemOrASurface) {
  for (const File& file : files()) {
    for (size_t at = 0; at < file.bytes.size(); ++at) {
      for (int bit = 0; bit < 8; ++bit) {
        std::string bytes = file.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
        survive(file.name, bytes);
      }
    }
  }
}

TEST(DamagedModel_Obj_EndsInAProblemOrASurface) {
  test::attack(files_of("a.obj"), [](const std::string& bytes) { survive("a.obj", bytes); });
}
TEST(DamagedModel_Off_EndsInAProblemOrASurface) {
  test::attack(files_of("a.off"), [](const std::string& bytes) { survive("a.off", bytes); });
}
TEST(DamagedModel_Ply_EndsInAProblemOrASurface) {
  test::attack(files_of("a.ply"), [](const std::string& bytes) { survive("a.ply", bytes); });
}
TEST(DamagedModel_Stl_EndsInAProblemOrASurface) {
  test::attack(files_of("a.stl"), [](const std::string& bytes) { survive("a.stl", bytes); });
}

}  // namespace firmtouch::tools
