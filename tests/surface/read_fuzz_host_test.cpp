#include "formats.hpp"
#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/random.hpp"
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

// Reads, mends and searches; what comes out must keep its promises.
void survive(const File& file, const std::string& bytes) {
  Imported read = read_surface_bytes(bytes, file.name, 1);
  if (!read.problem.empty()) {
    CHECK(says(read.problem, file.name));
    return;
  }
  CHECK_EQ(read.surface.source.size(), read.surface.faces.size());
  for (const Face& face : read.surface.faces) {
    for (const uint32_t v : face) CHECK_LT(v, read.surface.vertices.size());
  }
  Surface loose = read.surface;
  const CheckReport report = check_and_mend(read.surface, {false});
  if (report.usable()) {
    CHECK(report.is_closed);
    CHECK(is_closed_and_alike(read.surface));
    find_crossings(read.surface);
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
      survive(file, file.bytes.substr(0, length));
  }
}

TEST(EveryBitFlipEndsInAProblemOrASurface) {
  for (const File& file : files()) {
    for (size_t at = 0; at < file.bytes.size(); ++at) {
      for (int bit = 0; bit < 8; ++bit) {
        std::string bytes = file.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
        survive(file, bytes);
      }
    }
  }
}

TEST(RandomDamageEndsInAProblemOrASurface) {
  for (uint64_t seed = 1; seed <= 3000; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    Random random(seed);
    const std::vector<File> all = files();
    const File& file = all[random.below(static_cast<uint32_t>(all.size()))];
    std::string bytes = file.bytes;
    for (uint32_t edits = 1 + random.below(6); edits > 0 && !bytes.empty(); --edits) {
      const uint32_t at = random.below(static_cast<uint32_t>(bytes.size()));
      const uint32_t length =
          std::min<uint32_t>(1 + random.below(12), static_cast<uint32_t>(bytes.size()) - at);
      switch (random.below(4)) {
        case 0:
          bytes[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          bytes.erase(at, length);
          break;
        case 2:
          bytes.insert(at, bytes, at, length);
          break;
        default:
          bytes[at] = "0123456789-.e \n"[random.below(15)];
          break;
      }
    }
    survive(file, bytes);
  }
}

}  // namespace firmtouch::tools
