#include "containers.hpp"
#include "formats.hpp"
#include "harness/damage.hpp"
#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/read/inflate.hpp"
#include "surface/read/read_surface.hpp"

// glTF, 3MF and gzip, and the strips of PLY: what they place and how they are refused.

namespace firmtouch::tools {
namespace {

std::string model_3mf(uint32_t method) {
  const std::string gzip = from_hex(kModelGzip);
  const std::string plain = gunzip(gzip, 1 << 20).bytes;
  const std::string packed = method == 8 ? gzip.substr(10, gzip.size() - 18) : plain;
  return zip_of("3D/3dmodel.model", packed, method, crc_of(plain),
                static_cast<uint32_t>(plain.size()));
}

FileFrame own_unit() {
  FileFrame frame;
  frame.has_unit = false;
  return frame;
}

std::string cube_glb() { return glb_of(cube_gltf_json(""), cube_gltf_bytes(cube())); }

std::vector<std::pair<const char*, std::string>> files() {
  return {{"a.glb", cube_glb()},
          {"a.gltf", cube_gltf_json("\"uri\":\"data:a;base64,AAAA\",")},
          {"a.3mf", model_3mf(0)},
          {"a.3mf", model_3mf(8)}};
}

// A problem that names the file, or a surface whose indices hold.
void survive(const char* name, const std::string& bytes) {
  const Imported read = read_surface_bytes(bytes, name, own_unit());
  CHECK(read.problem.empty() || says(read.problem, name));
  for (const Face& face : read.surface.faces)
    for (const uint32_t v : face) CHECK_LT(v, read.surface.vertices.size());
}

}  // namespace

TEST(Glb_PlacesItsMesh_ByTheNodesAboveIt) {
  const Imported read = read_surface_bytes(cube_glb(), "a.glb", 1);
  CHECK(read.problem.empty());
  CHECK(same(read.surface, cube({0, 0, 5}, 2)));
}

TEST(ThreeMf_StoredAndDeflated_PlacesGroupsInItsOwnUnit) {
  for (const uint32_t method : {0u, 8u}) {
    Imported read = read_surface_bytes(model_3mf(method), "a.3mf", own_unit());
    CHECK(read.problem.empty());
    CHECK_EQ(read.surface.faces.size(), 24u);
    CHECK(check_and_mend(read.surface, {}).usable());
    // Float32 rounds coordinates of 0.02 m by 1e-9 m, on faces of 1e-4 m2 together.
    CHECK_LT(std::fabs(volume_of(read.surface) - (2 * 64e-9)), 1e-13);
    CHECK_LT(std::fabs(static_cast<double>(read.surface.vertices[15].x) - (0.022)), 1e-8);
    CHECK_LT(std::fabs(static_cast<double>(read.surface.vertices[15].z) - (0.007)), 1e-8);
    CHECK(says(read.surface.frame.place_text({0.022, 0, 0}), "(22, 0, 0 mm)"));
  }
}

TEST(ThreeMf_GreaterThanSignInAName_EndsNoTag) {
  std::string plain = gunzip(from_hex(kModelGzip), 1 << 20).bytes;
  plain.insert(plain.find("<object ") + 8, "name=\"it's >2\" ");
  const std::string zip =
      zip_of("3D/3dmodel.model", plain, 0, crc_of(plain), static_cast<uint32_t>(plain.size()));
  const Imported read = read_surface_bytes(zip, "a.3mf", own_unit());
  CHECK(read.problem.empty());
  CHECK_EQ(read.surface.faces.size(), 24u);
}

TEST(Gltf_EscapedSlashInBase64_IsRead) {
  const std::string base64 = "AAA\\/" + std::string(220, 'A');
  const std::string uri = "\"uri\":\"data:a;base64," + base64 + "\",";
  CHECK(read_surface_bytes(cube_gltf_json(uri.c_str()), "a.gltf", 1).problem.empty());
}

TEST(GivenUnit_WinsOverThatOfA3mf) {
  const Imported read = read_surface_bytes(model_3mf(8), "a.3mf", 1);
  CHECK_EQ(read.surface.vertices[15].x, 22.0f);
}

TEST(EveryFlippedBitOfDeflate_IsFoundByLengthOrCrc) {
  const std::string gzip = from_hex(kModelGzip), plain = gunzip(gzip, 1 << 20).bytes;
  CHECK(says(plain, "</model>"));
  uint32_t passed = 0;
  for (size_t bit = 80; bit < 8 * gzip.size(); ++bit) {
    std::string bytes = gzip;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    const Inflated out = gunzip(bytes, 1 << 20);
    // Bits of padding behind the last symbol carry nothing.
    if (out.problem.empty()) CHECK(out.bytes == plain);
    passed += out.problem.empty() ? 1u : 0u;
  }
  CHECK_LT(passed, 8u);
  CHECK(!gunzip(gzip, plain.size() - 1).problem.empty());
  for (size_t length = 0; length < gzip.size(); ++length)
    CHECK(!gunzip(gzip.substr(0, length), 1 << 20).problem.empty());
}

TEST(TruncatedContainers_EndInAProblemOrASurface) {
  for (const auto& [name, bytes] : files()) {
    for (size_t length = 0; length < bytes.size(); ++length) survive(name, bytes.substr(0, length));
  }
}
TEST(DamagedModel_Gltf_EndsInAProblemOrASurface) {
  test::attack({cube_gltf_json("\"uri\":\"data:a;base64,AAAA\",")},
               [](const std::string& bytes) { survive("a.gltf", bytes); });
}
TEST(DamagedModel_Glb_EndsInAProblemOrASurface) {
  test::attack({cube_glb()}, [](const std::string& bytes) { survive("a.glb", bytes); });
}
TEST(DamagedModel_3mf_EndsInAProblemOrASurface) {
  test::attack({model_3mf(0), model_3mf(8)},
               [](const std::string& bytes) { survive("a.3mf", bytes); });
}
// With the right CRC, so that what is inside is read.
TEST(DamagedModel_3mfInside_EndsInAProblemOrASurface) {
  const std::string plain = gunzip(from_hex(kModelGzip), 1 << 20).bytes;
  test::attack({plain}, [](const std::string& bytes) {
    survive("a.3mf", zip_of("3D/3dmodel.model", bytes, 0, crc_of(bytes),
                            static_cast<uint32_t>(bytes.size())));
  });
}
TEST(DamagedModel_Gzip_EndsInAProblemOrItsBytes) {
  test::attack({from_hex(kModelGzip)}, [](const std::string& bytes) {
    const Inflated out = gunzip(bytes, 1 << 20);
    CHECK(!out.problem.empty() || out.bytes.size() <= size_t{1} << 20);
  });
}

TEST(ObjectsThatHoldEachOther_AreRefused) {
  std::string text = "<model unit=\"meter\"><object id=\"1\"><mesh/></object>";
  for (int k = 2; k < 60; ++k) {  // 2^58 copies
    const std::string below = "<component objectid=\"" + std::to_string(k - 1) + "\"/>";
    text += "<object id=\"" + std::to_string(k) + "\">" + below + below + "</object>";
  }
  text += "<build><item objectid=\"59\"/></build></model>";
  const std::string zip =
      zip_of("3D/3dmodel.model", text, 0, crc_of(text), static_cast<uint32_t>(text.size()));
  CHECK(says(read_surface_bytes(zip, "a.3mf", 1).problem, "more than 1000000 objects"));
}

TEST(PlyStrips_AreTriangles_EverySecondOneTurned) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n9 0 2 1 3 0 2 -1 0 1\n";
  Imported read = read_surface_bytes(ply, "a.ply", 1);
  CHECK(read.problem.empty());
  CHECK(read.surface.faces == tetrahedron().faces || is_closed_and_alike(read.surface));
}

TEST(ColouredOff_IsReadAsPlainOff) {
  for (const char* head : {"COFF\n8 6 12\n", "STCNOFF\n8 6 12\n"}) {
    const Imported read = read_surface_bytes(cube_off(head, " 0.5 0.5 0.5 1\n"), "a.off", 1);
    CHECK(read.problem.empty());
    CHECK(same(read.surface, cube()));
  }
}

TEST(Step_IsRefusedWithTheWayToConvert) {
  CHECK(says(read_surface_bytes("ISO-10303-21;", "a.step", 1).problem, "export it as a mesh"));
}

TEST(Frame_TurnsByQuartersExactly_AndComesBack) {
  FileFrame frame(0.001);
  turn_about(frame, 0, 90);  // y up
  frame.scale = 2;
  frame.offset_m = {1, 2, 3};
  const Point p = frame.to_m({10, 20, 30});
  CHECK_EQ(p.x, 1.02);
  CHECK_EQ(p.y, 2 - 0.06);
  CHECK_EQ(p.z, 3.04);
  CHECK(says(frame.place_text(p), "(10, 20, 30 mm)"));
}

}  // namespace firmtouch::tools
